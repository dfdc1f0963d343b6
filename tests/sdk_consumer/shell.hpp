// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace vitrine::test {

namespace fs = std::filesystem;

struct Outcome {
  int exit_code = -1;
  std::string text;  ///< standard output and error
};

inline Outcome shell(const std::string& command) {
  Outcome run;
  setenv("CMAKE_GENERATOR", "Ninja", 1);  // make need not be installed
  FILE* pipe = popen(("{ " + command + "\n} 2>&1 </dev/null").c_str(), "r");
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
inline void spit(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string quoted(const fs::path& path) {
  return "'" + path.string() + "'";
}

/// An empty folder of the running test's own.
inline fs::path scratch() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const fs::path folder =
      fs::path(VITRINE_BINARY_DIR) / "tests" / "scratch" / (std::string(info->test_suite_name()) + "." + info->name());
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

inline const fs::path source = VITRINE_SOURCE_DIR;
inline const fs::path build = VITRINE_BINARY_DIR;
inline const std::string cmake = VITRINE_CMAKE;

/// Installs components of the build tree under `prefix`.
inline void install(const fs::path& prefix, std::initializer_list<const char*> components) {
  for (const char* component : components) {
    const Outcome run =
        shell(cmake + " --install " + quoted(build) + " --prefix " + quoted(prefix) + " --component " + component);
    ASSERT_EQ(run.exit_code, 0) << run.text;
  }
}

}  // namespace vitrine::test
