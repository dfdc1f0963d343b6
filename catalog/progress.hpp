// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <unistd.h>

#include <cstdio>

#include "report.hpp"

namespace vitrine {

/// Tells a person how far the run is: one updating line on a terminal, else a line per item.
class Progress {
 public:
  Progress(bool wanted, std::size_t total) : wanted_(wanted), terminal_(::isatty(STDERR_FILENO) == 1), total_(total) {}
  ~Progress() {
    if (wanted_ && terminal_ && done_ > 0) std::fputc('\n', stderr);
  }
  void ended(const CatalogItem& item, const ItemRecord& record) {
    ++done_;
    const bool well = record.status == ItemStatus::ok;
    if (!well) ++without_;
    if (!wanted_) return;
    const std::string why = well || record.code.empty() ? "" : " (" + record.code + ")";
    if (!terminal_) {
      std::fprintf(stderr, "[%zu/%zu] %s: %s%s\n", done_, total_, item.sku.c_str(), name_of(record.status),
                   why.c_str());
      return;
    }
    // What went wrong keeps a line of its own; the count moves on below it.
    if (!well) std::fprintf(stderr, "\r\033[K%s: %s%s\n", item.sku.c_str(), name_of(record.status), why.c_str());
    std::fprintf(stderr, "\r\033[K%zu of %zu done, %zu without a model", done_, total_, without_);
    std::fflush(stderr);
  }

 private:
  bool wanted_, terminal_;
  std::size_t total_, done_ = 0, without_ = 0;
};

}  // namespace vitrine
