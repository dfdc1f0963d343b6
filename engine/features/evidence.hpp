// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "outline.hpp"
#include "vitrine/model/garment_template.hpp"

namespace vitrine::features_detail {

/// What a placed template has to say about the outline, whatever its garment: shares of the box diagonal and angles
/// only, so that templates can be compared with each other.
struct Evidence {
  double cover = 0;    ///< [-] IoU of the template's polygon with the mask
  double stray = 0;    ///< weight of strong corners that no feature explains
  double bend = 0;     ///< [-] RMS distance of the worst pair of edges to plain curves, share of their length
  double corners = 0;  ///< [-] 0..1 mean strength of the corners that the template asks for, seen over a long arc
  double weakest = 0;  ///< [-] 0..1 of the pair of partners that is least a corner
  double reach = 1;    ///< [-] 0..1 whether lengths suit a body: no sleeve that ends above the elbow is a long one
  double score = 0;    ///< [-] 0..1, how well the template explains the silhouette
  std::string why;     ///< the strongest reason against this garment, for the refusal
};

/// Evidence for features placed at `sample_of` (in the template's order).
Evidence weigh(const Outline& outline, const cv::Mat& small_mask, double scale, const GarmentTemplate& garment,
               const std::vector<int>& sample_of);

/// 0..1: whether the garment's length and its limbs suit a body whose girth is what the scale rule says. 1 when the
/// template has no scale rule. `at`: features [px], in the template's order.
double body_reach(const GarmentTemplate& garment, const std::vector<Vec2>& at);

/// Edges whose course the features do not settle: a plugin shapes the neckline, and a sleeve may bend.
bool follows_outline(const GarmentTemplate& garment, const TemplateEdge& edge);

}  // namespace vitrine::features_detail
