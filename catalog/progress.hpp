// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>

#include "report.hpp"

namespace vitrine {

/// Tells a person, or a program, how far the run is: a bar on a terminal, a line every 30 s elsewhere, or JSON every
/// second. Items that are not ok have a line of their own at once, but in JSON.
class Progress {
 public:
  Progress(ProgressKind kind, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void unchanged(const CatalogItem& item, const ItemRecord& record);
  void ended(const CatalogItem& item, const ItemRecord& record);
  /// To be called often.
  void tick() { show(false); }
  /// A line that is printed whatever the kind is.
  void say(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Style { none, bar, lines, json };
  void show(bool last);
  std::string eta() const;
  double seconds_left() const;  ///< negative when nothing is known yet

  Style style_ = Style::none;
  std::size_t total_, made_ = 0, unchanged_ = 0, without_ = 0;
  Clock::time_point start_ = Clock::now(), shown_ = start_;
  bool shown_once_ = false;
};

}  // namespace vitrine
