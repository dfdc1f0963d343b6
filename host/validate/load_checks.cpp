// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>

#include <cstdio>

#include "process_state.hpp"
#include "session.hpp"
#include "vitrine/host/elf.hpp"

namespace vitrine::validation {
namespace {

constexpr std::uint64_t most_memory = 64u << 20;  // [byte] of address space that loading may take
constexpr double most_seconds = 1;                // [s] of processor that loading may take

/// What a process with `before` could not be explained by the library's own image.
void compare(const Session& session, const ProcessState& before, const ProcessState& after,
             const std::string& printed) {
  const auto judge = [&](std::string_view check, std::initializer_list<std::pair<bool, std::string>> findings) {
    std::vector<std::string> found;
    for (const auto& [broken, what] : findings)
      if (broken) found.push_back(what);
    session.conclude(check, found);
  };
  const std::uint64_t grown = after.address_space - std::min(after.address_space, before.address_space);
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.1f", after.cpu_seconds - before.cpu_seconds);
  judge("hardening.memory",
        {{grown > most_memory, "loading it took " + std::to_string(grown >> 20) + " MB of address space"},
         {after.cpu_seconds - before.cpu_seconds > most_seconds,
          "loading it took " + std::string(seconds) + " s of processor time"}});
  judge("hardening.threads",
        {{after.threads != before.threads,
          "it started " + std::to_string(after.threads - before.threads) + " threads, which a forked worker loses"},
         {after.children != before.children, "it started a process"}});
  std::vector<std::string> opened;
  for (const std::string& file : after.open_files)
    if (!std::binary_search(before.open_files.begin(), before.open_files.end(), file))
      opened.push_back("it left file descriptor " + file + " open");
  for (const std::string& file : before.open_files)
    if (!std::binary_search(after.open_files.begin(), after.open_files.end(), file))
      opened.push_back("it closed file descriptor " + file);
  session.conclude("hardening.files", opened);
  judge("hardening.output", {{!printed.empty(), "it printed \"" + printed + "\""}});
  judge("hardening.environment", {{after.environment != before.environment, "it changed the environment variables"},
                                  {after.folder != before.folder, "it changed the working folder to " + after.folder},
                                  {after.mode_mask != before.mode_mask, "it changed the file mode mask"}});
  judge("hardening.signals", {{after.handlers != before.handlers, "it set a signal, terminate or new handler"},
                              {after.blocked != before.blocked, "it changed the signal mask"},
                              {after.timer != before.timer, "it set a timer"}});
  judge("hardening.numbers", {{after.locale != before.locale, "it changed the locale to " + after.locale},
                              {after.rounding != before.rounding, "it changed the rounding mode"},
                              {after.sse_control != before.sse_control || after.x87_control != before.x87_control,
                               "it changed the floating-point control words"}});
}

/// Limits that hold while foreign code runs at load: a library that eats memory fails alone.
class LoadLimit {
 public:
  LoadLimit() {
    ::getrlimit(RLIMIT_DATA, &before_);
    rlimit limit = before_;
    limit.rlim_cur = std::min<rlim_t>(before_.rlim_max, rlim_t{2} << 30);
    ::setrlimit(RLIMIT_DATA, &limit);
  }
  ~LoadLimit() { ::setrlimit(RLIMIT_DATA, &before_); }
  LoadLimit(const LoadLimit&) = delete;
  LoadLimit& operator=(const LoadLimit&) = delete;

 private:
  rlimit before_{};
};

/// The rules that adoption looks at, as checks of their levels.
bool check_adoption(const Session& session, Subject& subject) {
  // A pointer into nowhere is caught by the fence; whatever crashes nevertheless has to do with memory.
  session.begin("memory.inside");
  auto adopted = adopt(subject.library, subject.file.path.string(), &subject.tables);
  const std::string broken = adopted ? "" : adopted.error().code;
  bool known = broken.empty();
  for (const AdoptionRule& rule : adoption_rules()) {
    const bool here = code_of_rule(rule.name) == broken;
    known = known || here;
    if (here)
      session.fail(rule.name, adopted.error().message + ". " + adopted.error().remedy);
    else if (adopted)
      session.pass(rule.name);
    else
      session.skip(rule.name, "reading stopped at the first broken rule");
  }
  if (!known) session.fail("memory.inside", adopted.error().message);
  if (!adopted) return false;
  subject.plugin = *std::move(adopted);
  session.fact("id", subject.plugin.identity.id);
  session.fact("version", subject.plugin.identity.version);
  for (const GarmentTemplate& garment : subject.plugin.garments) session.fact("garment", garment.id);
  for (const NecklineTemplate& neckline : subject.plugin.necklines) session.fact("neckline", neckline.id);
  return true;
}

}  // namespace

bool check_loading(const Session& session, const PluginFile& file, Subject& subject) {
  subject.file = file;
  session.begin("load.library");
  if (const std::string problem = elf_problem(file.bytes); !problem.empty()) {
    session.fail("load.library", problem);
    return false;
  }
  session.pass("load.library");
  session.begin("load.start");
  static const OutputTrap trap;  // for as long as this process lives: it has nothing to say but its report
  const ProcessState before = ProcessState::now();
  const auto library = [&] {
    const LoadLimit limit;
    return load_library(file);
  }();
  const ProcessState after = ProcessState::now();
  const std::string printed = trap.printed();
  if (!library) {
    const bool no_entry = library.error().code == "PLUGIN_FILE_ENTRY";
    if (no_entry) session.pass("load.start");
    session.fail(no_entry ? "load.entry" : "load.start", library.error().message + ". " + library.error().remedy);
    return false;
  }
  session.pass("load.start");
  session.pass("load.entry");
  if (session.wants(6)) compare(session, before, after, printed);
  subject.library = *library;
  return check_adoption(session, subject);
}

}  // namespace vitrine::validation
