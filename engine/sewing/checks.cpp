// SPDX-License-Identifier: GPL-3.0-or-later
#include "checks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

namespace vitrine::sewing {
namespace {

constexpr std::size_t most_nodes = 1'000'000, most_levels = 16;
constexpr double most_seam_ratio = 3;  // [-] more cannot be eased in: the points at the seam's ends are wrong

Error usage(std::string code, std::string message, std::string remedy) {
  return {Cause::usage, std::move(code), std::move(message), std::move(remedy), "sewing"};
}

Error unusable(std::string code, std::string message, std::string remedy) {
  return {Cause::unusable, std::move(code), std::move(message), std::move(remedy), "sewing"};
}

std::string millimetres(double metres) {
  return std::to_string(std::lround(1e3 * metres)) + " mm";
}

std::string number(double v) {
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", v);
  return text;
}

std::optional<Error> check_fabric(const Fabric& f) {
  const std::pair<const char*, double> fields[] = {
      {"stretch", f.stretch}, {"shear", f.shear}, {"bend", f.bend}, {"mass", f.mass}, {"friction", f.friction}};
  for (const auto& [name, value] : fields)
    if (!std::isfinite(value) || value < 0)
      return usage("FABRIC_VALUE", "fabric \"" + f.name + "\": " + name + " is " + number(value) + ".",
                   "Give a finite value of zero or more.");
  if (f.stretch == 0 && f.shear == 0)
    return usage("FABRIC_TOO_SOFT", "fabric \"" + f.name + "\": stretch and shear stiffness k are both 0 N/m.",
                 "Give the stiffness of a fabric, for example 1000 N/m.");
  if (f.stretch > 1e12 || f.shear > 1e12 || f.bend > 1e6 || f.mass > 1e6)
    return usage("FABRIC_VALUE", "fabric \"" + f.name + "\": a constant is larger than any sheet has.",
                 "Give k in N/m, bend in N m and mass in kg per square metre.");
  return std::nullopt;
}

std::optional<Error> check_options(const SewingOptions& o) {
  for (const auto& [name, value] : {std::pair{"spring_k", o.spring_k}, std::pair{"node_mass", o.node_mass}})
    if (!std::isfinite(value) || value < 0 || value > 1e12)
      return usage("SEWING_OPTION", std::string("sewing option ") + name + " is " + number(value) + ".",
                   "Give k in N/m and m in kg, or 0 for the fabric's own.");
  for (const auto& [name, value] : {std::pair{"max_error", o.max_error}, std::pair{"max_work", o.max_work}})
    if (!std::isfinite(value) || value < 0)
      return usage("SEWING_OPTION", std::string("sewing option ") + name + " is " + number(value) + ".",
                   "Give a finite value above zero, or 0 for none.");
  if ((o.max_error > 0 || o.max_work > 0) && (o.spring_k > 0 || o.node_mass > 0))
    return usage("SEWING_OPTION",
                 "spring_k and node_mass belong to one mesh, which max_error and max_work would choose.",
                 "Leave out either.");
  const std::pair<const char*, double> positive[] = {
      {"residual", o.residual}, {"coarse_residual", o.coarse_residual}, {"offset", o.offset}};
  for (const auto& [name, value] : positive)
    if (!std::isfinite(value) || value <= 0)
      return usage("SEWING_OPTION", std::string("sewing option ") + name + " is " + number(value) + ".",
                   "Give a finite value above zero.");
  if (!std::isfinite(o.gravity) || o.gravity < 0)
    return usage("SEWING_OPTION", "sewing option gravity is " + number(o.gravity) + ".", "Give 9.81 m/s^2.");
  if (!std::isfinite(o.max_weight_strain) || o.max_weight_strain < 0)
    return usage("SEWING_OPTION", "sewing option max_weight_strain is " + number(o.max_weight_strain) + ".",
                 "Give a share such as 0.001; 0 leaves k uncapped.");
  if (o.max_iterations < 1)
    return usage("SEWING_OPTION", "sewing option max_iterations is " + std::to_string(o.max_iterations) + ".",
                 "Give at least 1.");
  return std::nullopt;
}

double area_of(const PanelMesh& m) {
  double area = 0;
  for (const Triangle& t : m.triangles) {
    const Vec2 u = m.nodes[t[1]] - m.nodes[t[0]], w = m.nodes[t[2]] - m.nodes[t[0]];
    area += 0.5 * std::abs(u.x() * w.y() - u.y() * w.x());
  }
  return area;
}

std::optional<Error> check_pattern(const Pattern& p, std::size_t level) {
  const std::string where = "level " + std::to_string(level) + ": ";
  const std::string remedy = "Make the pattern again from the photos.";
  if (p.meshes.size() != 2)
    return unusable("PATTERN_PANELS", where + std::to_string(p.meshes.size()) + " panels instead of front and back.",
                    remedy);
  std::size_t total = 0;
  for (const PanelMesh& m : p.meshes) {
    if (m.nodes.size() < 3 || m.triangles.empty())
      return unusable("PATTERN_MESH", where + "a panel has no triangles.", remedy);
    total += m.nodes.size();
    for (const Vec2& n : m.nodes)
      if (!n.allFinite() || n.cwiseAbs().maxCoeff() > 100)
        return unusable("PATTERN_MESH", where + "a panel node is not a place within 100 m.", remedy);
    for (const Triangle& t : m.triangles)
      for (const auto i : t)
        if (i >= m.nodes.size())
          return unusable("PATTERN_MESH", where + "a triangle names a node that is not there.", remedy);
    if (area_of(m) < 1e-8) return unusable("PATTERN_MESH", where + "a panel has no area.", remedy);
  }
  if (total > most_nodes)
    return unusable("PATTERN_MESH", where + std::to_string(total) + " nodes are more than the sewing takes.",
                    "Use a longer edge length.");
  for (const NodePair& q : p.pairs)
    for (const auto& [panel, node] : {std::pair{q.panel_a, q.node_a}, std::pair{q.panel_b, q.node_b}})
      if (panel < 0 || panel > 1 || node < 0 || static_cast<std::size_t>(node) >= p.meshes[panel].nodes.size())
        return unusable("PATTERN_SEAM", where + "a seam names a node that is not there.", remedy);
  return std::nullopt;
}

/// A piece that no seam joins to the rest would fall for ever.
std::optional<Error> check_pieces(const Pattern& p, std::size_t level) {
  std::vector<std::size_t> base{0};
  for (const PanelMesh& m : p.meshes) base.push_back(base.back() + m.nodes.size());
  std::vector<std::size_t> parent(base.back());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<char> in_use(parent.size(), 0);
  for (std::size_t panel = 0; panel < p.meshes.size(); ++panel)
    for (const Triangle& t : p.meshes[panel].triangles)
      for (const auto i : t) {
        in_use[base[panel] + i] = 1;
        parent[root(base[panel] + i)] = root(base[panel] + t[0]);
      }
  for (const NodePair& q : p.pairs) parent[root(base[q.panel_a] + q.node_a)] = root(base[q.panel_b] + q.node_b);
  std::vector<std::size_t> size(parent.size(), 0);
  for (std::size_t i = 0; i < parent.size(); ++i)
    if (in_use[i]) ++size[root(i)];
  const auto pieces = std::count_if(size.begin(), size.end(), [](std::size_t n) { return n > 0; });
  if (pieces == 1) return std::nullopt;
  const auto largest = std::max_element(size.begin(), size.end());
  for (std::size_t i = 0; i < size.size(); ++i)
    if (size[i] > 0 && i != static_cast<std::size_t>(largest - size.begin())) {
      const std::size_t panel = i < base[1] ? 0 : 1;
      return unusable("PATTERN_PIECES",
                      "level " + std::to_string(level) + ": a piece of " + std::to_string(size[i]) + " nodes in the " +
                          (panel == 0 ? "front" : "back") + " panel is sewn to nothing and would fall.",
                      "Add the seam that joins it, or leave it out.");
    }
  return std::nullopt;
}

/// Seams that are sewn the wrong way round, or join edges of lengths that do not belong together.
std::optional<Error> check_seams(const Pattern& p, std::size_t level, const Positions* placed) {
  struct Seam {
    double length_a = 0, length_b = 0;
    int steps = 0, crossed = 0;
  };
  std::map<int, Seam> seams;
  for (std::size_t i = 1; i < p.pairs.size(); ++i) {
    const NodePair &r = p.pairs[i - 1], &q = p.pairs[i];
    if (q.seam != r.seam || q.panel_a != r.panel_a || q.panel_b != r.panel_b) continue;
    Seam& s = seams[q.seam];
    s.length_a += (p.meshes[q.panel_a].nodes[q.node_a] - p.meshes[r.panel_a].nodes[r.node_a]).norm();
    s.length_b += (p.meshes[q.panel_b].nodes[q.node_b] - p.meshes[r.panel_b].nodes[r.node_b]).norm();
    if (!placed) continue;
    const auto at = [&](int panel, int node) { return (*placed)[panel][node]; };
    const Vec3 a0 = at(r.panel_a, r.node_a), a1 = at(q.panel_a, q.node_a);
    const Vec3 b0 = at(r.panel_b, r.node_b), b1 = at(q.panel_b, q.node_b);
    ++s.steps;
    s.crossed += (a0 - b1).norm() + (a1 - b0).norm() < (a0 - b0).norm() + (a1 - b1).norm() - 1e-9;
  }
  for (const auto& [number, s] : seams) {
    const std::string where = "level " + std::to_string(level) + ": seam " + std::to_string(number) + " ";
    const double longer = std::max(s.length_a, s.length_b), shorter = std::min(s.length_a, s.length_b);
    if (longer > most_seam_ratio * shorter)
      return unusable(
          "PATTERN_SEAM",
          where + "joins an edge of " + millimetres(s.length_a) + " to one of " + millimetres(s.length_b) + ".",
          "Check the feature points at its ends.");
    if (s.steps >= 3 && 2 * s.crossed > s.steps)
      return unusable("PATTERN_SEAM", where + "joins two edges that run against each other: the panels would twist.",
                      "Flip the seam: set `reversed` in the garment's seam map, or take it out.");
  }
  return std::nullopt;
}

std::optional<Error> check_body(const DistanceField& b, const Positions& placed) {
  const bool sized = b.size[0] >= 2 && b.size[1] >= 2 && b.size[2] >= 2 && b.origin.allFinite() &&
                     std::isfinite(b.spacing) && b.spacing > 0 &&
                     b.values.size() == static_cast<std::size_t>(b.size[0]) * b.size[1] * b.size[2];
  if (!sized)
    return unusable("NO_BODY", "the body's distance field is empty or does not match its size.",
                    "Voxelise a closed mannequin first.");
  // All exponent bits set is how infinities and NaNs are told; without a branch, as the field has millions of values.
  std::uint32_t odd = 0;
  for (const float v : b.values)
    odd |= static_cast<std::uint32_t>((std::bit_cast<std::uint32_t>(v) & 0x7f800000u) == 0x7f800000u);
  if (odd)
    return unusable("NO_BODY", "the body's distance field holds a value that is not a number.",
                    "Use a closed mannequin mesh.");
  const auto corner = [&](int k) {
    const std::size_t x = k & 1 ? b.size[0] - 1 : 0, y = k & 2 ? b.size[1] - 1 : 0, z = k & 4 ? b.size[2] - 1 : 0;
    return b.values[(z * b.size[1] + y) * b.size[0] + x];
  };
  for (int k = 0; k < 8; ++k)
    if (corner(k) <= 0)
      return unusable("NO_BODY", "the body's distance field is inside out, or the body fills it to a corner.",
                      "Voxelise a closed mannequin whose normals point outwards.");
  Vec3 lo = placed.front().front(), hi = lo;
  for (const auto& panel : placed)
    for (const Vec3& p : panel) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
  const Vec3 far = b.origin + b.spacing * Vec3(b.size[0] - 1, b.size[1] - 1, b.size[2] - 1);
  for (int a = 0; a < 3; ++a)
    if (hi[a] < b.origin[a] || lo[a] > far[a])
      return unusable("NOT_SUPPORTED", "the panels are placed beside the body, so nothing holds the garment.",
                      "Check that garment and mannequin use metres and stand at the same place.");
  return std::nullopt;
}

}  // namespace

Fabric as_sheet(const Pattern& pattern, Fabric fabric, const SewingOptions& options) {
  // On an equilateral mesh an edge has a share of L^2 sqrt(3)/2 of the area, so that k = K sqrt(3)/2.
  if (options.spring_k > 0) fabric.stretch = fabric.shear = options.spring_k * 2 / std::sqrt(3.0);
  if (options.node_mass > 0) {
    double area = 0, nodes = 0;
    for (const PanelMesh& m : pattern.meshes) {
      nodes += static_cast<double>(m.nodes.size());
      area += area_of(m);
    }
    fabric.mass = options.node_mass * nodes / area;
  }
  return fabric;
}

double column_weight(const Pattern& pattern, const Fabric& fabric, double gravity) {
  double most = 0;
  for (const PanelMesh& m : pattern.meshes) {
    double lo = m.nodes.front().y(), hi = lo;
    for (const Vec2& p : m.nodes) lo = std::min(lo, p.y()), hi = std::max(hi, p.y());
    most = std::max(most, hi - lo);
  }
  return fabric.mass * gravity * most;
}

double nodes_of(const Pattern& pattern) {
  double nodes = 0;
  for (const PanelMesh& m : pattern.meshes) nodes += static_cast<double>(m.nodes.size());
  return nodes;
}

std::optional<Error> check_count(const PatternLevels& levels) {
  if (levels.nodes.empty() || levels.nodes.size() > most_levels)
    return unusable("PATTERN_LEVELS", std::to_string(levels.nodes.size()) + " pattern levels cannot be sewn.",
                    "Give between 1 and 16 levels.");
  return std::nullopt;
}

std::optional<Error> check_level(const Pattern& pattern, int level) {
  const auto number = static_cast<std::size_t>(level);
  if (auto e = check_pattern(pattern, number)) return e;
  if (auto e = check_pieces(pattern, number)) return e;
  return check_seams(pattern, number, nullptr);
}

std::optional<Error> check_input(const Pattern& first, const Pattern& measure, const Positions& placed,
                                 const Fabric& given, const DistanceField& body, const SewingOptions& options) {
  if (auto e = check_options(options)) return e;
  if (auto e = check_fabric(given)) return e;
  if (auto e = check_pattern(first, 0)) return e;
  bool fits = placed.size() == 2;
  for (std::size_t p = 0; fits && p < 2; ++p) fits = placed[p].size() == first.meshes[p].nodes.size();
  if (!fits)
    return unusable("PLACEMENT", "the placed panels do not have the nodes of the first level.",
                    "Place the panels of the coarsest level.");
  for (const auto& panel : placed)
    for (const Vec3& p : panel)
      if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1000)
        return unusable("PLACEMENT", "a placed node is not a place within 1 km.", "Place the panels again.");
  if (auto e = check_pieces(first, 0)) return e;
  if (auto e = check_seams(first, 0, &placed)) return e;
  if (auto e = check_body(body, placed)) return e;
  const Fabric fabric = as_sheet(measure, given, options);
  const double column = column_weight(measure, fabric, options.gravity);
  const double strain = column / std::max(fabric.stretch, 1e-300);
  if (strain > 1)
    return usage("FABRIC_TOO_SOFT",
                 "fabric \"" + fabric.name + "\" with k = " + number(fabric.stretch) +
                     " N/m and m = " + number(fabric.mass) + " kg/m^2 would stretch by " + number(100 * strain) +
                     " % under its own weight.",
                 "Use a stiffness k of at least " + number(column) +
                     " N/m, better a hundred times as much, or a lighter fabric.");
  return std::nullopt;
}

}  // namespace vitrine::sewing
