// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>
#include <optional>

#include "picture.hpp"
#include "vitrine/silhouette.hpp"

namespace vitrine {

/// A second piece of at least this share of the garment's area is a second garment.
constexpr double several_share = 0.3;

Error several_garments(const Photo& photo);

/// The gates, for the picture at working size: an Error when the silhouette must not be used; otherwise fills
/// edge_support and warnings.
std::optional<Error> judge(const Photo& photo, const WorkPicture& work, const cv::Mat& mask, const Sides& sides,
                           const SilhouetteOptions& options, Silhouette& out);

}  // namespace vitrine
