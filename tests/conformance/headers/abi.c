/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "vitrine/abi.h"

/* The entry as a plugin in C writes it. */
const vitrine_plugin vitrine_plugin_entry = {VITRINE_HEADER, .id = "org.example.headers"};
