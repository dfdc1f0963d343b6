// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>
#include <optional>

#include "vitrine/silhouette.hpp"

namespace vitrine {

/// A second piece of at least this share of the garment's area is a second garment.
constexpr double several_share = 0.3;

Error several_garments(const Photo& photo);

/// The gates: an Error when the silhouette must not be used; otherwise fills edge_support and warnings.
std::optional<Error> judge(const Photo& photo, const cv::Mat& mask, const SilhouetteOptions& options, Silhouette& out);

}  // namespace vitrine
