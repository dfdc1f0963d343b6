// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "table_reader.hpp"
#include "vitrine/host/adopt.hpp"

namespace vitrine::adoption {

/// Both throw Broken.
GarmentTemplate copy_garment(const vitrine_garment& table, const PluginIdentity& identity);
NecklineTemplate copy_neckline(const vitrine_neckline& table, const PluginIdentity& identity);

}  // namespace vitrine::adoption
