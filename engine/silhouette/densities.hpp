// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <span>
#include <vector>

namespace vitrine {

/// The inner loops of the colour models: normal densities of whole rows of colours. They are plain arithmetic, one
/// colour independent of the next, so that a compiler does four or eight of them at a time; how many it does never
/// changes a result.

/// Log of a sum of densities along a row: the sum itself, and for colours far from all of them the largest log.
struct LogSum {
  std::vector<float> sum, largest;
  void clear(std::size_t n);
  float at(std::size_t i) const;
};

/// A row of `n` colours, a pointer for each channel.
struct ColourRow {
  const float *l, *a, *b;
  int n;
};

/// Adds the density exp(level - |U (colour - mean)|^2 / 2) of each colour; U is the upper triangle with U'U = inverse
/// covariance.
void add_density(const ColourRow& row, const Eigen::Matrix3f& u, const Eigen::Vector3f& mean, float level, LogSum& out);

/// The same for a mean that may be darkened by a factor t from `darkest` to 1, at a cost of `depth_cost` (1 - t) [nat].
/// `towards` gives the likeliest t as its product with the colour.
void add_shade_density(const ColourRow& row, const Eigen::Matrix3f& u, const Eigen::Vector3f& lit,
                       const Eigen::Vector3f& towards, float level, float darkest, float depth_cost, LogSum& out);

/// out[i] = level - |U (x_i - mean)|^2 / 2 for samples of mean.size() numbers; x holds them dimension after dimension,
/// out.size() numbers each. U as above, row after row, D * D numbers.
void log_densities(std::span<const float> x, std::span<const float> u, std::span<const float> mean, float level,
                   std::span<float> out);

/// Turns the logs of `parts` densities of the same samples (part after part) into each part's share of their sum.
void to_shares(std::span<float> logs, int parts);

}  // namespace vitrine
