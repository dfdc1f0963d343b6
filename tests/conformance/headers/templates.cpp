// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/templates/fabrics.hpp"
#include "vitrine/templates/legs.hpp"
#include "vitrine/templates/necklines.hpp"
#include "vitrine/templates/skirt.hpp"
#include "vitrine/templates/sleeve.hpp"
#include "vitrine/templates/torso.hpp"
