/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "vitrine/abi.h"

/* Every row four bytes beside where it belongs. */
static const struct {
  uint32_t before;
  char rows[3 * sizeof(vitrine_profile_point)];
} profile = {0, {0}};
static const vitrine_neckline necklines[] = {{
    .id = "neck_plain_c",
    .title = "Neckline",
    .profile = {(const vitrine_profile_point*)(const void*)profile.rows, 3, sizeof(vitrine_profile_point)},
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
