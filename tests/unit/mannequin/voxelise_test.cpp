// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "mesh_check.hpp"
#include "shapes.hpp"

namespace vitrine {
namespace {

using test::box;
using test::box_mesh;
using test::capsule;
using test::sphere;

struct Shape {
  const char* name;
  std::function<double(const Vec3&)> exact;
  std::function<TriMesh()> mesh;
};

TriMesh marched(double (*field)(const Vec3&)) {
  return body::march(field, Vec3(-0.35, 0.0, -0.35), Vec3(0.35, 0.8, 0.35), 0.008);
}

const Shape shapes[] = {
    {"sphere", sphere, [] { return marched(sphere); }},
    {"capsule", capsule, [] { return marched(capsule); }},
    {"box", box, [] { return box_mesh(Vec3(0.2, 0.3, 0.1), Vec3::Zero()); }},
};

class Voxels : public testing::TestWithParam<Shape> {
 protected:
  static constexpr double spacing = 0.01;
  const TriMesh mesh = GetParam().mesh();
  const Result<DistanceField> field = voxelise(mesh, {spacing, 0.08});
};

INSTANTIATE_TEST_SUITE_P(shapes, Voxels, testing::ValuesIn(shapes),
                         [](const auto& i) { return std::string(i.param.name); });

TEST_P(Voxels, hold_the_exact_distance_near_the_surface_and_a_close_one_beyond) {
  ASSERT_TRUE(field);
  double band = 0, outside = 0, inside = 0;
  for (int z = 0; z < field->size[2]; ++z)
    for (int y = 0; y < field->size[1]; ++y)
      for (int x = 0; x < field->size[0]; ++x) {
        const std::size_t i =
            x + static_cast<std::size_t>(field->size[0]) * (y + static_cast<std::size_t>(field->size[1]) * z);
        const Vec3 p = field->origin + spacing * Vec3(x, y, z);
        const double exact = GetParam().exact(p);
        double& worst = std::abs(exact) < 2.9 * spacing ? band : exact > 0 ? outside : inside;
        worst = std::max(worst, std::abs(field->values[i] - exact));
      }
  EXPECT_LT(band, 0.1 * spacing);
  EXPECT_LT(outside, 0.5 * spacing);
  EXPECT_LT(inside, spacing) << "where cloth never is";
}

TEST_P(Voxels, sample_close_to_the_exact_distance_between_the_voxels) {
  ASSERT_TRUE(field);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 3000; ++i) {
    Vec3 p;
    for (int a = 0; a < 3; ++a) p[a] = field->origin[a] + unit(random) * spacing * (field->size[a] - 1);
    EXPECT_NEAR(field->distance(p), GetParam().exact(p), spacing);
  }
}

TEST_P(Voxels, have_a_unit_gradient_near_the_surface) {
  ASSERT_TRUE(field);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  double sum = 0;
  int count = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    // The shape's own normal: that of a sliver of the marched mesh says little.
    const Vec3 middle = (a + b + c) / 3;
    Vec3 n, g;
    for (int k = 0; k < 3; ++k)
      n[k] = (GetParam().exact(middle + 1e-4 * Vec3::Unit(k)) - GetParam().exact(middle)) / 1e-4;
    field->distance(middle + 0.015 * unit(random) * n, g);
    sum += g.norm();
    EXPECT_GT(g.dot(n), 0.7);
    ++count;
  }
  EXPECT_NEAR(sum / count, 1, 0.03);
}

TEST_P(Voxels, never_change_faster_than_one_metre_a_metre) {
  ASSERT_TRUE(field);
  const auto& v = field->values;
  const std::size_t row = field->size[0], slab = row * field->size[1];
  for (std::size_t i = 0; i + slab < v.size(); ++i) {
    if ((i + 1) % row != 0) {
      ASSERT_LE(std::abs(v[i + 1] - v[i]), 1.02 * spacing);
    }
    if ((i / row + 1) % field->size[1] != 0) {
      ASSERT_LE(std::abs(v[i + row] - v[i]), 1.02 * spacing);
    }
    ASSERT_LE(std::abs(v[i + slab] - v[i]), 1.02 * spacing);
  }
}

