// SPDX-License-Identifier: GPL-3.0-or-later
#include "colour_cut.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

#include "clean.hpp"
#include "mixture.hpp"
#include "picture.hpp"

namespace vitrine {
namespace {

using Vec3d = Eigen::Vector3d;
using Vec5d = Eigen::Matrix<double, 5, 1>;

constexpr int ground_parts = 10;
constexpr int garment_parts = 6;
constexpr std::size_t max_samples = 6000;
constexpr int rounds = 5;
constexpr double unary_clip = 12;           ///< [nat] no single pixel outvotes its neighbourhood
constexpr double smoothness = 14;           ///< [nat] cost of a boundary link without contrast
constexpr double darkest_shade = 0.58;      ///< cube root of the least light that is left in a cast shadow
constexpr double shade_penalty = 2.0;       ///< [nat] shade is rarer than lit ground
constexpr double shade_depth_penalty = 12;  ///< [nat] per unit of 1 - t: deep shade is rarer than a soft one
constexpr double place_scale = 30;          ///< picture side in the unit of Lab, for colour-and-place samples

Vec3d colour_at(const cv::Mat& lab, int y, int x) {
  const cv::Vec3f c = lab.at<cv::Vec3f>(y, x);
  return {c[0], c[1], c[2]};
}

Vec5d sample_at(const cv::Mat& lab, int y, int x) {
  const cv::Vec3f c = lab.at<cv::Vec3f>(y, x);
  const double side = std::max(lab.cols, lab.rows);
  Vec5d v;
  v << c[0], c[1], c[2], x / side * place_scale, y / side * place_scale;
  return v;
}

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

template <class Sample, class Get>
std::vector<Sample> collect(const cv::Mat& mask, Get get) {
  const std::size_t total = static_cast<std::size_t>(cv::countNonZero(mask));
  const std::size_t step = std::max<std::size_t>(1, total / max_samples);
  std::vector<Sample> out;
  std::size_t k = 0;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      // The stride is broken up by a multiplicative hash: a plain stride would fall into step with stripes.
      if (mask.at<std::uint8_t>(y, x) && (k++ * 2654435761u >> 7) % step == 0) out.push_back(get(y, x));
  return out;
}

/// The ground: density of a colour *given the place*, so that a board that is lighter on one side, or a wall in two
/// colours, is ground everywhere in its own colour only.
class Ground {
 public:
  void fit(const cv::Mat& lab, const cv::Mat& mask) {
    Vec5d floor;
    floor << 1.0, 0.6, 0.6, 4, 4;
    joint_.fit(collect<Vec5d>(mask, [&](int y, int x) { return sample_at(lab, y, x); }), ground_parts, floor, 8);
    parts_.clear();
    for (const auto& p : joint_.parts()) {
      Part q;
      q.weight = p.weight;
      q.place_mean = p.mean.tail<2>();
      const Eigen::Matrix2d place = p.covariance.bottomRightCorner<2, 2>();
      q.place_inverse = place.inverse();
      q.place_log_norm = -0.5 * std::log(std::max(place.determinant(), 1e-12));
      q.slope = p.covariance.topRightCorner<3, 2>() * q.place_inverse;
      q.colour_mean = p.mean.head<3>();
      Eigen::Matrix3d c = p.covariance.topLeftCorner<3, 3>() - q.slope * p.covariance.bottomLeftCorner<2, 3>();
      q.colour_inverse = c.inverse();
      q.colour_log_norm = -1.5 * std::log(2 * std::numbers::pi) - 0.5 * std::log(std::max(c.determinant(), 1e-12));
      const Eigen::Matrix3d shade = c + Eigen::Vector3d(1.5, 3, 3).asDiagonal().toDenseMatrix();
      q.shade_inverse = shade.inverse();
      q.shade_log_norm = -1.5 * std::log(2 * std::numbers::pi) - 0.5 * std::log(std::max(shade.determinant(), 1e-12));
      parts_.push_back(q);
    }
  }

  bool empty() const { return parts_.empty(); }

