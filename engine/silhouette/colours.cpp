// SPDX-License-Identifier: GPL-3.0-or-later
#include "colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "densities.hpp"
#include "picture.hpp"

namespace vitrine {
namespace {

using Vec3d = Eigen::Vector3d;
using Vec5d = Eigen::Matrix<double, 5, 1>;

constexpr int ground_parts = 10;
constexpr int cloth_parts = 6;
constexpr std::size_t max_samples = 2400;
constexpr int first_rounds = 6, later_rounds = 2;
constexpr float lift = 16;                  ///< [L] added, so that less light scales L, a and b alike
constexpr double darkest_shade = 0.58;      ///< cube root of the least light that is left in a cast shadow
constexpr double shade_penalty = 2.0;       ///< [nat] shade is rarer than lit ground
constexpr double shade_depth_penalty = 12;  ///< [nat] per unit of 1 - t: deep shade is rarer than a soft one
constexpr double place_scale = 30;          ///< picture side in the unit of Lab, for colour-and-place samples
constexpr int cells = 24;                   ///< cells along the longer side in which the ground's light is constant

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

Vec3d colour_at(const cv::Mat& lab, int y, int x) {
  const cv::Vec3f c = lab.at<cv::Vec3f>(y, x);
  return {c[0], c[1], c[2]};
}

Eigen::Matrix3f factor(const Eigen::Matrix3d& inverse) {
  return Eigen::Matrix3f(Eigen::Matrix3d(inverse.llt().matrixU()).cast<float>());
}

float log_norm(const Eigen::Matrix3d& covariance) {
  return static_cast<float>(-1.5 * std::log(2 * std::numbers::pi) -
                            0.5 * std::log(std::max(covariance.determinant(), 1e-12)));
}

/// The wanted pixels of a part of a Lab picture, one after the other. L is lifted by 16, which makes shade a common
/// factor of all three channels.
struct Gathered {
  std::vector<float> l, a, b;
  std::vector<cv::Point> at;
  LogSum density;
  void take(const cv::Mat& lab, const cv::Mat& where, const cv::Rect& box) {
    l.clear();
    a.clear();
    b.clear();
    at.clear();
    for (int y = box.y; y < box.y + box.height; ++y) {
      const std::uint8_t* wanted = where.ptr(y);
      const cv::Vec3f* colour = lab.ptr<cv::Vec3f>(y);
      for (int x = box.x; x < box.x + box.width; ++x) {
        if (!wanted[x]) continue;
        l.push_back(colour[x][0] + lift);
        a.push_back(colour[x][1]);
        b.push_back(colour[x][2]);
        at.emplace_back(x, y);
      }
    }
    density.clear(at.size());
  }
  ColourRow row() const { return {l.data(), a.data(), b.data(), static_cast<int>(at.size())}; }
};

}  // namespace

void Ground::fit(const cv::Mat& lab, const cv::Mat& mask) {
  Vec5d floor;
  floor << 1.0, 0.6, 0.6, 4, 4;
  const double side = std::max(lab.cols, lab.rows);
  const auto samples = collect<Vec5d>(mask, [&](int y, int x) {
    Vec5d v;
    v << colour_at(lab, y, x), (x + 0.5) / side * place_scale, (y + 0.5) / side * place_scale;
    return v;
  });
  if (joint_.empty())
    joint_.fit(samples, ground_parts, floor, first_rounds);
  else
    joint_.refine(samples, later_rounds);
  parts_.clear();
  for (const auto& p : joint_.parts()) {
    Part q;
    q.weight = p.weight;
    q.place_mean = p.mean.tail<2>();
    const Eigen::Matrix2d place = p.covariance.bottomRightCorner<2, 2>();
    q.place_inverse = place.inverse();
    q.place_norm = 1 / std::sqrt(std::max(place.determinant(), 1e-12));
    q.slope = p.covariance.topRightCorner<3, 2>() * q.place_inverse;
    q.colour_mean = p.mean.head<3>();
    const Eigen::Matrix3d c = p.covariance.topLeftCorner<3, 3>() - q.slope * p.covariance.bottomLeftCorner<2, 3>();
    q.colour_factor = factor(c.inverse());
    q.colour_log_norm = log_norm(c);
    const Eigen::Matrix3d shade = c + Vec3d(1.5, 3, 3).asDiagonal().toDenseMatrix();
    q.shade_inverse = shade.inverse();
    q.shade_factor = factor(q.shade_inverse);
    q.shade_log_norm = log_norm(shade);
    parts_.push_back(q);
  }
}

void Ground::score(const cv::Mat& lab, const cv::Mat& where, bool shadows, cv::Mat& score) const {
  const int w = lab.cols, h = lab.rows, side = std::max(w, h);
  const int cell = std::max(1, (side + cells - 1) / cells);
  Gathered some;
  const float darkest = static_cast<float>(darkest_shade), depth_cost = static_cast<float>(shade_depth_penalty);
  for (int y0 = 0; y0 < h; y0 += cell)
    for (int x0 = 0; x0 < w; x0 += cell) {
      const cv::Rect box(x0, y0, std::min(cell, w - x0), std::min(cell, h - y0));
      some.take(lab, where, box);
      if (some.at.empty()) continue;
      const Eigen::Vector2d place((x0 + 0.5 * box.width) / side * place_scale,
                                  (y0 + 0.5 * box.height) / side * place_scale);
      struct Here {
        Eigen::Vector3f lit, towards;
        float level, shade_level;
      };
      std::array<Here, Mixture<5>::max_parts> here;
      std::array<double, Mixture<5>::max_parts> share;
      const std::size_t n = std::min<std::size_t>(parts_.size(), Mixture<5>::max_parts);
      double total = 0;
      for (std::size_t k = 0; k < n; ++k) {
        const Part& p = parts_[k];
        const Eigen::Vector2d at = place - p.place_mean;
        const double distance = at.dot(p.place_inverse * at);
        // Half of a part's weight holds everywhere: planks and tiles come back where no sample was taken.
        share[k] = p.weight * (0.5 * std::exp(-0.5 * distance) * p.place_norm + 0.5 / (place_scale * place_scale));
        total += share[k];
        // The slope is trusted within two standard deviations; beyond, the colour stays what it was there.
        const double reach = distance > 4 ? 2 / std::sqrt(distance) : 1;
        const Vec3d lit = p.colour_mean + reach * (p.slope * at) + Vec3d(lift, 0, 0);
        const Vec3d weighted = p.shade_inverse * lit;
        here[k].lit = lit.cast<float>();
        here[k].towards = (weighted / std::max(weighted.dot(lit), 1e-9)).cast<float>();
      }
      for (std::size_t k = 0; k < n; ++k) {
        const float log_share = static_cast<float>(std::log(std::max(share[k] / total, 1e-12)));
        here[k].level = log_share + parts_[k].colour_log_norm;
        here[k].shade_level = log_share + parts_[k].shade_log_norm - static_cast<float>(shade_penalty);
      }
      for (std::size_t k = 0; k < n; ++k) {
        add_density(some.row(), parts_[k].colour_factor, here[k].lit, here[k].level, some.density);
        if (shadows)
          add_shade_density(some.row(), parts_[k].shade_factor, here[k].lit, here[k].towards, here[k].shade_level,
                            darkest, depth_cost, some.density);
      }
      for (std::size_t i = 0; i < some.at.size(); ++i) score.at<float>(some.at[i]) = -some.density.at(i);
    }
}

void Cloth::fit(const cv::Mat& lab, const cv::Mat& mask) {
  const auto samples = collect<Vec3d>(mask, [&](int y, int x) { return colour_at(lab, y, x); });
  // Always from the start: the first cut's cloth often holds ground, whose parts would live on.
  mixture_.fit(samples, cloth_parts, Vec3d(1.0, 0.6, 0.6), first_rounds);
}

void Cloth::add_score(const cv::Mat& lab, const cv::Mat& where, cv::Mat& score) const {
  std::vector<Eigen::Matrix3f> factors;
  for (const auto& p : mixture_.parts()) factors.push_back(factor(p.inverse));
  Gathered some;
  for (int y = 0; y < lab.rows; ++y) {
    some.take(lab, where, {0, y, lab.cols, 1});
    if (some.at.empty()) continue;
    for (std::size_t k = 0; k < factors.size(); ++k) {
      const auto& p = mixture_.parts()[k];
      const Eigen::Vector3f mean = (p.mean + Vec3d(lift, 0, 0)).cast<float>();
      add_density(some.row(), factors[k], mean, static_cast<float>(p.log_norm), some.density);
    }
    for (std::size_t i = 0; i < some.at.size(); ++i) score.at<float>(some.at[i]) += some.density.at(i);
  }
}

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

}  // namespace vitrine
