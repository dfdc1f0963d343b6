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

Overlay::Overlay(const Mask& photo, const Mask& worn)
    : width_(photo.width),
      height_(photo.height),
      pixel_(photo.pixel),
      worn_pixel_(worn.pixel),
      top_left_(photo.top_left) {
  const Box box = box_of(photo);
  low_ = box.low;
  high_ = box.high;
  sums_.reserve(static_cast<std::size_t>(width_ + 1) * height_);
  for (int y = 0; y < height_; ++y) {
    std::uint32_t sum = 0;
    sums_.push_back(0);
    for (int x = 0; x < width_; ++x) sums_.push_back(sum += photo.on[static_cast<std::size_t>(y) * width_ + x]);
    photo_area_ += sum * pixel_ * pixel_;
  }
  for (int y = 0; y < worn.height; ++y) {
    const std::uint8_t* row = &worn.on[static_cast<std::size_t>(y) * worn.width];
    for (int x = 0; x < worn.width;) {
      const int first = x;
      while (x < worn.width && row[x]) ++x;
      if (x > first) {
        const double half = worn.pixel / 2;
        runs_.push_back({worn.centre(0, y).y(), worn.centre(first, y).x() - half, worn.centre(x, y).x() - half});
        worn_area_ += (x - first) * worn.pixel * worn.pixel;
      }
      while (x < worn.width && !row[x]) ++x;
    }
  }
}

/// Pixels of a photo's row that are set before a column, parts of pixels too.
double Overlay::covered(int row, double column) const {
  const double c = std::clamp(column, 0.0, static_cast<double>(width_));
  const int whole = std::min(static_cast<int>(c), width_ - 1);
  const std::uint32_t* sums = &sums_[static_cast<std::size_t>(row) * (width_ + 1)];
  return sums[whole] + (c - whole) * (sums[whole + 1] - sums[whole]);
}

double Overlay::iou(const FlatToWorn& fit) const {
  double both = 0;
  for (const Run& run : runs_) {
    const double row = (top_left_.y() - (run.y - fit.shift.y()) / fit.height) / pixel_;
    if (!(row >= 0 && row < height_)) continue;
    const auto column = [&](double x) { return ((x - fit.shift.x()) / fit.width - top_left_.x()) / pixel_; };
    both += covered(static_cast<int>(row), column(run.to)) - covered(static_cast<int>(row), column(run.from));
  }
  both *= pixel_ * fit.width * worn_pixel_;
  return both / (photo_area_ * fit.width * fit.height + worn_area_ - both);
}

FlatToWorn Overlay::align(FlatToWorn start, Freedom freedom, double& best_iou) const {
  Numbers best{(low_ + high_) / 2, {}};
  const Vec2 at = start(best.middle), half = (high_ - low_) / 2;
  best.v = {at.x(), at.y(), start.width, start.height};
  best_iou = iou(best.fit());
  // Moves of {shift x, shift y, width, height}; a side of the box moves with half the shift and the scale that keeps
  // the other side where it is.
  const double x = 0.01, y = 0.01, w = x / half.x(), h = y / half.y();
  std::vector<std::array<double, 4>> moves = {{0.02, 0, 0, 0}, {0, 0.02, 0, 0}};
  if (freedom == Freedom::one_scale) moves.push_back({0, 0, 0.04, 0.04});
  if (freedom == Freedom::two_scales)
    for (const std::array<double, 4>& move : {std::array<double, 4>{0, 0, 0.04, 0},
                                              {0, 0, 0, 0.04},
                                              {x, 0, w, 0},
                                              {x, 0, -w, 0},
                                              {0, y, 0, h},
                                              {0, y, 0, -h}})
      moves.push_back(move);
  for (double step = 1; step > 0.004; step /= 2) {
    for (bool better = true; better;) {
      better = false;
      for (const auto& move : moves)
        for (const double sign : {step, -step}) {
          Numbers tried = best;
          for (int k = 0; k < 2; ++k) tried.v[k] += sign * move[k];
          for (int k = 2; k < 4; ++k) tried.v[k] *= 1 + sign * move[k];
          if (!(tried.v[2] > 0.01 && tried.v[3] > 0.01)) continue;
          const double found = iou(tried.fit());
          if (found > best_iou + 1e-9) {
            best_iou = found;
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
