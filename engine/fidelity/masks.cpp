// SPDX-License-Identifier: GPL-3.0-or-later
#include "masks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrine::fidelity {
namespace {

constexpr int most_pixels = 1 << 24;

/// Sets the pixels whose centres lie in the polygon.
void fill_polygon(Mask& mask, const std::vector<Vec2>& polygon) {
  std::vector<double> crossings;
  for (int y = 0; y < mask.height; ++y) {
    const double level = mask.centre(0, y).y();
    crossings.clear();
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
      const Vec2 &a = polygon[i], &b = polygon[j];
      if ((a.y() > level) != (b.y() > level))
        crossings.push_back((b.x() - a.x()) * (level - a.y()) / (b.y() - a.y()) + a.x());
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const auto column = [&](double x) { return std::ceil((x - mask.top_left.x()) / mask.pixel - 0.5); };
      const int first = static_cast<int>(std::clamp(column(crossings[k]), 0.0, static_cast<double>(mask.width)));
      const int end = static_cast<int>(std::clamp(column(crossings[k + 1]), 0.0, static_cast<double>(mask.width)));
      const auto row = mask.on.begin() + static_cast<std::ptrdiff_t>(y) * mask.width;
      std::fill(row + first, row + std::max(first, end), std::uint8_t{1});
    }
  }
}

bool in_polygon(const Vec2& p, const std::vector<Vec2>& polygon) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      inside = !inside;
  }
  return inside;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double t = std::clamp((p - a).dot(d) / std::max(1e-18, d.squaredNorm()), 0.0, 1.0);
  return (p - a - t * d).squaredNorm();
}

/// Whether the piece of outline nearest to p is a sleeve's: silhouette that the panel's chords cut off goes with the
/// part that it lies at.
bool beside_sleeve(const Vec2& p, const Panel& panel, const std::vector<char>& sleeve_segment) {
  double best = std::numeric_limits<double>::max();
  bool beside = false;
  for (std::size_t i = 0; i < panel.outline.size(); ++i) {
    const double d = distance_to_segment(p, panel.outline[i], panel.outline[(i + 1) % panel.outline.size()]);
    if (d < best) {
      best = d;
      beside = sleeve_segment[i];
    }
  }
  return beside;
}

bool is_in(const std::vector<Sleeve>& sleeves, const Vec2& rest) {
  return std::any_of(sleeves.begin(), sleeves.end(), [&](const Sleeve& s) { return in_polygon(rest, s.polygon); });
}

/// Sets the pixels that a triangle of cloth covers; `keep` judges the rest position, where it is given.
template <class Keep>
void fill_triangle(Mask& mask, const std::array<Vec2, 3>& p, const std::array<Vec2, 3>& rest, Keep&& keep) {
  const double twice = (p[1] - p[0]).x() * (p[2] - p[0]).y() - (p[1] - p[0]).y() * (p[2] - p[0]).x();
  if (std::abs(twice) < 1e-18) return;  // seen edge on
  const auto [low_x, high_x] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
  const auto [low_y, high_y] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
  const auto column = [&](double x) { return static_cast<int>(std::floor((x - mask.top_left.x()) / mask.pixel)); };
  const auto row = [&](double y) { return static_cast<int>(std::floor((mask.top_left.y() - y) / mask.pixel)); };
  for (int y = std::max(0, row(high_y)); y <= std::min(mask.height - 1, row(low_y)); ++y) {
    for (int x = std::max(0, column(low_x)); x <= std::min(mask.width - 1, column(high_x)); ++x) {
      std::uint8_t& on = mask.on[static_cast<std::size_t>(y) * mask.width + x];
      if (on) continue;
      const Vec2 q = mask.centre(x, y);
      const auto area = [&](int i, int j) {
        return ((p[i] - q).x() * (p[j] - q).y() - (p[i] - q).y() * (p[j] - q).x()) / twice;
      };
      const double a = area(1, 2), b = area(2, 0), c = area(0, 1);
      if (a < 0 || b < 0 || c < 0) continue;
      on = keep(a * rest[0] + b * rest[1] + c * rest[2]);
    }
  }
}

}  // namespace

Mask::Mask(const Vec2& low, const Vec2& high, double edge) : top_left(low.x(), high.y()), pixel(edge) {
  const double columns = std::ceil((high.x() - low.x()) / edge), rows = std::ceil((high.y() - low.y()) / edge);
  if (!(columns >= 1 && rows >= 1 && columns * rows <= most_pixels)) return;
  width = static_cast<int>(columns);
  height = static_cast<int>(rows);
  on.assign(static_cast<std::size_t>(width) * height, 0);
}

bool Mask::at(const Vec2& p) const {
  const double x = (p.x() - top_left.x()) / pixel, y = (top_left.y() - p.y()) / pixel;
  if (!(x >= 0 && y >= 0 && x < width && y < height)) return false;
  return on[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
}

std::size_t Mask::count() const {
  return static_cast<std::size_t>(std::count(on.begin(), on.end(), std::uint8_t{1}));
}

Mask turned(const Mask& mask, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const Vec2 half = mask.pixel / 2 * Vec2(mask.width, mask.height);
  const Vec2 middle = mask.top_left + Vec2(half.x(), -half.y());
  const Vec2 reach(std::abs(c) * half.x() + std::abs(s) * half.y(), std::abs(s) * half.x() + std::abs(c) * half.y());
  Mask out(middle - reach, middle + reach, mask.pixel);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const Vec2 d = out.centre(x, y) - middle;
      out.on[static_cast<std::size_t>(y) * out.width + x] =
          mask.at(middle + Vec2(c * d.x() + s * d.y(), c * d.y() - s * d.x()));
    }
  return out;
}

