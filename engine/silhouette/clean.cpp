// SPDX-License-Identifier: GPL-3.0-or-later
#include "clean.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace vitrine {
namespace {

cv::Mat disc(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

}  // namespace

cv::Mat main_piece(const cv::Mat& mask, double* second) {
  cv::Mat labels, stats, centres;
  const cv::Rect box = cv::boundingRect(mask);
  if (second) *second = 0;
  cv::Mat out = cv::Mat::zeros(mask.size(), CV_8U);
  if (box.empty()) return out;
  const int n = cv::connectedComponentsWithStats(mask(box), labels, stats, centres, 4, CV_32S);
  // A garment stands in the middle: a frame of clutter around it may have its area, never its weight.
  std::vector<double> weight(n, 0);
  for (int y = 0; y < box.height; ++y) {
    const int* label = labels.ptr<int>(y);
    const double v = 2.0 * (y + box.y) / mask.rows - 1;
    for (int x = 0; x < box.width; ++x) {
      if (label[x] == 0) continue;
      const double u = 2.0 * (x + box.x) / mask.cols - 1;
      weight[label[x]] += std::max(0.05, 1 - 0.5 * (u * u + v * v));
    }
  }
  weight[0] = 0;
  const int best = static_cast<int>(std::max_element(weight.begin(), weight.end()) - weight.begin());
  if (second)
    for (int k = 1; k < n; ++k)
      if (k != best)
        *second = std::max(
            *second, static_cast<double>(stats.at<int>(k, cv::CC_STAT_AREA)) / stats.at<int>(best, cv::CC_STAT_AREA));
  out(box).setTo(255, labels == best);
  return out;
}

cv::Mat without_specks(const cv::Mat& mask) {
  std::vector<std::vector<cv::Point>> walks;
  std::vector<cv::Vec4i> tree;
  cv::findContours(mask, walks, tree, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  int best = -1;
  double largest = 0;
  for (int i = 0; i < static_cast<int>(walks.size()); ++i) {
    if (tree[i][3] >= 0) continue;
    const double area = cv::contourArea(walks[i]);
    if (best >= 0 && area <= largest) continue;
    best = i;
    largest = area;
  }
  cv::Mat out = mask.clone();
  for (int i = 0; i < static_cast<int>(walks.size()); ++i)
    if (tree[i][3] < 0 && i != best) cv::drawContours(out, walks, i, 0, cv::FILLED);
  return out;
}

cv::Mat without_loose_ends(const cv::Mat& mask, int radius) {
  if (radius < 1) return mask.clone();
  cv::Mat core, near_core, thin, labels, stats, centres;
  cv::Mat padded;
  cv::copyMakeBorder(mask, padded, radius + 2, radius + 2, radius + 2, radius + 2, cv::BORDER_CONSTANT, 0);
  cv::morphologyEx(padded, core, cv::MORPH_OPEN, disc(radius));
  core = main_piece(core);
  cv::dilate(core, near_core, disc(1));
  thin = padded & ~core;
  const int n = cv::connectedComponentsWithStats(thin, labels, stats, centres, 8, CV_32S);
  cv::Mat out = core.clone();
  for (int k = 1; k < n; ++k) {
    const cv::Rect box(stats.at<int>(k, cv::CC_STAT_LEFT), stats.at<int>(k, cv::CC_STAT_TOP),
                       stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT));
    const cv::Rect around =
        cv::Rect(box.x - 2, box.y - 2, box.width + 4, box.height + 4) & cv::Rect(0, 0, padded.cols, padded.rows);
    const cv::Mat piece = labels(around) == k;
    cv::Mat touch, touch_labels;
    touch = near_core(around) & piece;
    const int roots = cv::connectedComponents(touch, touch_labels, 8, CV_32S) - 1;
    if (roots == 0) continue;
    // Corners and ripples of the outline that the opening rounded off reach no further than the disc does.
    cv::Mat away;
    cv::distanceTransform(~core(around), away, cv::DIST_L2, 3);
    double reach = 0;
    cv::minMaxLoc(away, nullptr, &reach, nullptr, nullptr, piece);
    const bool bridge = roots >= 2 && reach > 2.0 * radius;
    if (bridge || reach <= 2.0 * radius) out(around).setTo(255, piece);
  }
  return main_piece(out(cv::Rect(radius + 2, radius + 2, mask.cols, mask.rows)));
}

cv::Mat fill_enclosed(const cv::Mat& mask, const cv::Mat& ground_like) {
  cv::Mat padded, labels, stats, centres;
  cv::copyMakeBorder(~mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 255);
  const int n = cv::connectedComponentsWithStats(padded, labels, stats, centres, 4, CV_32S);
  const int outside_label = labels.at<int>(0, 0);
  labels = labels(cv::Rect(1, 1, mask.cols, mask.rows));
  cv::Mat solid = labels != outside_label;
  const double area = std::max(1, cv::countNonZero(solid)), size = std::sqrt(area);
  cv::Mat out = solid.clone(), depth;
  const cv::Rect box = cv::boundingRect(solid);
  for (int k = 1; k < n; ++k) {
    const double hole_area = stats.at<int>(k, cv::CC_STAT_AREA);
    if (k == outside_label || hole_area < 0.0008 * area) continue;
    const cv::Rect around(stats.at<int>(k, cv::CC_STAT_LEFT) - 1, stats.at<int>(k, cv::CC_STAT_TOP) - 1,
                          stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT));
    const cv::Mat hole = labels(around) == k;
    const double like = cv::countNonZero(hole & ground_like(around)) / hole_area;
    if (depth.empty()) {
      cv::copyMakeBorder(solid, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
      cv::distanceTransform(padded, depth, cv::DIST_L2, 5);
    }
    double nearest = 0;
    cv::minMaxLoc(depth(around + cv::Point(1, 1)), &nearest, nullptr, nullptr, nullptr, hole);
    // A gap beside a sleeve stands upright; a neck opening lies near the top. A sheer band or a pale stripe does
    // neither.
    const int width = stats.at<int>(k, cv::CC_STAT_WIDTH), height = stats.at<int>(k, cv::CC_STAT_HEIGHT);
    const bool high = around.y + height < box.y + 0.35 * box.height;
    if (like > 0.6 && nearest < 0.16 * size && (high || height > 0.8 * width)) out(around).setTo(0, hole);
  }
  return out;
}

}  // namespace vitrine
