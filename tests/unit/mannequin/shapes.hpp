// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <string>

#include "marching.hpp"
#include "vitrine/mannequin.hpp"

namespace vitrine::test {

inline double sphere(const Vec3& p) {
  return (p - Vec3(0.03, 0.5, -0.02)).norm() - 0.2;
}

inline double capsule(const Vec3& p) {
  const Vec3 a(-0.1, 0.2, 0.05), b(0.15, 0.55, -0.1), ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - t * ab).norm() - 0.09;
}

inline double box(const Vec3& p) {
  const Vec3 q = p.cwiseAbs() - Vec3(0.2, 0.3, 0.1);
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

inline TriMesh box_mesh(const Vec3& half, const Vec3& centre) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(centre + half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

inline std::string write_obj(const std::string& name, const TriMesh& mesh, double scale = 1,
                             const Vec3& shift = Vec3::Zero()) {
  const std::string path = std::string(VITRINE_BINARY_DIR) + "/mannequin_" + name + ".obj";
  std::ofstream out(path);
  out << std::setprecision(9);
  for (const Vec3& p : mesh.vertices) {
    const Vec3 q = scale * (p + shift);
    out << "v " << q.x() << ' ' << q.y() << ' ' << q.z() << '\n';
  }
  for (const Triangle& t : mesh.triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return path;
}

inline std::string write_text(const std::string& name, const std::string& text) {
  const std::string path = std::string(VITRINE_BINARY_DIR) + "/mannequin_" + name;
  std::ofstream(path) << text;
  return path;
}

}  // namespace vitrine::test
