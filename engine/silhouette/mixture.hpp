// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "densities.hpp"

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
    const std::size_t count = parts_.size();
    std::vector<Part> next(count);
    for (auto& p : next) p.covariance.setZero();
    std::vector<float> rows, share(count * block);
    for (std::size_t first = 0; first < samples.size(); first += block) {
      const std::span<const Vec> some(samples.data() + first, std::min(block, samples.size() - first));
      find_shares(some, rows, share);
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t i = 0; i < some.size(); ++i) {
          const double r = share[k * some.size() + i];
          if (r < 1e-6) continue;
          const Vec weighted = r * some[i];
          next[k].weight += r;
          next[k].mean += weighted;
          next[k].covariance += weighted * some[i].transpose();
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

  /// Each part's share of each sample, part after part. `rows` is scratch.
  void find_shares(std::span<const Vec> some, std::vector<float>& rows, std::vector<float>& share) const {
    const std::size_t n = some.size();
    // Numbers are taken from the first part's mean, so that floats lose nothing that matters.
    const Vec origin = parts_[0].mean;
    rows.resize(D * n);
    for (std::size_t i = 0; i < n; ++i)
      for (int j = 0; j < D; ++j) rows[j * n + i] = static_cast<float>(some[i][j] - origin[j]);
    share.resize(parts_.size() * n);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const Eigen::Matrix<float, D, D, Eigen::RowMajor> u =
          Mat(parts_[k].inverse.llt().matrixU()).template cast<float>();
      const Eigen::Matrix<float, D, 1> mean = (parts_[k].mean - origin).template cast<float>();
      log_densities(rows, {u.data(), D * D}, {mean.data(), D}, static_cast<float>(parts_[k].log_norm),
                    {share.data() + k * n, n});
    }
    to_shares(share, static_cast<int>(parts_.size()));
  }

  static constexpr std::size_t block = 256;
  std::vector<Part> parts_;
  Vec floor_ = Vec::Zero();
};

}  // namespace vitrine
