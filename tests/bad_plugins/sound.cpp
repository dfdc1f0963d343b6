// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_ENTRY((void)p);
