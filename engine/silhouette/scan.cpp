// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "clean.hpp"
#include "picture.hpp"

namespace vitrine {
namespace {

/// Ground colour as a quadratic function of place: a plain board under one lamp.
struct Board {
  Eigen::Matrix<double, 6, 3> c = Eigen::Matrix<double, 6, 3>::Zero();
  double sigma = 0;  ///< [Lab] 68th percentile of the distance to the model
  double tail = 0;   ///< [Lab] 99th percentile
  cv::Size size;
  Eigen::Matrix<double, 1, 6> basis(int y, int x) const {
    const double u = 2.0 * x / size.width - 1, v = 2.0 * y / size.height - 1;
    Eigen::Matrix<double, 1, 6> b;
    b << 1, u, v, u * u, u * v, v * v;
    return b;
  }
  /// The model along row y.
  void row(int y, std::vector<cv::Vec3f>& out) const {
    const double v = 2.0 * y / size.height - 1;
    for (int k = 0; k < 3; ++k) {
      const auto base = static_cast<float>(c(0, k) + v * c(2, k) + v * v * c(5, k)),
                 slope = static_cast<float>(c(1, k) + v * c(4, k)), bend = static_cast<float>(c(3, k));
      for (int x = 0; x < size.width; ++x) {
        const float u = 2.0f * static_cast<float>(x) / static_cast<float>(size.width) - 1;
        out[static_cast<std::size_t>(x)][k] = base + u * (slope + u * bend);
      }
    }
  }
  cv::Vec3f at(int y, int x) const {
    const Eigen::Matrix<double, 1, 3> r = basis(y, x) * c;
    return {static_cast<float>(r(0)), static_cast<float>(r(1)), static_cast<float>(r(2))};
  }
};

Board fit_board(const cv::Mat& lab, const cv::Mat& ground) {
  Board board;
  board.size = lab.size();
  const int step = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(lab.total()) / 6000.0)));
  double limit = 1e9;
  for (int round = 0; round < 3; ++round) {
    Eigen::Matrix<double, 6, 6> a = 1e-6 * Eigen::Matrix<double, 6, 6>::Identity();
    Eigen::Matrix<double, 6, 3> b = Eigen::Matrix<double, 6, 3>::Zero();
    std::vector<double> rest;
    for (int pass = 0; pass < 2; ++pass) {
      for (int y = 0; y < lab.rows; y += step)
        for (int x = 0; x < lab.cols; x += step) {
          if (!ground.at<std::uint8_t>(y, x)) continue;
          const cv::Vec3f p = lab.at<cv::Vec3f>(y, x);
          if (pass == 1) {
            rest.push_back(std::sqrt(distance2(p, board.at(y, x))));
            continue;
          }
          if (round > 0 && distance2(p, board.at(y, x)) > limit * limit) continue;
          const auto f = board.basis(y, x);
          a += f.transpose() * f;
          b += f.transpose() * Eigen::Matrix<double, 1, 3>(p[0], p[1], p[2]);
        }
      if (pass == 0) board.c = a.ldlt().solve(b);
    }
    if (rest.empty()) return board;
    std::sort(rest.begin(), rest.end());
    board.sigma = rest[static_cast<std::size_t>(0.68 * static_cast<double>(rest.size() - 1))];
    board.tail = rest[static_cast<std::size_t>(0.97 * static_cast<double>(rest.size() - 1))];
    limit = std::max(2.0, 3 * board.sigma);
  }
  return board;
}

/// First and last edge pixel of each row and each column; what lies between in both is the garment.
cv::Mat between_edges(const cv::Mat& edges) {
  std::vector<int> left(edges.rows, edges.cols), right(edges.rows, -1), top(edges.cols, edges.rows),
      bottom(edges.cols, -1);
  for (int y = 0; y < edges.rows; ++y)
    for (int x = 0; x < edges.cols; ++x)
      if (edges.at<std::uint8_t>(y, x)) {
        left[y] = std::min(left[y], x);
        right[y] = std::max(right[y], x);
        top[x] = std::min(top[x], y);
        bottom[x] = std::max(bottom[x], y);
      }
  cv::Mat region = cv::Mat::zeros(edges.size(), CV_8U);
  for (int y = 0; y < edges.rows; ++y)
    for (int x = 0; x < edges.cols; ++x)
      if (x >= left[y] && x <= right[y] && y >= top[x] && y <= bottom[x]) region.at<std::uint8_t>(y, x) = 255;
  return region;
}

