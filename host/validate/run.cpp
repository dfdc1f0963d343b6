// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <map>

#include "session.hpp"

namespace vitrine {

namespace validation {

void Session::send(std::string_view what, std::string_view check, const std::string& text) const {
  report_.send(std::string(what) + '\0' + std::string(check) + '\0' + text);
}

void Session::conclude(std::string_view check, const std::vector<std::string>& findings,
                       const std::string& figures) const {
  if (findings.empty()) return pass(check, figures);
  fail(check, findings.front() +
                  (findings.size() > 1 ? " (and " + std::to_string(findings.size() - 1) + " more like it)" : ""));
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string code_of_rule(std::string_view rule) {
  std::string code = "PLUGIN_";
  for (const char c : rule) code += c == '.' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return code;
}

}  // namespace validation

namespace {

namespace fs = std::filesystem;
using validation::Session;
using validation::Subject;

/// A folder that nobody else can write, gone with this object.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::error_code failed;
    std::string name = (fs::temp_directory_path(failed) / "vitrine-validate-XXXXXX").string();
    if (::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~ScratchFolder() {
    std::error_code failed;
    if (!path_.empty()) fs::remove_all(path_, failed);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

void check_in_child(const ChildReport& report, const PluginFile& file, const ValidateOptions& options,
                    const std::string& folder) {
  const Session session(report, options);
  Subject subject;
  if (!validation::check_loading(session, file, subject)) return;
  if (session.wants(3)) validation::check_templates(session, subject.plugin);
  if (session.wants(6)) validation::check_hardening(session, subject);
  if (session.wants(4)) validation::check_pipeline(session, subject, folder);
  if (session.wants(6)) validation::check_stays(session, subject);
}

/// The parent's side of one file's report.
class Collector {
 public:
  explicit Collector(FileReport& report) : report_(report) {}

  void receive(const std::string& record) {
    const std::size_t a = record.find('\0'), b = a == std::string::npos ? a : record.find('\0', a + 1);
    if (b == std::string::npos) return;
    const std::string what = record.substr(0, a), name = record.substr(a + 1, b - a - 1), text = record.substr(b + 1);
    if (what == "begin") {
      current_ = name;
    } else if (what == "fact") {
      if (name == "id") report_.id = text;
      if (name == "version") report_.version = text;
      if (name == "garment") report_.garments.push_back(text);
      if (name == "neckline") report_.necklines.push_back(text);
    } else {
      if (name == current_) current_.clear();
      results_[name] = {what == "pass"   ? CheckStatus::passed
                        : what == "fail" ? CheckStatus::failed
                                         : CheckStatus::skipped,
                        text};
    }
  }

  void end(const ChildEnd& end) {
    if (end.how == ChildEnd::How::finished) return;
    broken_off_ = current_.empty() ? "load.start" : current_;
    results_[broken_off_] = {CheckStatus::failed, end.text()};
  }

  /// One result per check that was asked for; what nobody spoke of was not reached.
  void fill(const ValidateOptions& options) {
    std::string stopped = broken_off_;
    for (const CheckInfo& check : plugin_checks())
      if (const auto found = results_.find(check.name);
          stopped.empty() && found != results_.end() && found->second.first == CheckStatus::failed)
        stopped = check.name;
    for (const CheckInfo& check : plugin_checks()) {
      if (check.level > options.level || !check.name.starts_with(options.only)) continue;
      CheckResult result{std::string(check.name), check.level, CheckStatus::skipped,
                         stopped.empty() ? "not reached" : "not reached: " + stopped + " failed"};
      if (const auto found = results_.find(check.name); found != results_.end())
        std::tie(result.status, result.message) = found->second;
      report_.checks.push_back(std::move(result));
    }
  }

 private:
  FileReport& report_;
  std::string current_, broken_off_;
  std::map<std::string, std::pair<CheckStatus, std::string>, std::less<>> results_;
};

FileReport validate_file(const std::string& path, const ValidateOptions& options) {
  FileReport report;
  report.file = path;
  Collector collector(report);
  const auto say = [&](const char* what, const std::string& why) {
    collector.receive(std::string(what) + '\0' + "load.file" + '\0' + why);
  };
  const auto file = open_plugin_file(path);
  if (!file) {
    say("fail", file.error().message + ". " + file.error().remedy);
  } else {
    say("pass", "");
    report.sha256 = file->sha256;
    const ScratchFolder scratch;
    ChildLimits limits;
    limits.silent_seconds = options.seconds;
    collector.end(run_in_child(
        limits, [&](const ChildReport& child) { check_in_child(child, *file, options, scratch.path()); },
        [&](const std::string& record) { collector.receive(record); }));
  }
  collector.fill(options);
  return report;
}

}  // namespace

Result<Validation> validate_plugins(const std::vector<std::string>& files, const ValidateOptions& asked) {
  ValidateOptions options = asked;
  if (!options.only.empty()) {
    int level = 0;
    for (const CheckInfo& check : plugin_checks())
      if (check.name.starts_with(options.only)) level = std::max(level, check.level);
    if (level == 0)
      return Error{Cause::usage, "UNKNOWN_CHECK", "no check is called \"" + options.only + "\"",
                   "vitrine plugin checks lists them all", ""};
    options.level = level;
  }
  Validation validation;
  for (const std::string& file : files) {
    validation.files.push_back(validate_file(file, options));
    for (const CheckResult& check : validation.files.back().checks) {
      validation.passed += check.status == CheckStatus::passed;
      validation.failed += check.status == CheckStatus::failed;
      validation.skipped += check.status == CheckStatus::skipped;
    }
  }
  return validation;
}

}  // namespace vitrine
