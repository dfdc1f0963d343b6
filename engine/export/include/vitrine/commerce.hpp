// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "vitrine/model/geometry.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine {

enum class Verdict { pass, warn, fail };

/// One limit that shops, feeds and viewers set, and how a file stands to it.
struct CommerceFinding {
  std::string rule;     ///< stable name, e.g. "triangles"
  std::string value;    ///< what the file has
  std::string limit;    ///< what is asked
  std::string sources;  ///< whose limit it is
  Verdict verdict = Verdict::pass;
};

/// The body that the garment is worn by, to hold the file's size and place against.
struct CommerceScale {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< [m] box of the mannequin; equal: not checked
};

/// What the check of one file found out about its pictures and charts, for another that has the same ones in it: the
/// garment alone and the garment on its mannequin. What is taken from here was compared first, byte by byte.
class CommerceMemory {
 public:
  struct Held;
  CommerceMemory();
  Held& held() { return *held_; }

 private:
  std::shared_ptr<Held> held_;
};

/// Reads a GLB back and holds it against the limits of the Khronos 3D commerce guidelines, Shopify, Google and Apple:
/// file size, triangles, materials, nodes, textures (format, size, power of two), base colours 30 to 243, UVs (within
/// 0-1, no overlap, not inverted, gutter), names, unit normals, root without a transform, and size, place and origin
/// against the mannequin. `memory`, where given, saves what a file before had as well. Error (65): NOT_A_GLB.
Result<std::vector<CommerceFinding>> check_commerce(std::span<const std::uint8_t> glb, const CommerceScale& scale = {},
                                                    CommerceMemory* memory = nullptr);

}  // namespace vitrine
