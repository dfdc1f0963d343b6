// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace vitrine {
namespace {

double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

std::string duration_text(double s) {
  const auto whole = static_cast<long>(s + 0.5);
  char text[48];
  if (whole >= 3600)
    std::snprintf(text, sizeof text, "%ld h %02ld min", whole / 3600, whole / 60 % 60);
  else if (whole >= 60)
    std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
  else
    std::snprintf(text, sizeof text, "%ld s", whole);
  return text;
}

}  // namespace

Progress::Progress(ProgressKind kind, std::size_t total) : total_(total) {
  if (kind == ProgressKind::json) style_ = Style::json;
  if (kind == ProgressKind::automatic) style_ = ::isatty(STDERR_FILENO) == 1 ? Style::bar : Style::lines;
}

Progress::~Progress() {
  show(true);
  if (style_ == Style::bar && shown_once_) std::fputc('\n', stderr);
}

void Progress::say(const std::string& line) {
  std::fprintf(stderr, "%s%s\n", style_ == Style::bar ? "\r\033[K" : "", line.c_str());
}

void Progress::unchanged(const CatalogItem&, const ItemRecord& record) {
  ++unchanged_;
  if (record.status != ItemStatus::ok) ++without_;
}

void Progress::ended(const CatalogItem& item, const ItemRecord& record) {
  ++made_;
  if (record.status != ItemStatus::ok) {
    ++without_;
    if (style_ == Style::bar || style_ == Style::lines)
      say(item.sku + ": " + name_of(record.status) + (record.code.empty() ? "" : " (" + record.code + ")"));
  }
}

double Progress::seconds_left() const {
  if (made_ == 0) return -1;
  const double each = seconds(Clock::now() - start_) / static_cast<double>(made_);
  return each * static_cast<double>(total_ - made_ - unchanged_);
}

std::string Progress::eta() const {
  const double left = seconds_left();
  return left < 0 ? "" : ", " + duration_text(left) + " left";
}

void Progress::show(bool last) {
  const double wait = style_ == Style::json ? 1 : style_ == Style::lines ? 30 : 0.2;
  if (style_ == Style::none || (!last && seconds(Clock::now() - shown_) < wait)) return;
  shown_ = Clock::now();
  shown_once_ = true;
  const std::size_t done = made_ + unchanged_;
  if (style_ == Style::json) {
    const double left = seconds_left();
    std::fprintf(
        stderr, "{\"total\":%zu,\"done\":%zu,\"unchanged\":%zu,\"not_ok\":%zu,\"elapsed_s\":%.1f,\"left_s\":%s}\n",
        total_, done, unchanged_, without_, seconds(shown_ - start_), left < 0 ? "null" : std::to_string(left).c_str());
    return;
  }
  char counts[128];
  std::snprintf(counts, sizeof counts, "%zu of %zu done, %zu unchanged, %zu not ok", done, total_, unchanged_,
                without_);
  if (style_ == Style::lines) {
    std::fprintf(stderr, "%s%s\n", counts, last ? "" : eta().c_str());
    return;
  }
  winsize window = {};
  const int columns = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0 ? window.ws_col : 80;
  const std::string text = counts + (last ? std::string() : eta());
  const int width = std::clamp(columns - static_cast<int>(text.size()) - 4, 0, 40);
  const int full = total_ > 0 ? static_cast<int>(static_cast<std::size_t>(width) * done / total_) : width;
  const std::string bar = width < 8 ? ""
                                    : "[" + std::string(static_cast<std::size_t>(full), '#') +
                                          std::string(static_cast<std::size_t>(width - full), '.') + "] ";
  std::fprintf(stderr, "\r\033[K%s%s", bar.c_str(), text.c_str());
  std::fflush(stderr);
}

}  // namespace vitrine
