// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <stdexcept>

#include "drape_bench.hpp"

namespace vitrine::bench {
namespace {

/// For a POSIX shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

nlohmann::ordered_json run_blender(const std::string& script, const std::string& folder, double stop, int frames) {
  char tail[100];
  std::snprintf(tail, sizeof tail, " quality=10 frames=%d stop=%g 2>/dev/null", frames, stop);
  // One thread, as here; threads that wait by spinning would be counted as work.
  const std::string command = "OMP_NUM_THREADS=1 OMP_WAIT_POLICY=passive blender -b --factory-startup -t 1 -P " +
                              quoted(script) + " -- data=" + quoted(folder) + tail;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("blender cannot be started");
  std::string output;
  char buffer[4096];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) output.append(buffer, n);
  pclose(pipe);
  const std::string mark = "RESULT ";
  const std::size_t at = output.find(mark);
  if (at == std::string::npos)
    throw std::runtime_error("blender gave no result; is it on the PATH, and " + script + "?");
  const std::size_t end = output.find('\n', at);
  return nlohmann::ordered_json::parse(output.substr(at + mark.size(), end - at - mark.size()));
}

}  // namespace vitrine::bench
