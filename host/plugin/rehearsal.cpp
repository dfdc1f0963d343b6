// SPDX-License-Identifier: GPL-3.0-or-later
#include "rehearsal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include "vitrine/host/adopt.hpp"
#include "vitrine/host/child.hpp"

namespace vitrine {
namespace {

Error refusal(const PluginFile& file, const ChildEnd& end) {
  const bool hung = end.how == ChildEnd::How::timed_out, exited = end.how == ChildEnd::How::exited;
  Error error{Cause::plugin,
              hung     ? "PLUGIN_FILE_HANG"
              : exited ? "PLUGIN_FILE_EXIT"
                       : "PLUGIN_FILE_CRASH",
              "plugin file " + file.path.string() + " cannot be loaded: while a child process loaded it, " + end.text(),
              "Remove the file, or ask the plugin's author: vitrine plugin validate " + file.path.string() +
                  " tells more; a plugin's tables need no code that runs at load",
              "plugin"};
  return error;
}

}  // namespace

std::vector<std::optional<Error>> rehearse(const std::vector<PluginFile>& files, double seconds_each) {
  std::vector<std::optional<Error>> refusals(files.size());
  for (std::size_t first = 0; first < files.size();) {
    std::size_t done = first;
    ChildLimits limits;
    limits.silent_seconds = seconds_each;
    const ChildEnd end = run_in_child(
        limits,
        [&](const ChildReport& report) {
          // What a constructor prints is not this program's output.
          const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
          ::dup2(nowhere, STDOUT_FILENO);
          ::dup2(nowhere, STDERR_FILENO);
          for (std::size_t i = first; i < files.size(); ++i) {
            // What is refused in good order is refused again, and explained, by the host itself.
            if (const auto loaded = load_library(files[i])) (void)adopt(*loaded, files[i].path.string());
            report.send("next");
          }
        },
        [&](const std::string&) { ++done; });
    if (end.how == ChildEnd::How::finished || done >= files.size()) break;
    refusals[done] = refusal(files[done], end);
    first = done + 1;
  }
  return refusals;
}

}  // namespace vitrine