void drop_specks(cv::Mat& edges, int least) {
  cv::Mat labels, stats, centres;
  const int n = cv::connectedComponentsWithStats(edges, labels, stats, centres, 8, CV_32S);
  std::vector<bool> keep(n, false);
  for (int k = 1; k < n; ++k)
    keep[k] = std::max(stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT)) >= least;
  for (int y = 0; y < edges.rows; ++y)
    for (int x = 0; x < edges.cols; ++x)
      if (!keep[labels.at<int>(y, x)]) edges.at<std::uint8_t>(y, x) = 0;
}

/// Squared: how far a colour is from being the ground's colour `lit` in less light: that scales (L + 16, a, b) by one
/// factor.
float distance2_to_shade(const cv::Vec3f& colour, const cv::Vec3f& lit) {
  const cv::Vec3f c(colour[0] + 16, colour[1], colour[2]), g(lit[0] + 16, lit[1], lit[2]);
  const float t = std::clamp(c.dot(g) / g.dot(g), 0.68f, 1.03f);
  return distance2(c, t * g);
}

/// For each of the two phases and each pattern of the eight neighbours (clockwise from above, one bit each): may the
/// pixel go?
std::array<std::array<bool, 256>, 2> removal_table() {
  std::array<std::array<bool, 256>, 2> table{};
  for (unsigned pattern = 0; pattern < 256; ++pattern) {
    const auto on = [&](int k) { return (pattern >> (k % 8) & 1u) != 0; };
    int count = 0, turns = 0;
    for (int k = 0; k < 8; ++k) {
      count += on(k);
      turns += !on(k) && on(k + 1);
    }
    if (count < 2 || count > 6 || turns != 1) continue;
    table[0][pattern] = !(on(0) && on(2) && on(4)) && !(on(2) && on(4) && on(6));
    table[1][pattern] = !(on(0) && on(2) && on(6)) && !(on(0) && on(4) && on(6));
  }
  return table;
}

}  // namespace

