// SPDX-License-Identifier: GPL-3.0-or-later
#include "checks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

namespace vitrine::sewing {
namespace {

constexpr std::size_t most_nodes = 1'000'000, most_levels = 16;

Error usage(std::string code, std::string message, std::string remedy) {
  return {Cause::usage, std::move(code), std::move(message), std::move(remedy), "sewing"};
}

Error unusable(std::string code, std::string message, std::string remedy) {
  return {Cause::unusable, std::move(code), std::move(message), std::move(remedy), "sewing"};
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
    double area = 0;
    for (const Triangle& t : m.triangles) {
      for (const auto i : t)
        if (i >= m.nodes.size())
          return unusable("PATTERN_MESH", where + "a triangle names a node that is not there.", remedy);
      const Vec2 u = m.nodes[t[1]] - m.nodes[t[0]], w = m.nodes[t[2]] - m.nodes[t[0]];
      area += 0.5 * std::abs(u.x() * w.y() - u.y() * w.x());
    }
    if (area < 1e-8) return unusable("PATTERN_MESH", where + "a panel has no area.", remedy);
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

double column_weight(const Pattern& pattern, const Fabric& fabric, double gravity) {
  double most = 0;
  for (const PanelMesh& m : pattern.meshes) {
    double lo = m.nodes.front().y(), hi = lo;
    for (const Vec2& p : m.nodes) lo = std::min(lo, p.y()), hi = std::max(hi, p.y());
    most = std::max(most, hi - lo);
  }
  return fabric.mass * gravity * most;
}

std::optional<Error> check_input(std::span<const Pattern> levels, const Positions& placed, const Fabric& fabric,
                                 const DistanceField& body, const SewingOptions& options) {
  if (levels.empty() || levels.size() > most_levels)
    return unusable("PATTERN_LEVELS", std::to_string(levels.size()) + " pattern levels cannot be sewn.",
                    "Give between 1 and 16 levels.");
  if (auto e = check_options(options)) return e;
  if (auto e = check_fabric(fabric)) return e;
  for (std::size_t l = 0; l < levels.size(); ++l)
    if (auto e = check_pattern(levels[l], l)) return e;
  bool fits = placed.size() == 2;
  for (std::size_t p = 0; fits && p < 2; ++p) fits = placed[p].size() == levels.front().meshes[p].nodes.size();
  if (!fits)
    return unusable("PLACEMENT", "the placed panels do not have the nodes of the first level.",
                    "Place the panels of the coarsest level.");
  for (const auto& panel : placed)
    for (const Vec3& p : panel)
      if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1000)
        return unusable("PLACEMENT", "a placed node is not a place within 1 km.", "Place the panels again.");
  if (auto e = check_body(body, placed)) return e;
  const double column = column_weight(levels.back(), fabric, options.gravity);
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
