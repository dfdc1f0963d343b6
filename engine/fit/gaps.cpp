// SPDX-License-Identifier: GPL-3.0-or-later
#include "gaps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace vitrine {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();
constexpr double hand = 0.2;  // [m] below the wrist

/// Whether the line along z through (x, y) meets the body.
bool meets(const DistanceField& field, double x, double y) {
  for (double z = 0; z <= (field.size[2] - 1) * field.spacing;) {
    const double free = field.distance(Vec3(x, y, field.origin.z() + z));
    if (free <= 0) return true;
    z += std::max(field.spacing, free);
  }
  return false;
}

}  // namespace

Gaps::Gaps(const Mannequin& mannequin, const DistanceField& field) {
  const int rows = static_cast<int>((field.size[1] - 1) * field.spacing / cell_) + 1;
  bottom_ = field.origin.y();
  const double widest = std::max(std::abs(field.origin.x()), field.origin.x() + (field.size[0] - 1) * field.spacing);
  for (const int side : {-1, 1}) {
    std::vector<double>& middle = middle_[side > 0];
    middle.assign(static_cast<std::size_t>(rows), none);
    std::vector<Vec3> arm;
    for (const char* name : {"shoulder", "elbow", "wrist"}) {
      const auto found = mannequin.landmarks.find(std::string(name) + (side < 0 ? "_left" : "_right"));
      if (found == mannequin.landmarks.end()) break;
      arm.push_back(found->second);
    }
    if (arm.size() < 3 || !(arm[0].y() > arm[1].y() && arm[1].y() > arm[2].y())) continue;  // not hanging
    arm.push_back(arm[2] + (arm[2] - arm[1]).normalized() * hand);
    for (int row = 0; row < rows; ++row) {
      const double y = bottom_ + row * cell_;
      if (y > arm[0].y() || y < arm[3].y()) continue;
      int k = 1;
      while (k < 3 && arm[k].y() > y) ++k;
      const double t = (arm[k - 1].y() - y) / std::max(1e-9, arm[k - 1].y() - arm[k].y());
      const double axis = std::abs(arm[k - 1].x() + t * (arm[k].x() - arm[k - 1].x()));
      // From the arm's middle inwards: off the arm, over the gap, onto the trunk (or a leg).
      double x = std::min(axis, widest);
      while (x > 0 && meets(field, side * x, y)) x -= cell_ / 2;
      const double outer = x;
      while (x > 0 && !meets(field, side * x, y)) x -= cell_ / 2;
      if (outer > 0 && x > 0) middle[row] = (outer + x) / 2;
    }
  }
}

double Gaps::middle_or_armpit(double y, int side) const {
  const std::vector<double>& rows = middle_[side > 0];
  for (std::size_t row = rows.size(); row-- > 0;)
    if (rows[row] != none) return middle(std::min(y, bottom_ + static_cast<double>(row) * cell_), side);
  return none;
}

double Gaps::middle(double y, int side) const {
  const std::vector<double>& rows = middle_[side > 0];
  const double row = (y - bottom_) / cell_;
  if (rows.empty() || !(row >= 0) || row > static_cast<double>(rows.size() - 1)) return none;
  return rows[static_cast<std::size_t>(row)];
}

}  // namespace vitrine
