// SPDX-License-Identifier: GPL-3.0-or-later
#include "colour_cut.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

#include "clean.hpp"
#include "picture.hpp"

namespace vitrine {
namespace {

constexpr int rounds_alone = 6, rounds_known = 2;
constexpr float unary_clip = 12;   ///< [nat] no single pixel outvotes its neighbourhood
constexpr float sure_unary = 8;    ///< [nat]
constexpr double smoothness = 14;  ///< [nat] cost of a boundary link without contrast

/// Keeps a growing share of the pixels from the rim to the depth of a tenth of the garment: what clings to the
/// outline (shade, a plank, a hanger) shall not become one of the garment's colours.
cv::Mat mostly_deep(const cv::Mat& mask) {
  cv::Mat depth, out = mask.clone();
  cv::distanceTransform(mask, depth, cv::DIST_L2, 3);
  const double full = 0.1 * std::sqrt(static_cast<double>(cv::countNonZero(mask)));
  std::size_t k = 0;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      if (!mask.at<std::uint8_t>(y, x)) continue;
      const double keep = std::min(1.0, depth.at<float>(y, x) / full);
      if (static_cast<double>((k++ * 2654435761u >> 9) % 1000) > 1000 * keep) out.at<std::uint8_t>(y, x) = 0;
    }
  return out;
}

/// Where a garment is expected before anything is known: 1 in the middle, 0 at the border.
cv::Mat prior_of(cv::Size size) {
  cv::Mat prior(size, CV_32F);
  std::vector<float> across(static_cast<std::size_t>(size.width));
  const auto fall = [](double u) { return static_cast<float>(std::max(0.0, 1 - u * u * u * u)); };
  for (int x = 0; x < size.width; ++x) across[static_cast<std::size_t>(x)] = fall(2 * (x + 0.5) / size.width - 1);
  for (int y = 0; y < size.height; ++y) {
    const float down = fall(2 * (y + 0.5) / size.height - 1);
    for (int x = 0; x < size.width; ++x) prior.at<float>(y, x) = down * across[static_cast<std::size_t>(x)];
  }
  return prior;
}

constexpr int link_x[] = {-1, 0, -1, 1}, link_y[] = {0, -1, -1, -1};  // the four neighbours already passed

/// beta of the contrast term: one over twice the mean squared colour step between neighbours.
double contrast_beta(const cv::Mat& lab) {
  double sum = 0;
  long n = 0;
  for (int y = 0; y < lab.rows; ++y)
    for (int x = 1; x < lab.cols; ++x, ++n) sum += distance2(lab.at<cv::Vec3f>(y, x), lab.at<cv::Vec3f>(y, x - 1));
  return n && sum > 0 ? 1.0 / (2 * sum / static_cast<double>(n)) : 1.0;
}

/// Cost [nat] of parting each pixel of `where` from its four neighbours, CV_32FC4.
cv::Mat link_costs(const cv::Mat& lab, const cv::Mat& where) {
  const double beta = contrast_beta(lab);
  cv::Mat cost(lab.size(), CV_32FC4, cv::Scalar::all(0));
  for (int y = 0; y < lab.rows; ++y)
    for (int x = 0; x < lab.cols; ++x) {
      if (!where.at<std::uint8_t>(y, x)) continue;
      for (int k = 0; k < 4; ++k) {
        const int nx = x + link_x[k], ny = y + link_y[k];
        if (nx < 0 || ny < 0 || nx >= lab.cols) continue;
        const double d2 = distance2(lab.at<cv::Vec3f>(y, x), lab.at<cv::Vec3f>(ny, nx)),
                     length = k < 2 ? 1 : 1.41421356;
        cost.at<cv::Vec4f>(y, x)[k] =
            static_cast<float>(smoothness * (0.06 + 0.94 * std::exp(-beta * d2)) / length / 2.4);
      }
    }
  return cost;
}

/// Minimum cut over the pixels of `open`; the others keep their side of `mask`. Minus `unary` is the cost of the
/// garment's side. `links` must be known wherever a pixel or its neighbour is open.
cv::Mat minimum_cut(const cv::Mat& links, const cv::Mat& unary, const cv::Mat& open, const cv::Mat& mask) {
  const int w = open.cols, h = open.rows, count = cv::countNonZero(open);
  if (count == 0) return mask.clone();
  cv::detail::GCGraph<float> graph(static_cast<unsigned>(count), static_cast<unsigned>(8 * count + 8));
  cv::Mat node(open.size(), CV_32S, cv::Scalar(-1));
  std::vector<float> source(static_cast<std::size_t>(count), 0), sink(source);
  int next = 0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      if (open.at<std::uint8_t>(y, x)) {
        graph.addVtx();
        const float u = unary.at<float>(y, x);
        (u > 0 ? source : sink)[static_cast<std::size_t>(next)] += std::abs(u);
        node.at<int>(y, x) = next++;
      }
      const cv::Vec4f& cost = links.at<cv::Vec4f>(y, x);
      for (int k = 0; k < 4; ++k) {
        const int nx = x + link_x[k], ny = y + link_y[k];
        if (nx < 0 || ny < 0 || nx >= w) continue;
        const int here = node.at<int>(y, x), there = node.at<int>(ny, nx);
        if (here < 0 && there < 0) continue;
        if (here >= 0 && there >= 0) {
          graph.addEdges(here, there, cost[k], cost[k]);
          continue;
        }
        const bool garment = (here < 0 ? mask.at<std::uint8_t>(y, x) : mask.at<std::uint8_t>(ny, nx)) != 0;
        (garment ? source : sink)[static_cast<std::size_t>(std::max(here, there))] += cost[k];
      }
    }
  for (int i = 0; i < next; ++i)
    graph.addTermWeights(i, source[static_cast<std::size_t>(i)], sink[static_cast<std::size_t>(i)]);
  graph.maxFlow();
  cv::Mat out = mask.clone();
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      if (const int i = node.at<int>(y, x); i >= 0) out.at<std::uint8_t>(y, x) = graph.inSourceSegment(i) ? 255 : 0;
  return out;
}

