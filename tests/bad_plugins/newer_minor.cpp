// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_ENTRY(p.abi_minor = VITRINE_ABI_MINOR + 1);
