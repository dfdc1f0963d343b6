// SPDX-License-Identifier: GPL-3.0-or-later
// A library that has nothing to do with Vitrine.
extern "C" __attribute__((visibility("default"))) const int some_other_symbol = 1;
