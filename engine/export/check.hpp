// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <span>

#include "vitrine/model/garment.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

/// What no file may hold: no meshes, empty ones, arrays that contradict each other, numbers that are none, normals that
/// are not unit, triangles off the end.
std::optional<Error> check_meshes(std::span<const RenderMesh> meshes);

}  // namespace vitrine