  /// With `shadows`, a colour may also be this ground in shade: less light scales the linear colour, which in Lab
  /// scales (L + 16, a, b) by a common factor t, the cube root of the light that is left.
  double log_density(const Vec5d& v, bool shadows) const {
    double terms[2 * Mixture<5>::max_parts], places[Mixture<5>::max_parts];
    double best = -1e300, best_place = -1e300;
    const Vec3d lift(16, 0, 0), colour = v.head<3>() + lift;
    const std::size_t n = std::min<std::size_t>(parts_.size(), Mixture<5>::max_parts);
    std::size_t used = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Part& p = parts_[k];
      const Eigen::Vector2d at = v.tail<2>() - p.place_mean;
      const double distance = at.dot(p.place_inverse * at);
      // Half of a part's weight holds everywhere: planks and tiles come back where no sample was taken.
      places[k] = std::log(p.weight) +
                  std::log(0.5 * std::exp(-0.5 * distance + p.place_log_norm) + 0.5 / (place_scale * place_scale));
      best_place = std::max(best_place, places[k]);
      // The slope is trusted within two standard deviations; beyond, the colour stays what it was there.
      const double reach = distance > 4 ? 2 / std::sqrt(distance) : 1;
      const Vec3d lit = p.colour_mean + reach * (p.slope * at) + lift;
      const Vec3d d = colour - lit;
      terms[used++] = places[k] + p.colour_log_norm - 0.5 * d.dot(p.colour_inverse * d);
      if (!shadows) continue;
      const Vec3d weighted = p.shade_inverse * lit;
      const double t = std::clamp(weighted.dot(colour) / weighted.dot(lit), darkest_shade, 0.97);
      const Vec3d e = colour - t * lit;
      terms[used++] = places[k] + p.shade_log_norm - shade_penalty - shade_depth_penalty * (1 - t) -
                      0.5 * e.dot(p.shade_inverse * e);
    }
    for (std::size_t k = 0; k < used; ++k) best = std::max(best, terms[k]);
    double sum = 0, place_sum = 0;
    for (std::size_t k = 0; k < used; ++k) sum += std::exp(terms[k] - best);
    for (std::size_t k = 0; k < n; ++k) place_sum += std::exp(places[k] - best_place);
    return best + std::log(sum) - best_place - std::log(place_sum);
  }

 private:
  struct Part {
    double weight = 0, place_log_norm = 0, colour_log_norm = 0, shade_log_norm = 0;
    Eigen::Vector2d place_mean;
    Eigen::Matrix2d place_inverse;
    Eigen::Matrix<double, 3, 2> slope;
    Vec3d colour_mean;
    Eigen::Matrix3d colour_inverse, shade_inverse;
  };
  Mixture<5> joint_;
  std::vector<Part> parts_;
};

/// Where a garment is expected before anything is known: 1 in the middle, 0 at the border.
double prior_at(cv::Size size, int y, int x) {
  const double u = 2.0 * (x + 0.5) / size.width - 1, v = 2.0 * (y + 0.5) / size.height - 1;
  return std::max(0.0, 1 - std::pow(std::abs(u), 4)) * std::max(0.0, 1 - std::pow(std::abs(v), 4));
}

/// The border without the stretches a garment that fills the frame covers: border colours that are few along the
/// border but frequent in the middle.
cv::Mat ground_seed(const cv::Mat& lab) {
  const int width = std::max(3, static_cast<int>(0.03 * std::min(lab.rows, lab.cols)));
  cv::Mat seed = border_band(lab.size(), width);
  Mixture<3> colours;
  colours.fit(collect<Vec3d>(seed, [&](int y, int x) { return colour_at(lab, y, x); }), 6, Vec3d(2, 1, 1), 6);
  const cv::Rect middle(lab.cols / 4, lab.rows / 4, lab.cols / 2, lab.rows / 2);
  std::vector<double> border(colours.parts().size(), 0), centre(border);
  cv::Mat owner(lab.size(), CV_8U, cv::Scalar(255));
  for (int y = 0; y < lab.rows; ++y)
    for (int x = 0; x < lab.cols; ++x) {
      const bool in_seed = seed.at<std::uint8_t>(y, x) != 0, in_middle = middle.contains({x, y});
      if (!in_seed && !in_middle) continue;
      int best = -1;
      double least = 1e300;
      for (std::size_t k = 0; k < colours.parts().size(); ++k) {
        const Vec3d d = colour_at(lab, y, x) - colours.parts()[k].mean;
        const double m = d.dot(colours.parts()[k].inverse * d);
        if (m < least) least = m, best = static_cast<int>(k);
      }
      if (best < 0) continue;
      if (in_seed) owner.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(best), border[best] += 1;
      if (in_middle && least < 12) centre[best] += 1;
    }
  const double border_total = std::max(1, cv::countNonZero(seed)), centre_total = std::max(1, middle.area());
  for (std::size_t k = 0; k < border.size(); ++k)
    if (border[k] / border_total < 0.15 && centre[k] / centre_total > 3 * border[k] / border_total)
      seed.setTo(0, owner == static_cast<double>(k));
  return seed;
}

cv::Mat minimum_cut(const cv::Mat& lab, const cv::Mat& unary, double beta) {
  const int w = lab.cols, h = lab.rows;
  cv::detail::GCGraph<double> graph(static_cast<unsigned>(w * h), static_cast<unsigned>(8 * w * h));
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const int node = graph.addVtx();
      const double u = unary.at<float>(y, x);
      graph.addTermWeights(node, std::max(u, 0.0), std::max(-u, 0.0));
      const auto link = [&](int dx, int dy) {
        const int nx = x + dx, ny = y + dy;
        if (nx < 0 || ny < 0 || nx >= w) return;
        const double d2 = distance2(lab.at<cv::Vec3f>(y, x), lab.at<cv::Vec3f>(ny, nx));
        const double cost = smoothness * (0.06 + 0.94 * std::exp(-beta * d2)) / std::sqrt(dx * dx + dy * dy) / 2.4;
        graph.addEdges(node, ny * w + nx, cost, cost);
      };
      link(-1, 0);
      link(0, -1);
      link(-1, -1);
      link(1, -1);
    }
  graph.maxFlow();
  cv::Mat mask(lab.size(), CV_8U);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) mask.at<std::uint8_t>(y, x) = graph.inSourceSegment(y * w + x) ? 255 : 0;
  return mask;
}

