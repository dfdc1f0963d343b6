// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace vitrine {

/// Appends to `out`, as printf would write it.
[[gnu::format(printf, 2, 3)]] void print(std::string& out, const char* format, ...);

}  // namespace vitrine
