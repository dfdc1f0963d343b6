/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "vitrine/abi.h"

/* Ten megabytes without an end in sight, by the assembler: compilers take half a minute over so long a value. */
extern const char vendor[] __attribute__((visibility("hidden")));
__asm__(
    ".pushsection .rodata\n"
    "vendor:\n"
    ".fill 10485759, 1, 'a'\n"
    ".byte 0\n"
    ".popsection\n");
static const vitrine_profile_point profile[] = {{0.0, 0.0}, {0.5, 1.0}, {1.0, 0.0}};
static const vitrine_neckline necklines[] = {{
    .id = "neck_plain_c",
    .title = "Neckline",
    .profile = {profile, 3, sizeof profile[0]},
    .ratio_min = 0.5,
    .ratio_max = 2.0,
    .default_depth = 0.5,
}};

const vitrine_plugin vitrine_plugin_entry = {
    VITRINE_HEADER,
    .vendor = vendor,
    .id = "org.example.plain-c",
    .version = "1.0.0",
    .necklines = {necklines, 1, sizeof necklines[0]},
};
