// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <utility>
#include <variant>

namespace vitrine {

/// What went wrong, by whose hand; decides the exit code (sysexits.h values).
enum class Cause {
  usage = 64,       ///< the command line or a setting
  unusable = 65,    ///< the photo, mesh or manifest cannot be used as it is
  missing = 66,     ///< an input file is missing or unreadable
  plugin = 69,      ///< a plugin is missing, refused or broken
  internal = 70,    ///< our fault
  unwritable = 73,  ///< an output cannot be written
  temporary = 75,   ///< goes away by itself: run again
  setup = 78        ///< what a whole run is set up with: its manifest, plugins, mannequins, shards
};

/// An error as a value. `message` names the file and the cause, `remedy` says what the user can do.
struct Error {
  Cause cause = Cause::internal;
  std::string code;     ///< stable reason code, UPPER_CASE, e.g. "LOW_CONTRAST"
  std::string message;  ///< one sentence: which file, what is wrong
  std::string remedy;   ///< one sentence: what to do
  std::string stage;    ///< room that raised it; filled in by the pipeline when empty
  int exit_code() const { return static_cast<int>(cause); }
};

/// A value or an Error. Test it as a bool before taking the value.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}
  explicit operator bool() const { return state_.index() == 0; }
  T& operator*() & { return std::get<0>(state_); }
  const T& operator*() const& { return std::get<0>(state_); }
  T&& operator*() && { return std::get<0>(std::move(state_)); }
  T* operator->() { return &std::get<0>(state_); }
  const T* operator->() const { return &std::get<0>(state_); }
  const Error& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

}  // namespace vitrine