Mask legs_swung(const Mask& mask, const Vec2& crotch, double slope) {
  const Vec2 low = mask.top_left + mask.pixel * Vec2(0, -mask.height), high(low.x() + mask.pixel * mask.width, 0);
  const double reach = std::abs(slope) * std::max(0.0, crotch.y() - low.y());
  Mask out({low.x() - reach, low.y()}, {high.x() + reach, mask.top_left.y()}, mask.pixel);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const Vec2 p = out.centre(x, y), by(slope * std::max(0.0, crotch.y() - p.y()), 0);
      const bool left = p.x() + by.x() < crotch.x() && mask.at(p + by);
      const bool right = p.x() - by.x() >= crotch.x() && mask.at(p - by);
      out.on[static_cast<std::size_t>(y) * out.width + x] = left || right;
    }
  return out;
}

std::vector<Sleeve> sleeves_of(const GarmentTemplate& garment, const Panel& panel) {
  std::vector<Sleeve> sleeves;
  const int n = static_cast<int>(panel.outline.size());
  for (const TemplateLimb& limb : garment.limbs) {
    const auto roots_in = [&](int feature) {
      return std::count_if(garment.limbs.begin(), garment.limbs.end(),
                           [&](const TemplateLimb& l) { return l.root_a == feature || l.root_b == feature; });
    };
    if (roots_in(limb.root_a) > 1 || roots_in(limb.root_b) > 1) continue;
    // Of the two ways around the outline the one that passes the tip.
    for (const auto& [from, to] : {std::pair{limb.root_a, limb.root_b}, std::pair{limb.root_b, limb.root_a}}) {
      Sleeve sleeve{limb.name, {}, {}};
      bool tip = false;
      for (int i = panel.corner[from];; i = (i + 1) % n) {
        sleeve.nodes.push_back(i);
        sleeve.polygon.push_back(panel.outline[i]);
        tip = tip || i == panel.corner[limb.tip_a];
        if (i == panel.corner[to]) break;
      }
      if (tip) {
        sleeves.push_back(std::move(sleeve));
        break;
      }
    }
  }
  return sleeves;
}

Mask photo_mask(const Image& labels, const Panel& panel, std::span<const Sleeve> sleeves, int rows) {
  const Affine2 panel_from_pixel = panel.pixel_from_panel.inverse();
  const Affine2& pixel_from_panel = panel.pixel_from_panel;
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::max()), high = -low;
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      if (*labels.at(x, y) == label_background) continue;
      const Vec2 p = panel_from_pixel(Vec2(x, y));
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  if (!(high.y() > low.y())) return {};
  Mask mask(low, high, (high.y() - low.y()) / rows);
  std::vector<char> sleeve_segment(panel.outline.size(), 0);
  Mask cloth = mask, sleeve = mask;
  if (!sleeves.empty()) fill_polygon(cloth, panel.outline);
  for (const Sleeve& s : sleeves) {
    fill_polygon(sleeve, s.polygon);
    for (std::size_t i = 0; i + 1 < s.nodes.size(); ++i) sleeve_segment[s.nodes[i]] = 1;
  }
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      const Vec2 p = mask.centre(x, y), q = pixel_from_panel(p);
      const long px = std::lround(q.x()), py = std::lround(q.y());
      if (px < 0 || py < 0 || px >= labels.width || py >= labels.height) continue;
      if (*labels.at(static_cast<int>(px), static_cast<int>(py)) == label_background) continue;
      const std::size_t i = static_cast<std::size_t>(y) * mask.width + x;
      mask.on[i] = sleeves.empty() || (cloth.on[i] ? !sleeve.on[i] : !beside_sleeve(p, panel, sleeve_segment));
    }
  return mask;
}

Mask worn_mask(const GarmentTemplate& garment, const Pattern& pattern, std::span<const std::vector<Vec3>> positions,
               int rows) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::max()), high = -low;
  std::vector<std::vector<Sleeve>> sleeves;
  std::vector<std::vector<char>> beyond;  // per panel and node: on a sleeve
  for (std::size_t panel = 0; panel < pattern.panels.size(); ++panel) {
    sleeves.push_back(sleeves_of(garment, pattern.panels[panel]));
    beyond.emplace_back();
    for (std::size_t i = 0; i < positions[panel].size(); ++i) {
      beyond.back().push_back(is_in(sleeves.back(), pattern.meshes[panel].nodes[i]));
      const Vec2 p = positions[panel][i].head<2>();
      if (beyond.back().back() || !p.allFinite()) continue;
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  if (!(high.y() > low.y())) return {};
  Mask mask(low, high, (high.y() - low.y()) / rows);
  if (mask.on.empty()) return mask;
  for (std::size_t panel = 0; panel < pattern.panels.size(); ++panel) {
    const auto& nodes = pattern.meshes[panel].nodes;
    for (const Triangle& t : pattern.meshes[panel].triangles) {
      const std::array<Vec2, 3> rest{nodes[t[0]], nodes[t[1]], nodes[t[2]]};
      std::array<Vec2, 3> p;
      for (int k = 0; k < 3; ++k) p[k] = positions[panel][t[k]].head<2>();
      const int corners_beyond = beyond[panel][t[0]] + beyond[panel][t[1]] + beyond[panel][t[2]];
      if (corners_beyond == 3 && is_in(sleeves[panel], (rest[0] + rest[1] + rest[2]) / 3)) continue;
      if (corners_beyond == 0 && !is_in(sleeves[panel], (rest[0] + rest[1] + rest[2]) / 3))
        fill_triangle(mask, p, rest, [](const Vec2&) { return true; });
      else
        fill_triangle(mask, p, rest, [&](const Vec2& r) { return !is_in(sleeves[panel], r); });
    }
  }
  return mask;
}

}  // namespace vitrine::fidelity
