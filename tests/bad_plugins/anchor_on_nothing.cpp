// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

BROKEN_GARMENT(Skirt, t.features[0].landmark = nullptr);
