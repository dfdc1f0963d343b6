// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <string>

#include "vitrine/model/geometry.hpp"

namespace vitrine {

/// SHA-256 as 64 hexadecimal digits; empty where the library has none.
std::string sha256_hex(const void* data, std::size_t size);

/// SHA-256 [hex] of a mesh's points [m], to the 32-bit floats that a model holds, and of its triangles: two models with
/// the same one stand in one frame.
std::string hash_of(const TriMesh& mesh);

}  // namespace vitrine
