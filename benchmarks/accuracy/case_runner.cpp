// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_runner.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <nlohmann/json.hpp>

namespace vitrine::bench {
namespace {

nlohmann::json number(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

std::optional<double> number(const nlohmann::json& value) {
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

std::string to_text(const Outcome& o) {
  return nlohmann::json{{"status", o.status},
                        {"residual", number(o.residual)},
                        {"gap_mm", number(o.gap_mm)},
                        {"penetration_mm", number(o.penetration_mm)},
                        {"stretch_p99", number(o.stretch_p99)},
                        {"finite", o.finite},
                        {"note", o.note},
                        {"refused", o.refused}}
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::optional<Outcome> from_text(const std::string& text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  Outcome o;
  o.status = json["status"].get<std::string>();
  o.residual = number(json["residual"]);
  o.gap_mm = number(json["gap_mm"]);
  o.penetration_mm = number(json["penetration_mm"]);
  o.stretch_p99 = number(json["stretch_p99"]);
  o.finite = json["finite"].get<bool>();
  o.note = json["note"].get<std::string>();
  o.refused = json["refused"].get<bool>();
  return o;
}

[[noreturn]] void be_the_child(const std::function<Outcome()>& body, int answer, int cpu_seconds, int megabytes) {
  const rlimit time{static_cast<rlim_t>(cpu_seconds), static_cast<rlim_t>(cpu_seconds) + 1};
  const rlimit memory{static_cast<rlim_t>(megabytes) << 20, static_cast<rlim_t>(megabytes) << 20};
  const rlimit core{0, 0};
  setrlimit(RLIMIT_CPU, &time);
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CORE, &core);
  Outcome outcome;
  try {
    outcome = body();
  } catch (const std::exception& error) {
    outcome.status = "EXCEPTION";
    outcome.note = error.what();
  }
  const std::string text = to_text(outcome);
  std::size_t sent = 0;
  while (sent < text.size()) {
    const ssize_t n = write(answer, text.data() + sent, text.size() - sent);
    if (n <= 0) break;
    sent += static_cast<std::size_t>(n);
  }
  _exit(0);
}

std::string field(const std::optional<double>& value, const char* format) {
  if (!value) return "";
  char text[40];
  std::snprintf(text, sizeof text, format, *value);
  return text;
}

}  // namespace

bool Outcome::as_it_should_be() const {
  static const char* broken[] = {"CRASH", "CPU_LIMIT", "NO_ANSWER", "EXCEPTION", "DIFFERS"};
  if (status.empty() || std::find(std::begin(broken), std::end(broken), status) != std::end(broken)) return false;
  if (refused) return true;
  // Cloth inside the body has a status of its own, INSIDE_BODY; "OK" promises that there is none.
  const bool outside = status != "OK" || !penetration_mm || *penetration_mm <= 0.5;
  return finite && outside;
}

Outcome run_apart(const std::function<Outcome()>& body, int cpu_seconds, int megabytes) {
  Outcome outcome;
  int pipes[2];
  if (pipe(pipes) != 0) {
    outcome.status = "NO_ANSWER";
    return outcome;
  }
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    close(pipes[0]);
    be_the_child(body, pipes[1], cpu_seconds, megabytes);
  }
  close(pipes[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t n; child > 0 && (n = read(pipes[0], buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(n));
  close(pipes[0]);
  int ended = 0;
  rusage used{};
  if (child > 0) wait4(child, &ended, 0, &used);
  if (auto answer = from_text(text); answer && child > 0 && WIFEXITED(ended)) {
    outcome = *std::move(answer);
  } else if (child > 0 && WIFSIGNALED(ended)) {
    const int signal = WTERMSIG(ended);
    const bool hung = signal == SIGXCPU || (signal == SIGKILL && used.ru_utime.tv_sec >= cpu_seconds - 1);
    outcome.status = hung ? "CPU_LIMIT" : "CRASH";
    outcome.note =
        hung ? "more than " + std::to_string(cpu_seconds) + " s" : std::string("signal ") + strsignal(signal);
  } else {
    outcome.status = "NO_ANSWER";
  }
  const auto ms = [](const timeval& t) {
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
  };
  outcome.cpu_ms = ms(used.ru_utime) + ms(used.ru_stime);
  return outcome;
}

std::string csv_row(const std::string& group, const std::string& name, const Outcome& o) {
  const auto cell = [](std::string words) {
    std::replace_if(
        words.begin(), words.end(), [](char c) { return c == ',' || c == '"' || c == '\n'; }, ';');
    return words;
  };
  return cell(group) + "," + cell(name) + "," + o.status + "," + field(o.residual, "%.2e") + "," +
         field(o.gap_mm, "%.3f") + "," + field(o.penetration_mm, "%.3f") + "," + field(o.stretch_p99, "%.4f") + "," +
         (o.refused  ? ""
          : o.finite ? "1"
                     : "0") +
         "," + field(o.cpu_ms, "%.0f") + "," + cell(o.note) + "\n";
}

}  // namespace vitrine::bench
