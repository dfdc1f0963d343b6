// SPDX-License-Identifier: GPL-3.0-or-later
#include "align.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace vitrine::fidelity {
namespace {

struct Box {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::max()), high = -low;
};

Box box_of(const Mask& mask) {
  Box box;
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      if (!mask.on[static_cast<std::size_t>(y) * mask.width + x]) continue;
      box.low = box.low.cwiseMin(mask.centre(x, y));
      box.high = box.high.cwiseMax(mask.centre(x, y));
    }
  return box;
}

/// The search's four numbers about the middle of the flat silhouette, so that a change of scale does not shift it.
struct Numbers {
  Vec2 middle;              // [m] flat
  std::array<double, 4> v;  // shift x, y [m] of the middle; width, height [-]
  FlatToWorn fit() const {
    FlatToWorn f;
    f.width = v[2];
    f.height = v[3];
    f.shift = Vec2(v[0] - v[2] * middle.x(), v[1] - v[3] * middle.y());
    return f;
  }
};

}  // namespace

double overlap(const Mask& photo, const Mask& worn, const FlatToWorn& fit) {
  std::size_t common = 0, worn_count = 0;
  for (int y = 0; y < worn.height; ++y)
    for (int x = 0; x < worn.width; ++x) {
      if (!worn.on[static_cast<std::size_t>(y) * worn.width + x]) continue;
      ++worn_count;
      const Vec2 p = worn.centre(x, y) - fit.shift;
      common += photo.at(Vec2(p.x() / fit.width, p.y() / fit.height));
    }
  const double cell = worn.pixel * worn.pixel;
  const double photo_area = static_cast<double>(photo.count()) * photo.pixel * photo.pixel * fit.width * fit.height;
  const double both = static_cast<double>(common) * cell;
  return both / (photo_area + static_cast<double>(worn_count) * cell - both);
}

FlatToWorn align(const Mask& photo, const Mask& worn, FlatToWorn start, Freedom freedom, double& iou) {
  const Box flat = box_of(photo);
  Numbers best{(flat.low + flat.high) / 2, {}};
  const Vec2 at = start(best.middle);
  best.v = {at.x(), at.y(), start.width, start.height};
  iou = overlap(photo, worn, best.fit());
  const int moves = freedom == Freedom::shift ? 2 : freedom == Freedom::one_scale ? 3 : 4;
  for (double step = 1; step > 0.004; step /= 2) {
    for (bool better = true; better;) {
      better = false;
      for (int k = 0; k < moves; ++k)
        for (const double sign : {1.0, -1.0}) {
          Numbers tried = best;
          if (k < 2) {
            tried.v[k] += sign * 0.02 * step;
          } else {
            const double factor = 1 + sign * 0.04 * step;
            tried.v[k] *= factor;
            if (freedom == Freedom::one_scale) tried.v[3] *= factor;
          }
          const double found = overlap(photo, worn, tried.fit());
          if (found > iou + 1e-9) {
            iou = found;
            best = tried;
            better = true;
          }
        }
    }
  }
  return best.fit();
}

FlatToWorn box_on_box(const Mask& photo, const Mask& worn) {
  const Box from = box_of(photo), to = box_of(worn);
  FlatToWorn fit;
  fit.width = (to.high.x() - to.low.x()) / (from.high.x() - from.low.x());
  fit.height = (to.high.y() - to.low.y()) / (from.high.y() - from.low.y());
  fit.shift = to.low - Vec2(fit.width * from.low.x(), fit.height * from.low.y());
  return fit;
}

}  // namespace vitrine::fidelity
