// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_ENTRY(p.abi_major = VITRINE_ABI_MAJOR + 1);
