// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>

/// Reads the text as every kind of input it can be, and as rules, before an image root with links that lead out of it.
/// Aborts with a sentence on standard error when a promise does not hold: items have safe names of their own, their
/// pictures lie below the image root, refusals name cause and remedy, and what is accepted goes through a manifest and
/// comes back the same.
void check_input(std::string_view text);
