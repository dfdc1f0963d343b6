// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <signal.h>

#include <cstddef>

namespace vitrine {

/// Turns SIGINT and SIGTERM into a flag. They stay blocked except while the run waits in ppoll, so that none is lost
/// between the look at the flag and the wait.
class StopSignals {
 public:
  StopSignals() {
    asked_ = 0;
    struct sigaction action = {};
    action.sa_handler = [](int) { asked_ = 1; };
    sigemptyset(&action.sa_mask);
    sigset_t both;
    sigemptyset(&both);
    for (std::size_t i = 0; i < 2; ++i) {
      sigaddset(&both, numbers[i]);
      sigaction(numbers[i], nullptr, &before_[i]);
      // A parent that ignores SIGINT (nohup, a shell's background job) means it.
      if (before_[i].sa_handler != SIG_IGN) sigaction(numbers[i], &action, nullptr);
    }
    sigprocmask(SIG_BLOCK, &both, &mask_);
  }
  ~StopSignals() {
    // A signal that is still pending has to meet the flag, not the old handler.
    sigprocmask(SIG_SETMASK, &mask_, nullptr);
    for (std::size_t i = 0; i < 2; ++i) sigaction(numbers[i], &before_[i], nullptr);
  }
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  const sigset_t& waiting_mask() const { return mask_; }
  /// Looks for a signal that is waiting, too: a run that never sleeps has to hear it.
  bool asked() const {
    sigset_t pending;
    if (sigpending(&pending) == 0)
      for (const int number : numbers)
        if (sigismember(&pending, number) == 1) return true;
    return asked_ != 0;
  }

 private:
  static constexpr int numbers[2] = {SIGINT, SIGTERM};
  static inline volatile sig_atomic_t asked_ = 0;
  struct sigaction before_[2] = {};
  sigset_t mask_ = {};
};

}  // namespace vitrine