TEST(Voxelise, is_negative_inside_and_positive_outside_a_body) {
  const Result<Mannequin> body = build_mannequin({});
  ASSERT_TRUE(body);
  const Result<DistanceField> field = voxelise(body->mesh);
  ASSERT_TRUE(field);
  EXPECT_LT(field->distance(Vec3(0, 1.1, 0.02)), -0.05);
  EXPECT_GT(field->distance(Vec3(0, 0.5, 0.0)), 0.01) << "between the legs";
  std::size_t wrong = 0;
  for (const Triangle& t : body->mesh.triangles) {
    const Vec3 &a = body->mesh.vertices[t[0]], &b = body->mesh.vertices[t[1]], &c = body->mesh.vertices[t[2]];
    const Vec3 n = (b - a).cross(c - a).normalized(), middle = (a + b + c) / 3;
    if (field->distance(middle + 0.004 * n) <= 0 || field->distance(middle - 0.004 * n) >= 0) ++wrong;
  }
  EXPECT_LT(wrong, body->mesh.triangles.size() / 1000);
  const Vec3 top = field->origin + field->spacing * Vec3(field->size[0] - 1, field->size[1] - 1, field->size[2] - 1);
  for (const Vec3& v : body->mesh.vertices)
    ASSERT_TRUE(((v - field->origin).array() >= 0.0799).all() && ((top - v).array() >= 0.0799).all());
}

/// Inside, by counting the triangles that a slanted ray from p meets.
bool holds(const TriMesh& body, const Vec3& p) {
  const Vec3 way = Vec3(0.6137, 0.2219, 0.7579).normalized();
  int crossings = 0;
  for (const Triangle& t : body.triangles) {
    const Vec3 &a = body.vertices[t[0]], ab = body.vertices[t[1]] - a, ac = body.vertices[t[2]] - a;
    const Vec3 across = way.cross(ac), from = p - a;
    const double turn = ab.dot(across), u = from.dot(across) / turn;
    if (!(u >= 0 && u <= 1)) continue;
    const Vec3 around = from.cross(ab);
    const double v = way.dot(around) / turn;
    if (v >= 0 && u + v <= 1 && ac.dot(around) / turn > 0) ++crossings;
  }
  return crossings % 2 == 1;
}

TEST(Voxelise, tells_the_side_of_every_point_however_close_to_the_surface) {
  const Result<Mannequin> body = build_mannequin({});
  ASSERT_TRUE(body);
  const TriMesh& mesh = body->mesh;
  const Result<DistanceField> field = voxelise(mesh, {0.005, 0.03});
  ASSERT_TRUE(field);
  std::mt19937_64 random(9);
  const auto unit = [&random] { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
  for (int i = 0; i < 4000; ++i) {
    const Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    // Along the edges, where the surface folds and interpolation errs most; most points within half a millimetre.
    const double along = unit(), aside = 0.1 * unit() * unit(), off = (2 * unit() - 1) * (i % 4 == 0 ? 5e-3 : 5e-4);
    const Vec3 p = a + along * (b - a) + aside * (c - a) + off * (b - a).cross(c - a).normalized();
    EXPECT_EQ(field->distance(p) < 0, holds(mesh, p)) << p.transpose() << " at " << field->distance(p);
  }
}

TEST(Voxelise, counts_what_lies_inside_twice_as_inside_and_an_inside_out_mesh_as_the_right_way_round) {
  // Two boxes that share their middle, as a hand that cuts into a thigh does.
  TriMesh both = box_mesh(Vec3(0.10, 0.20, 0.10), Vec3::Zero());
  const TriMesh second = box_mesh(Vec3(0.10, 0.20, 0.10), Vec3(0.063, 0.041, 0.027));
  const auto base = static_cast<std::uint32_t>(both.vertices.size());
  both.vertices.insert(both.vertices.end(), second.vertices.begin(), second.vertices.end());
  for (const Triangle& t : second.triangles) both.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  TriMesh turned = both;
  for (Triangle& t : turned.triangles) std::swap(t[1], t[2]);
  std::mt19937_64 random(4);
  const auto unit = [&random] { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
  for (const TriMesh& mesh : {both, turned}) {
    const Result<DistanceField> field = voxelise(mesh, {0.01, 0.05});
    ASSERT_TRUE(field);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p(0.4 * unit() - 0.17, 0.6 * unit() - 0.27, 0.4 * unit() - 0.18), q = p - Vec3(0.063, 0.041, 0.027);
      const Vec3 half(0.10, 0.20, 0.10);
      const double first = (p.cwiseAbs() - half).maxCoeff(), other = (q.cwiseAbs() - half).maxCoeff();
      // Within a voxel of where two walls cross, triangles inside the body are taken for its surface.
      const bool crossing = std::abs(first) < 0.012 && std::abs(other) < 0.012;
      if (!crossing && std::abs(std::min(first, other)) > 1e-3) {
        EXPECT_EQ(field->distance(p) < 0, std::min(first, other) < 0) << p.transpose();
      }
    }
  }
}

TEST(Voxelise, finds_the_same_patches_again_for_kept_values) {
  const TriMesh mesh = marched(sphere);
  const Result<DistanceField> field = voxelise(mesh);
  ASSERT_TRUE(field);
  DistanceField kept = *field;
  kept.patches = find_patches(mesh, kept, field->patches.overlaps);
  EXPECT_GT(kept.patches.reach.size(), 1000u);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-0.01, 0.01);
  for (const Vec3& v : mesh.vertices) {
    const Vec3 p = v + Vec3(unit(random), unit(random), unit(random));
    EXPECT_EQ(kept.distance(p), field->distance(p));
  }
}

