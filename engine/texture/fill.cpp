// SPDX-License-Identifier: GPL-3.0-or-later
#include "fill.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace vitrine {
namespace {

constexpr int kRing = 3;           // [px] of surroundings that are compared
constexpr int kOffsets = 4000;     // tried for a block, about
constexpr int kRingSamples = 160;  // pixels compared for each
// What the block would show counts where it differs from its surroundings: a stray mark is not to be copied.
constexpr double kMarkWeight = 0.3;
constexpr int kMarkSamples = 6;  // to each side of a block
// Steps that differ from the usual one by more come from pattern that does not meet, not from light.
constexpr float kOddStep = 30.0F;  // [-] sRGB
// A step of the mean is mended by the membrane, a difference in pattern is not.
constexpr double kStepWeight = 0.15;

/// Smooth colours in a whole picture from those known at some pixels: averages of ever larger squares, the finest that
/// knows anything, softened on the way back (pull-push, Gortler 1996). `weight` > 0 where known.
cv::Mat3f membrane(const cv::Mat3f& value, const cv::Mat1f& weight) {
  if (value.rows <= 1 && value.cols <= 1) return value;
  const cv::Size half((value.cols + 1) / 2, (value.rows + 1) / 2);
  cv::Mat3f coarse(half, cv::Vec3f::all(0));
  cv::Mat1f known(half, 0.0F);
  for (int y = 0; y < value.rows; ++y)
    for (int x = 0; x < value.cols; ++x) {
      coarse(y / 2, x / 2) += weight(y, x) * value(y, x);
      known(y / 2, x / 2) += weight(y, x);
    }
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      if (known(y, x) > 0) {
        coarse(y, x) *= 1.0F / known(y, x);
        known(y, x) = std::min(known(y, x), 1.0F);
      }
  const cv::Mat3f below = membrane(coarse, known);
  cv::Mat3f result;
  cv::resize(below, result, value.size(), 0, 0, cv::INTER_LINEAR);
  for (int y = 0; y < value.rows; ++y)
    for (int x = 0; x < value.cols; ++x)
      if (weight(y, x) > 0) result(y, x) += weight(y, x) * (value(y, x) - result(y, x));
  return result;
}

/// Sums of a mask over any rectangle.
class Counter {
 public:
  explicit Counter(const cv::Mat& mask) {
    cv::Mat ones = mask != 0;
    ones.setTo(1, ones);
    cv::integral(ones, sums_, CV_32S);
  }
  int operator()(const cv::Rect& r) const {
    return sums_.at<int>(r.y + r.height, r.x + r.width) - sums_.at<int>(r.y, r.x + r.width) -
           sums_.at<int>(r.y + r.height, r.x) + sums_.at<int>(r.y, r.x);
  }

