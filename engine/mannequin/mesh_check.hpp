// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "vitrine/model/geometry.hpp"

namespace vitrine::body {

struct MeshState {
  std::size_t open_edges = 0;                  ///< edges with one triangle
  std::size_t crowded_edges = 0;               ///< edges with more than two
  std::size_t turned_edges = 0;                ///< edges that both triangles walk in the same direction
  bool has_fault = false;                      ///< any of the above; then the first such edge:
  std::uint32_t fault_from = 0, fault_to = 0;  ///< vertices
  std::size_t parts = 0;                       ///< connected pieces
  bool finite = true;
  bool valid_indices = true;
  bool closed() const { return open_edges == 0 && crowded_edges == 0 && turned_edges == 0; }
};

MeshState inspect(const TriMesh& mesh);
double signed_volume(const TriMesh& mesh);
double smallest_angle(const TriMesh& mesh);  ///< [rad] of all corners
/// Piece of each vertex, numbered in the order in which vertices first meet it; vertices without a triangle are -1.
std::vector<int> pieces(const TriMesh& mesh);

}  // namespace vitrine::body
