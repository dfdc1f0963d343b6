// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <span>
#include <string>

#include "boundary.hpp"
#include "vitrine/mesh.hpp"

namespace vitrine::mesh_room {

Error degenerate(const std::string& why);
Error too_many(double needed, int allowed);

/// Why the outline and holes cannot be meshed, if they cannot. Sizes are checked before anything is allocated by them;
/// the outline comes from a stranger's photo. Loops that cross each other are left to the triangulation to find.
std::optional<Error> check(std::span<const Vec2> outline, std::span<const Loop> holes, const MeshOptions& options);

}  // namespace vitrine::mesh_room