/// A cut of the whole picture. Pixels that are sure of their side, among neighbours that are too, need no graph.
cv::Mat whole_cut(const cv::Mat& links, const cv::Mat& unary) {
  cv::Mat garment = unary >= sure_unary, ground = unary <= -sure_unary, sure_garment, sure_ground;
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  cv::erode(garment, sure_garment, kernel);
  cv::erode(ground, sure_ground, kernel);
  return minimum_cut(links, unary, ~(sure_garment | sure_ground), sure_garment);
}

cv::Mat enclosed(const cv::Mat& mask) {
  cv::Mat padded;
  cv::copyMakeBorder(mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::floodFill(padded, {0, 0}, 255);
  return padded(cv::Rect(1, 1, mask.cols, mask.rows)) == 0;
}

void clip(cv::Mat& unary) {
  unary = cv::min(cv::max(unary, -unary_clip), unary_clip);
}

}  // namespace

cv::Mat ColourCut::start(const cv::Mat& rgb, const cv::Mat& known) {
  const cv::Mat lab = lab_from_rgb(rgb);
  const cv::Mat everywhere(lab.size(), CV_8U, cv::Scalar(255)), links = link_costs(lab, everywhere),
                                                                prior = prior_of(lab.size());
  cv::Mat mask, score(lab.size(), CV_32F), unary;
  if (known.empty()) {
    const cv::Mat seed = ground_seed(lab);
    ground_.fit(lab, seed);
    if (ground_.empty()) return cv::Mat::zeros(lab.size(), CV_8U);
    // First cut: how unlike the ground alone. The border itself says what "like" means.
    ground_.score(lab, everywhere, false, score);
    const float usual = percentile(score, seed, 0.5), limit = percentile(score, seed, 0.95);
    unary = score - (limit + 0.25f * (limit - usual)) + 2.5f * (prior - 0.6f);
    clip(unary);
    mask = whole_cut(links, unary);
  } else {
    cv::resize(known, mask, lab.size(), 0, 0, cv::INTER_AREA);
    mask = mask > 127;
  }
  const int rounds = known.empty() ? rounds_alone : rounds_known;
  for (int round = 0; round < rounds; ++round) {
    const cv::Mat body = main_piece(mask);
    cv::Mat rest;
    cv::dilate(body, rest, cv::Mat());
    rest = ~rest;
    if (cv::countNonZero(body) < 50) return cv::Mat::zeros(lab.size(), CV_8U);
    if (cv::countNonZero(rest) < 50) return mask;
    cloth_.fit(lab, mostly_deep(body));
    ground_.fit(lab, rest);
    ground_.score(lab, everywhere, true, score);
    cloth_.add_score(lab, everywhere, score);
    unary = score + (prior - 0.6f);
    clip(unary);
    const cv::Mat next = whole_cut(links, unary);
    cv::Mat change;
    cv::bitwise_xor(next, mask, change);
    mask = next;
    if (cv::countNonZero(change) < 0.001 * static_cast<double>(mask.total())) break;
  }
  return mask;
}

cv::Mat ColourCut::sharpen(const cv::Mat& lab, const cv::Mat& mask, int reach, cv::Mat& ground_like) const {
  cv::Mat rough, inner, outer, score(lab.size(), CV_32F, cv::Scalar(0));
  cv::resize(mask, rough, lab.size(), 0, 0, cv::INTER_LINEAR);
  rough = rough > 127;
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, {2 * reach + 1, 2 * reach + 1});
  cv::erode(rough, inner, kernel, {-1, -1}, 1, cv::BORDER_REPLICATE);
  cv::dilate(rough, outer, kernel);
  const cv::Mat band = outer & ~inner;
  // Holes are asked as well, for what becomes of them depends on whether they show the ground.
  const cv::Mat asked = band | enclosed(rough);
  ground_.score(lab, asked, true, score);
  cloth_.add_score(lab, asked, score);
  ground_like = (score < -2) | ~(outer | asked);
  clip(score);
  cv::Mat linked;
  cv::dilate(band, linked, cv::Mat());
  return minimum_cut(link_costs(lab, linked), score, band, rough);
}

}  // namespace vitrine
