// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

namespace vitrine::test {

namespace fs = std::filesystem;

struct Outcome {
  int exit_code = -1;
  std::string text;  ///< standard output, and error unless it was sent elsewhere
};

/// Runs the built program with a shell command line; `errors` says where standard error goes, `before` what starts it.
inline Outcome run_vitrine(const std::string& arguments, const std::string& errors = "2>&1",
                           const std::string& before = "") {
  Outcome run;
  const std::string command =
      before + std::string(VITRINE_BINARY_DIR) + "/bin/vitrine " + arguments + " " + errors + " </dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return run;
  char buffer[4096];
  for (std::size_t n; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) run.text.append(buffer, n);
  const int status = pclose(pipe);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return run;
}

inline std::string slurp(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// An empty folder of the running test's own.
inline fs::path scratch() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const fs::path folder =
      fs::path(testing::TempDir()) / (std::string("vitrine-") + info->test_suite_name() + "-" + info->name());
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

/// For the shell.
inline std::string in_quotes(const fs::path& path) {
  return "'" + path.string() + "'";
}

inline const std::string sample = std::string(VITRINE_SOURCE_DIR) + "/catalog/sample/";

}  // namespace vitrine::test