/// beta of the contrast term: one over twice the mean squared colour step between neighbours.
double contrast_beta(const cv::Mat& lab) {
  double sum = 0;
  long n = 0;
  for (int y = 0; y < lab.rows; ++y)
    for (int x = 1; x < lab.cols; ++x, ++n) sum += distance2(lab.at<cv::Vec3f>(y, x), lab.at<cv::Vec3f>(y, x - 1));
  return n && sum > 0 ? 1.0 / (2 * sum / static_cast<double>(n)) : 1.0;
}

}  // namespace

cv::Mat cut_by_colour(const cv::Mat& rgb, cv::Mat& ground_like) {
  cv::Mat calm;
  cv::bilateralFilter(rgb, calm, 5, 20, 2);
  const cv::Mat lab = lab_from_rgb(calm);
  const double beta = contrast_beta(lab);
  Ground ground;
  cv::Mat ground_mask = ground_seed(lab), score(lab.size(), CV_32F), unary(lab.size(), CV_32F);
  ground.fit(lab, ground_mask);
  cv::Mat mask = cv::Mat::zeros(lab.size(), CV_8U);
  ground_like = mask.clone();
  if (ground.empty()) return mask;
  const auto score_ground = [&](bool shadows) {
    for (int y = 0; y < lab.rows; ++y)
      for (int x = 0; x < lab.cols; ++x)
        score.at<float>(y, x) = static_cast<float>(-ground.log_density(sample_at(lab, y, x), shadows));
  };
  // First cut: how unlike the ground alone. The border itself says what "like" means.
  score_ground(false);
  const float usual = percentile(score, ground_mask, 0.5), limit = percentile(score, ground_mask, 0.95);
  for (int y = 0; y < lab.rows; ++y)
    for (int x = 0; x < lab.cols; ++x) {
      const double p = prior_at(lab.size(), y, x);
      const double over = (score.at<float>(y, x) - limit - 0.25 * (limit - usual)) + 2.5 * (p - 0.6);
      unary.at<float>(y, x) = static_cast<float>(std::clamp(over, -unary_clip, unary_clip));
    }
  mask = minimum_cut(lab, unary, beta);
  for (int round = 0; round < rounds; ++round) {
    const cv::Mat body = main_piece(mask);
    if (cv::countNonZero(body) < 50) return cv::Mat::zeros(lab.size(), CV_8U);
    Mixture<3> garment;
    garment.fit(collect<Vec3d>(mostly_deep(body), [&](int y, int x) { return colour_at(lab, y, x); }), garment_parts,
                Vec3d(1.0, 0.6, 0.6), 6);
    cv::Mat rest;
    cv::dilate(body, rest, cv::Mat(), {-1, -1}, 2);
    rest = ~rest;
    if (cv::countNonZero(rest) < 50) return mask;
    ground.fit(lab, rest);
    score_ground(true);
    for (int y = 0; y < lab.rows; ++y)
      for (int x = 0; x < lab.cols; ++x) {
        const double g = garment.log_density(colour_at(lab, y, x));
        const double u = g + score.at<float>(y, x) + 1.0 * (prior_at(lab.size(), y, x) - 0.6);
        unary.at<float>(y, x) = static_cast<float>(std::clamp(u, -unary_clip, unary_clip));
      }
    cv::Mat next = minimum_cut(lab, unary, beta), change;
    cv::bitwise_xor(next, mask, change);
    mask = next;
    ground_like = unary < -2;
    if (cv::countNonZero(change) < 0.0005 * static_cast<double>(mask.total())) break;
  }
  return mask;
}

}  // namespace vitrine
