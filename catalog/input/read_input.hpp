// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

#include "image_root.hpp"
#include "rules.hpp"

namespace vitrine::input {

/// What a text is, by its first character or the names of its columns. Error: INPUT_KIND (65).
Result<InputKind> kind_of(const std::string& file, std::string_view text, const Rules& rules);

/// read_input for a text that is in memory already; every kind but a folder. `root` may be null.
Result<CatalogInput> read_input_text(const std::string& file, std::string_view text, InputKind kind, const Rules& rules,
                                     const ImageRoot* root, bool details);

/// What write_manifest writes to this path. Error: MANIFEST_VALUE (65).
Result<std::string> manifest_text(const std::vector<CatalogItem>& items, const std::string& path);

}  // namespace vitrine::input