TEST(Voxelise, sees_the_sign_right_when_vertices_lie_on_the_grid_lines) {
  // Every face, edge and corner of this box lies exactly on grid planes.
  const Result<DistanceField> field = voxelise(box_mesh(Vec3(0.25, 0.5, 0.125), Vec3::Zero()), {0.0625, 0.25});
  ASSERT_TRUE(field);
  for (int z = 0; z < field->size[2]; ++z)
    for (int y = 0; y < field->size[1]; ++y)
      for (int x = 0; x < field->size[0]; ++x) {
        const std::size_t i =
            x + static_cast<std::size_t>(field->size[0]) * (y + static_cast<std::size_t>(field->size[1]) * z);
        const Vec3 p = field->origin + 0.0625 * Vec3(x, y, z);
        const Vec3 q = p.cwiseAbs() - Vec3(0.25, 0.5, 0.125);
        const double exact = q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
        const double allowed = std::abs(exact) < 3 * 0.0625 ? 1e-6 : 0.5 * 0.0625;
        ASSERT_NEAR(field->values[i], exact, allowed) << p.transpose();
      }
}

TEST(Voxelise, gives_the_same_bytes_twice) {
  const TriMesh mesh = marched(sphere);
  EXPECT_EQ(voxelise(mesh)->values, voxelise(mesh)->values);
}

TEST(Voxelise, refuses_what_it_cannot_hold_or_tell_inside_from_outside) {
  TriMesh open = box_mesh(Vec3(0.2, 0.3, 0.1), Vec3::Zero());
  open.triangles.pop_back();
  EXPECT_EQ(voxelise(open).error().code, "NOT_WATERTIGHT");
  EXPECT_EQ(voxelise({}).error().code, "NOT_WATERTIGHT");
  TriMesh broken = box_mesh(Vec3(0.2, 0.3, 0.1), Vec3::Zero());
  broken.vertices[3].y() = std::nan("");
  EXPECT_EQ(voxelise(broken).error().code, "NOT_WATERTIGHT");
  broken = box_mesh(Vec3(0.2, 0.3, 0.1), Vec3::Zero());
  broken.triangles[0][0] = 77;
  EXPECT_EQ(voxelise(broken).error().code, "NOT_WATERTIGHT");
  EXPECT_EQ(voxelise(box_mesh(Vec3(200, 300, 100), Vec3::Zero())).error().code, "TOO_LARGE");
  EXPECT_EQ(voxelise(box_mesh(Vec3(1e300, 1, 1), Vec3::Zero())).error().code, "TOO_LARGE");
  EXPECT_EQ(voxelise(marched(sphere), {0.0, 0.08}).error().exit_code(), 64);
}

TEST(March, closes_every_surface_even_a_random_one) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 20; ++round) {
    // Noise on the grid itself: every cube configuration turns up, ambiguous ones included.
    const auto noise = [&](const Vec3& p) { return p.cwiseAbs().maxCoeff() > 0.85 ? 1.0 : unit(random); };
    const TriMesh mesh = body::march(noise, Vec3::Constant(-1), Vec3::Constant(1), 0.125, 10.0);
    const body::MeshState state = body::inspect(mesh);
    EXPECT_GT(mesh.triangles.size(), 500u);
    EXPECT_TRUE(state.closed()) << state.open_edges << ' ' << state.crowded_edges << ' ' << state.turned_edges;
    EXPECT_GT(body::signed_volume(mesh), 0);
  }
}

}  // namespace
}  // namespace vitrine