 private:
  cv::Mat sums_;
};

cv::Rect grown(const cv::Rect& r, int by, const cv::Size& size) {
  return cv::Rect(r.x - by, r.y - by, r.width + 2 * by, r.height + 2 * by) & cv::Rect({0, 0}, size);
}

struct Choice {
  cv::Point offset;
  double cost = std::numeric_limits<double>::infinity();
};

/// How far a place's colours lie from the nearest of its own surroundings, squared and averaged.
double strangeness(const cv::Mat& rgb, const std::vector<cv::Point>& ring, const cv::Rect& there,
                   const cv::Point& offset) {
  double sum = 0;
  for (int j = 0; j < kMarkSamples; ++j)
    for (int i = 0; i < kMarkSamples; ++i) {
      const cv::Vec3b& own = rgb.at<cv::Vec3b>(there.y + (2 * j + 1) * there.height / (2 * kMarkSamples),
                                               there.x + (2 * i + 1) * there.width / (2 * kMarkSamples));
      int best = 3 * 255 * 255;
      for (std::size_t k = 0; k < ring.size(); k += 4) {
        const cv::Vec3b& other = rgb.at<cv::Vec3b>(ring[k] + offset);
        int squares = 0;
        for (int c = 0; c < 3; ++c) squares += (own[c] - other[c]) * (own[c] - other[c]);
        best = std::min(best, squares);
      }
      sum += best;
    }
  return sum / (kMarkSamples * kMarkSamples);
}

/// The offset at which the cloth looks most like the block's known surroundings.
Choice find_source(const cv::Mat& rgb, const std::vector<cv::Point>& ring, const cv::Rect& box, const Counter& cloth) {
  Choice best;
  const cv::Rect all({0, 0}, rgb.size());
  const double area = 1.0 * (all.width - box.width) * (all.height - box.height);
  const int step = std::max(1, static_cast<int>(std::sqrt(area / kOffsets)));
  const auto consider = [&](int left, int top) {
    const cv::Rect there(left, top, box.width, box.height);
    if ((there & all) != there || cloth(there) != there.area()) return;
    const cv::Point offset(left - box.x, top - box.y);
    double sum[3] = {0, 0, 0}, squares = 0;
    for (const cv::Point& p : ring) {
      const cv::Vec3b &here = rgb.at<cv::Vec3b>(p), &other = rgb.at<cv::Vec3b>(p + offset);
      for (int c = 0; c < 3; ++c) {
        const double d = here[c] - other[c];
        sum[c] += d;
        squares += d * d;
      }
    }
    const double n = static_cast<double>(ring.size());
    const double mean = (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / (n * n);
    double cost = squares / n - (1.0 - kStepWeight) * mean;
    if (cost >= best.cost) return;
    cost += kMarkWeight * strangeness(rgb, ring, there, offset);
    if (cost < best.cost) best = {offset, cost};
  };
  for (int top = 0; top + box.height <= all.height; top += step)
    for (int left = 0; left + box.width <= all.width; left += step) consider(left, top);
  if (best.cost == std::numeric_limits<double>::infinity()) return best;
  // Stripes want their phase to the pixel.
  const cv::Point coarse = best.offset + box.tl();
  for (int dy = -step; dy <= step; ++dy)
    for (int dx = -step; dx <= step; dx += std::max(1, step / 2)) consider(coarse.x + dx, coarse.y + dy);
  return best;
}

/// Copies one block and bends its colours to those around it. False where there is nothing to copy from.
bool fill_block(cv::Mat& rgb, cv::Mat& known, const cv::Rect& block, const cv::Mat& open, const Counter& cloth) {
  const cv::Rect box = grown(block, kRing, rgb.size());
  std::vector<cv::Point> around;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x)
      if (known.at<uchar>(y, x)) around.emplace_back(x, y);
  if (around.empty()) return false;
  std::vector<cv::Point> ring;
  const std::size_t stride = std::max<std::size_t>(1, around.size() / kRingSamples);
  for (std::size_t i = 0; i < around.size(); i += stride) ring.push_back(around[i]);
  const Choice source = find_source(rgb, ring, box, cloth);
  if (source.cost == std::numeric_limits<double>::infinity()) return false;
  cv::Mat3f step(box.size(), cv::Vec3f::all(0));
  cv::Mat1f weight(box.size(), 0.0F);
  std::array<std::vector<float>, 3> steps;
  for (const cv::Point& p : around) {
    const cv::Vec3f d = cv::Vec3f(rgb.at<cv::Vec3b>(p)) - cv::Vec3f(rgb.at<cv::Vec3b>(p + source.offset));
    step(p - box.tl()) = d;
    for (int c = 0; c < 3; ++c) steps[c].push_back(d[c]);
  }
  cv::Vec3f usual;
  for (int c = 0; c < 3; ++c) {
    const auto middle = steps[c].begin() + static_cast<std::ptrdiff_t>(steps[c].size() / 2);
    std::nth_element(steps[c].begin(), middle, steps[c].end());
    usual[c] = *middle;
  }
  for (const cv::Point& p : around) {
    cv::Vec3f& d = step(p - box.tl());
    if (cv::norm(d - usual, cv::NORM_INF) > kOddStep) d = usual;
    weight(p - box.tl()) = 1;
  }
  const cv::Mat3f bent = membrane(step, weight);
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x) {
      if (!open.at<uchar>(y, x)) continue;
      const cv::Point p(x, y);
      const cv::Vec3f colour = cv::Vec3f(rgb.at<cv::Vec3b>(p + source.offset)) + bent(p - box.tl());
      for (int c = 0; c < 3; ++c) rgb.at<cv::Vec3b>(p)[c] = cv::saturate_cast<uchar>(colour[c]);
      known.at<uchar>(p) = 255;
    }
  return true;
}

}  // namespace

cv::Mat fill_with_cloth(cv::Mat& rgb, const cv::Mat& hole, const cv::Mat& kept, const cv::Mat& cloth) {
  cv::Mat left = hole != 0;
  if (cv::countNonZero(left) == 0) return left;
  cv::Mat known = (kept != 0) & (left == 0);
  const cv::Mat sources = (cloth != 0) & known;
  const Counter counter(sources);
  // Large blocks keep the pattern, small ones find room in narrow parts.
  const int widest = std::clamp(std::min(rgb.cols, rgb.rows) / 8, 8, 64);
  for (int side = widest; side >= std::max(6, widest / 4) && cv::countNonZero(left) > 0; side /= 2) {
    std::vector<cv::Rect> blocks;
    for (int y = 0; y < rgb.rows; y += side)
      for (int x = 0; x < rgb.cols; x += side) {
        const cv::Rect b = cv::Rect(x, y, side, side) & cv::Rect({0, 0}, rgb.size());
        if (cv::countNonZero(left(b)) > 0) blocks.push_back(b);
      }
    while (!blocks.empty()) {
      // From the border inwards: the block with most known pixels around it comes next; of equals the first.
      std::size_t next = 0;
      int most = -1;
      for (std::size_t i = 0; i < blocks.size(); ++i) {
        const int here = cv::countNonZero(known(grown(blocks[i], kRing, rgb.size())));
        if (here > most) {
          most = here;
          next = i;
        }
      }
      if (most <= 0) break;
      const cv::Rect block = blocks[next];
      blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(next));
      if (fill_block(rgb, known, block, left, counter)) left(block).setTo(0);
    }
  }
  return left;
}

}  // namespace vitrine
