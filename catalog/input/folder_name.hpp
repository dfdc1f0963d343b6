// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

namespace vitrine::input {

/// A folder's name for a product: its id where that can be one, else what is left of it and -x with 16 digits of its
/// SHA-256. It depends on the id alone, so it stays from night to night; ids that end like such a name are rewritten
/// too, so no id has the name of another.
std::string folder_name(std::string_view id);

std::string sha256_hex(std::string_view bytes);

}  // namespace vitrine::input
