// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace vitrine {

/// Mixture of D-dimensional normal distributions with full covariances, fitted by expectation maximisation from a
/// deterministic start (repeatedly splitting the widest cluster at its mean along its longest axis), because a random
/// start would give another silhouette on every run.
template <int D>
class Mixture {
 public:
  using Vec = Eigen::Matrix<double, D, 1>;
  using Mat = Eigen::Matrix<double, D, D>;
  struct Part {
    double weight = 0;
    Vec mean = Vec::Zero();
    Mat covariance = Mat::Identity();
    Mat inverse = Mat::Identity();
    double log_norm = 0;  ///< log of weight / sqrt((2 pi)^D det)
  };

  /// `floor` is added to the variances: what camera noise and rounding cause at least.
  void fit(const std::vector<Vec>& samples, int count, const Vec& floor, int rounds) {
    parts_.clear();
    floor_ = floor;
    if (samples.empty()) return;
    std::vector<int> owner(samples.size(), 0);
    refit(samples, owner, 1);
    while (static_cast<int>(parts_.size()) < count) {
      int widest = -1;
      double spread = 0;
      Vec axis = Vec::Zero();
      for (std::size_t k = 0; k < parts_.size(); ++k) {
        const Eigen::SelfAdjointEigenSolver<Mat> solver(parts_[k].covariance);
        const double s = parts_[k].weight * solver.eigenvalues()(D - 1);
        if (s > spread) {
          spread = s;
          widest = static_cast<int>(k);
          axis = solver.eigenvectors().col(D - 1);
        }
      }
      if (widest < 0) break;
      const int fresh = static_cast<int>(parts_.size());
      const Vec mean = parts_[widest].mean;
      for (std::size_t i = 0; i < samples.size(); ++i)
        if (owner[i] == widest && axis.dot(samples[i] - mean) > 0) owner[i] = fresh;
      refit(samples, owner, fresh + 1);
    }
    refine(samples, rounds);
  }

  /// More rounds of expectation maximisation from the parts there are.
  void refine(const std::vector<Vec>& samples, int rounds) {
    for (int r = 0; r < rounds && !samples.empty(); ++r) maximise(samples);
  }

  bool empty() const { return parts_.empty(); }
  const std::vector<Part>& parts() const { return parts_; }

  static constexpr int max_parts = 16;

 private:
  void finish(Part& p) const {
    p.covariance.diagonal() += floor_;
    p.inverse = p.covariance.inverse();
    const double det = std::max(p.covariance.determinant(), 1e-300);
    p.log_norm = std::log(std::max(p.weight, 1e-12)) - 0.5 * (D * std::log(2 * std::numbers::pi) + std::log(det));
  }

  void refit(const std::vector<Vec>& samples, const std::vector<int>& owner, int count) {
    std::vector<Part> parts(count);
    std::vector<double> n(count, 0);
    for (auto& p : parts) p.covariance.setZero();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      parts[owner[i]].mean += samples[i];
      n[owner[i]] += 1;
    }
    for (int k = 0; k < count; ++k) parts[k].mean /= std::max(n[k], 1.0);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Vec d = samples[i] - parts[owner[i]].mean;
      parts[owner[i]].covariance += d * d.transpose();
    }
    for (int k = 0; k < count; ++k) {
      parts[k].covariance /= std::max(n[k], 1.0);
      parts[k].weight = n[k] / static_cast<double>(samples.size());
      finish(parts[k]);
    }
    parts_ = std::move(parts);
  }

  void maximise(const std::vector<Vec>& samples) {
    const std::size_t count = std::min<std::size_t>(parts_.size(), max_parts);
    std::vector<Part> next(count);
    for (auto& p : next) p.covariance.setZero();
    double share[max_parts];
    for (const Vec& v : samples) {
      double best = -std::numeric_limits<double>::infinity(), sum = 0;
      for (std::size_t k = 0; k < count; ++k) {
        const Vec d = v - parts_[k].mean;
        share[k] = parts_[k].log_norm - 0.5 * d.dot(parts_[k].inverse * d);
        best = std::max(best, share[k]);
      }
      for (std::size_t k = 0; k < count; ++k) sum += share[k] = std::exp(share[k] - best);
      for (std::size_t k = 0; k < count; ++k) {
        const double r = share[k] / sum;
        if (r < 1e-6) continue;
        next[k].weight += r;
        next[k].mean += r * v;
        next[k].covariance += r * v * v.transpose();
      }
    }
    std::vector<Part> kept;
    for (std::size_t k = 0; k < count; ++k) {
      Part& p = next[k];
      if (p.weight < D + 1.0) continue;
      p.mean /= p.weight;
      p.covariance = p.covariance / p.weight - p.mean * p.mean.transpose();
      p.weight /= static_cast<double>(samples.size());
      finish(p);
      kept.push_back(p);
    }
    if (!kept.empty()) parts_ = std::move(kept);
  }

  std::vector<Part> parts_;
  Vec floor_ = Vec::Zero();
};

}  // namespace vitrine
