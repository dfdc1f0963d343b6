// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <opencv2/core.hpp>
#include <vector>

#include "mixture.hpp"

namespace vitrine {

/// The ground: density of a colour *given the place*, so that a board that is lighter on one side, or a wall in two
/// colours, is ground everywhere in its own colour only. Places are shares of the picture, so that a model fitted to a
/// small picture serves a larger one.
class Ground {
 public:
  /// Fits the pixels of `mask`; a second call starts from the first one's parts.
  void fit(const cv::Mat& lab, const cv::Mat& mask);
  bool empty() const { return parts_.empty(); }
  /// Minus the log density of each pixel of `where` (CV_8U; other pixels of `score` are left alone). With `shadows`, a
  /// colour may also be this ground in shade: less light scales the linear colour, which in Lab scales (L + 16, a, b)
  /// by a common factor t, the cube root of the light that is left.
  void score(const cv::Mat& lab, const cv::Mat& where, bool shadows, cv::Mat& score) const;

 private:
  struct Part {
    double weight = 0, place_norm = 0;
    float colour_log_norm = 0, shade_log_norm = 0;
    Eigen::Vector2d place_mean;
    Eigen::Matrix2d place_inverse;
    Eigen::Matrix<double, 3, 2> slope;
    Eigen::Vector3d colour_mean;
    Eigen::Matrix3d shade_inverse;
    Eigen::Matrix3f colour_factor, shade_factor;  ///< upper triangles U with U'U = inverse covariance
  };
  Mixture<5> joint_;
  std::vector<Part> parts_;
};

/// The garment's colours, wherever they are.
class Cloth {
 public:
  void fit(const cv::Mat& lab, const cv::Mat& mask);
  /// Adds the log density of each pixel of `where` to `score`.
  void add_score(const cv::Mat& lab, const cv::Mat& where, cv::Mat& score) const;

 private:
  Mixture<3> mixture_;
};

/// The border without the stretches a garment that fills the frame covers: border colours that are few along the
/// border but frequent in the middle.
cv::Mat ground_seed(const cv::Mat& lab);

}  // namespace vitrine
