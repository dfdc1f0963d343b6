// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/abi.h"

// Without designators, which C++ has since 2020 only, fields stand in the order of the header.
const vitrine_plugin vitrine_plugin_entry = {
    VITRINE_MAGIC,         VITRINE_ABI_MAJOR, VITRINE_ABI_TARGET_MINOR, sizeof(vitrine_plugin), "Example",
    "org.example.headers", "1.0.0",           {nullptr, 0, 0},          {nullptr, 0, 0},        nullptr};
