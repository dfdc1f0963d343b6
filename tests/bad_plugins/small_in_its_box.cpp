// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Skirt, for (auto& point : t.pose) point.u = 0.5 + 0.4 * (point.u - 0.5));
