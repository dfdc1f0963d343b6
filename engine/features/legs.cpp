// SPDX-License-Identifier: GPL-3.0-or-later
#include "legs.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sleeves.hpp"

namespace vitrine::features_detail {
namespace {

constexpr double kMiddle = 0.2;        // a gap's middle may lie so far off the box's, share of the width
constexpr double kLeastGap = 0.012;    // height, share of the diagonal: less is a dent of the hem
constexpr double kLeastShare = 0.12;   // of the leg that must be seen apart for the rest to be guessed
constexpr double kBelowBody = 1.1;     // cloth's crotch hangs lower than the body's, times the rise
constexpr double kTooLow = 1.45;       // times the expected rise: no trousers are made like that
constexpr double kHighest = 0.7;       // times the expected rise: no gap of legs ends above that
constexpr double kWaistLevel = 0.05;   // where the waist's width is read, share of the height
constexpr double kFarthestEye = 0.15;  // up to where a needle's eye is followed, share of the height

/// The ground between two legs, row by row.
struct Gap {
  std::vector<int> row, left, right;  // [px] first and last ground pixel of each row, from the top down
  Vec2 top() const { return Vec2((left.front() + right.front()) / 2.0, row.front()); }
  Vec2 end() const { return Vec2((left.back() + right.back()) / 2.0, row.back()); }
};

/// The tallest piece of ground near the middle line with cloth on either side.
Gap find_gap(const cv::Mat& mask, const cv::Rect& box) {
  cv::Mat between = cv::Mat::zeros(mask.size(), CV_8U);
  for (int y = box.y; y < box.br().y; ++y) {
    const uchar* row = mask.ptr<uchar>(y);
    int first = box.x, last = box.br().x - 1;
    while (first <= last && !row[first]) ++first;
    while (last >= first && !row[last]) --last;
    for (int x = first; x <= last; ++x) between.at<uchar>(y, x) = row[x] ? 0 : 255;
  }
  cv::Mat labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(between, labels, stats, centres, 4);
  int best = -1;
  for (int i = 1; i < count; ++i) {
    const double u = (centres.at<double>(i, 0) - box.x) / box.width;
    const double v = (centres.at<double>(i, 1) - box.y) / box.height;
    if (std::abs(u - 0.5) > kMiddle || v < 0.3) continue;
    if (best < 0 || stats.at<int>(i, cv::CC_STAT_HEIGHT) > stats.at<int>(best, cv::CC_STAT_HEIGHT)) best = i;
  }
  Gap gap;
  if (best < 0) return gap;
  const cv::Rect around(stats.at<int>(best, cv::CC_STAT_LEFT), stats.at<int>(best, cv::CC_STAT_TOP),
                        stats.at<int>(best, cv::CC_STAT_WIDTH), stats.at<int>(best, cv::CC_STAT_HEIGHT));
  for (int y = around.y; y < around.br().y; ++y) {
    int left = -1, right = -1;
    for (int x = around.x; x < around.br().x; ++x)
      if (labels.at<int>(y, x) == best) {
        if (left < 0) left = x;
        right = x;
      }
    gap.row.push_back(y);
    gap.left.push_back(left);
    gap.right.push_back(right);
  }
  return gap;
}

/// Height [px] at which straight sides of the gap would meet, by least squares over its middle part.
double where_sides_meet(const Gap& gap) {
  const std::size_t n = gap.row.size(), from = n / 5, to = n - n / 5;
  double count = 0, sy = 0, sw = 0, syy = 0, syw = 0;
  for (std::size_t i = from; i < to; ++i) {
    const double y = gap.row[i], w = gap.right[i] - gap.left[i] + 1;
    count += 1, sy += y, sw += w, syy += y * y, syw += y * w;
  }
  const double spread = count * syy - sy * sy;
  const double slope = spread > 0 ? (count * syw - sy * sw) / spread : 0;
  if (slope < 0.01) return gap.row.front();
  return std::min<double>(gap.row.front(), (sy - sw / slope) / count);
}

int width_at(const cv::Mat& mask, const cv::Rect& box, int y, double& middle) {
  int first = -1, last = -1;
  for (int x = box.x; x < box.br().x; ++x)
    if (mask.at<uchar>(y, x)) {
      if (first < 0) first = x;
      last = x;
    }
  middle = (first + last) / 2.0;
  return first < 0 ? 0 : last - first + 1;
}

}  // namespace

bool is_leg(const GarmentTemplate& garment, const TemplateLimb& limb) {
  const auto in_the_middle = [&](int f) {
    return f >= 0 && f < static_cast<int>(garment.features.size()) && garment.features[f].mirror == f;
  };
  return in_the_middle(limb.root_a) || in_the_middle(limb.root_b);
}

int crotch_of(const GarmentTemplate& garment) {
  for (const TemplateLimb& limb : garment.limbs)
    for (const int f : {limb.root_a, limb.root_b})
      if (f >= 0 && f < static_cast<int>(garment.features.size()) && garment.features[f].mirror == f) return f;
  return -1;
}

bool has_sleeves(const GarmentTemplate& garment) {
  return std::any_of(garment.limbs.begin(), garment.limbs.end(),
                     [&](const TemplateLimb& limb) { return !is_leg(garment, limb); });
}

LegCut open_legs(cv::Mat& mask, const GarmentTemplate& garment) {
  LegCut cut;
  const cv::Rect box = cv::boundingRect(mask);
  const double diagonal = std::hypot(box.width, box.height);
  const Gap gap = find_gap(mask, box);
  if (static_cast<double>(gap.row.size()) < kLeastGap * diagonal) return cut;
  cut.gap = true;
  // Hems that touch close the gap below.
  const Vec2 end = gap.end();
  int below = static_cast<int>(end.y()) + 1;
  bool closed = false;
  for (int y = below; y < box.br().y; ++y)
    if (mask.at<uchar>(y, static_cast<int>(end.x()))) closed = true, below = y;
  if (closed) cut_slit(mask, end, Vec2(end.x(), below + 2), diagonal);

  double middle = 0;
  const int level = box.y + static_cast<int>(kWaistLevel * box.height);
  const int waist = width_at(mask, box, level, middle);
  const double rise = kBelowBody * expected_drop(garment, garment.scale.top, crotch_of(garment), waist);
  const Vec2 top = gap.top();
  if (waist < 4 || !(rise > 0)) return cut;
  double crotch = std::max({where_sides_meet(gap), box.y + kHighest * rise, top.y() - kFarthestEye * box.height});
  if (crotch > box.y + kTooLow * rise) {
    const double leg = end.y() - (box.y + rise);
    if (static_cast<double>(gap.row.size()) < kLeastShare * leg) return cut;
    crotch = box.y + rise;
    cut.guessed = true;
  }
  if (crotch >= top.y() - 1) return cut;
  // Towards the middle of the waist.
  const double share = (top.y() - crotch) / (top.y() - level);
  cut_slit(mask, top, Vec2(top.x() + share * (middle - top.x()), crotch), diagonal);
  return cut;
}

}  // namespace vitrine::features_detail
