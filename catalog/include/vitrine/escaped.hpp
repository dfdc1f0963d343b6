// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace vitrine {

/// A text as it may stand in HTML or XML, in an attribute too. Characters that XML 1.0 has not become U+FFFD.
std::string escaped(const std::string& text);

}  // namespace vitrine