cv::Mat thin_edges(const cv::Mat& edges) {
  cv::Mat e;
  cv::copyMakeBorder(edges, e, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  std::vector<cv::Point> live, drop;
  for (int y = 1; y + 1 < e.rows; ++y)
    for (int x = 1; x + 1 < e.cols; ++x)
      if (e.at<std::uint8_t>(y, x)) live.emplace_back(x, y);
  const auto step = static_cast<std::ptrdiff_t>(e.step);
  const std::ptrdiff_t around[8] = {-step, 1 - step, 1, step + 1, step, step - 1, -1, -step - 1};
  static const std::array<std::array<bool, 256>, 2> removable = removal_table();
  bool changed = true;
  while (changed) {
    changed = false;
    for (std::size_t phase = 0; phase < 2; ++phase) {
      drop.clear();
      for (const cv::Point& q : live) {
        const std::uint8_t* p = e.ptr(q.y) + q.x;
        unsigned neighbours = 0;
        for (int k = 0; k < 8; ++k) neighbours |= (p[around[k]] ? 1u : 0u) << k;
        if (removable[phase][neighbours]) drop.push_back(q);
      }
      for (const cv::Point& q : drop) e.at<std::uint8_t>(q) = 0;
      if (!drop.empty()) {
        changed = true;
        std::erase_if(live, [&](const cv::Point& q) { return !e.at<std::uint8_t>(q); });
      }
    }
  }
  return e(cv::Rect(1, 1, edges.cols, edges.rows)).clone();
}

Scan scan_edges(const WorkPicture& work) {
  Scan scan;
  const cv::Mat &rgb = work.rgb, &magnitude = work.edges, &lab = work.lab;
  const int side = std::max(rgb.cols, rgb.rows);
  const cv::Mat frame = border_band(rgb.size(), std::max(2, side / 60));
  const float noise = percentile(magnitude, frame, 0.97);
  const float threshold = std::max(24.0f, 2.0f * noise);
  cv::Mat strong = magnitude > threshold;
  cv::Mat edges = thin_edges(strong);
  drop_specks(edges, std::max(4, side / 50));
  cv::Mat region = between_edges(edges);
  scan.mask = region;
  const double share = cv::countNonZero(region) / static_cast<double>(region.total());
  if (noise > 120)
    scan.doubt = "the ground is as rough as the garment's edge";
  else if (share < 0.01)
    scan.doubt = "no closed outline stands out from the ground";
  else if (share > 0.9)
    scan.doubt = "edges reach the border of the photo on all sides";
  if (!scan.doubt.empty()) return scan;

  cv::Mat away;
  cv::dilate(region, away, cv::Mat(), {-1, -1}, 3);
  const Board board = fit_board(lab, ~away);
  if (board.sigma > 4 || board.tail > 12) {
    scan.doubt = "the ground is not one plain colour";
    return scan;
  }
  // Pockets: board colour that the row and column scans enclose (beside sleeves, in the neck opening). They are
  // flooded from outside and stop at edges; soft shadows, which have the board's hue and no edge, go with them.
  const float near = std::max(1.2f, static_cast<float>(3.5 * board.sigma));
  cv::Mat like(rgb.size(), CV_8U), shaded(rgb.size(), CV_8U);
  const float near2 = near * near, shade2 = std::max(6.25f, near2);
  std::vector<cv::Vec3f> lit_row(static_cast<std::size_t>(rgb.cols));
  for (int y = 0; y < rgb.rows; ++y) {
    board.row(y, lit_row);
    const cv::Vec3f* colour = lab.ptr<cv::Vec3f>(y);
    std::uint8_t *l = like.ptr(y), *s = shaded.ptr(y);
    for (std::size_t x = 0; x < lit_row.size(); ++x) {
      l[x] = distance2(colour[x], lit_row[x]) < near2 ? 255 : 0;
      s[x] = distance2_to_shade(colour[x], lit_row[x]) < shade2 ? 255 : 0;
    }
  }
  // Where the garment itself could be the board in shade (grey on white), shade says nothing.
  cv::Mat deep;
  const int depth_in = std::max(2, static_cast<int>(0.05 * std::sqrt(share * static_cast<double>(region.total()))));
  cv::erode(region, deep, cv::getStructuringElement(cv::MORPH_RECT, {2 * depth_in + 1, 2 * depth_in + 1}));
  if (cv::countNonZero(shaded & deep) < 0.15 * cv::countNonZero(deep)) like |= shaded;
  cv::Mat wide = like & ~strong;
  wide.setTo(255, ~region);
  cv::Mat flooded = cv::Mat::zeros(rgb.rows + 2, rgb.cols + 2, CV_8U);
  cv::Mat padded;
  cv::copyMakeBorder(wide, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 255);
  cv::floodFill(padded, {0, 0}, 128);
  cv::Mat garment = padded(cv::Rect(1, 1, rgb.cols, rgb.rows)) != 128;
  garment = fill_enclosed(main_piece(garment & ~(like & ~strong), &scan.second), like);
  // The edge's outer half is board colour again.
  cv::Mat rim;
  cv::erode(garment, rim, cv::Mat());
  rim = garment & ~rim & like;
  garment.setTo(0, rim);
  scan.mask = main_piece(garment);

  const double area = cv::countNonZero(scan.mask);
  if (area < 0.01 * static_cast<double>(rgb.total())) {
    scan.doubt = "no closed outline stands out from the ground";
    return scan;
  }
  // Trust: the strip just inside the contour must differ from the board there, and the contour must lie on edges.
  const int depth = std::max(3, static_cast<int>(0.02 * std::sqrt(area)));
  cv::Mat inner, strip, contour = contour_of(scan.mask), thick;
  cv::erode(scan.mask, inner, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * depth + 1, 2 * depth + 1}));
  strip = scan.mask & ~inner;
  const double distinct =
      1 - cv::countNonZero(strip & like) / std::max(1.0, static_cast<double>(cv::countNonZero(strip)));
  cv::dilate(strong, thick, cv::Mat());
  const double support =
      cv::countNonZero(contour & thick) / std::max(1.0, static_cast<double>(cv::countNonZero(contour)));
  const cv::Mat touch = scan.mask & border_band(rgb.size(), 1);
  if (distinct < 0.9)
    scan.doubt = "parts of the garment have the ground's colour";
  else if (support < 0.9)
    scan.doubt = "the outline does not lie on edges everywhere";
  else if (cv::countNonZero(touch) > 0)
    scan.doubt = "the outline reaches the border of the photo";
  return scan;
}

}  // namespace vitrine
