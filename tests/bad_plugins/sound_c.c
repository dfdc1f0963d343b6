/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The same ABI without the C++ wrapper: a neckline in plain C11. */
#include "vitrine/abi.h"

static const vitrine_profile_point profile[] = {{0.0, 0.0}, {0.5, 1.0}, {1.0, 0.0}};
static const vitrine_neckline necklines[] = {{
    .id = "neck_plain_c",
    .title = "Neckline in C",
    .profile = {profile, 3, sizeof profile[0]},
    .ratio_min = 0.5,
    .ratio_max = 2.0,
    .default_depth = 0.5,
}};

const vitrine_plugin vitrine_plugin_entry = {
    VITRINE_HEADER,
    .vendor = "Example",
    .id = "org.example.plain-c",
    .version = "1.0.0",
    .necklines = {necklines, 1, sizeof necklines[0]},
};
