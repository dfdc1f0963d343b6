// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string>
#include <vector>

#include "vitrine/model/garment_template.hpp"
#include "vitrine/model/image.hpp"
#include "vitrine/model/result.hpp"
#include "vitrine/silhouette.hpp"

namespace vitrine {

struct FeatureOptions {
  Side side = Side::front;
  std::string neckline = "auto";  ///< id of a neckline, or "auto": chosen by the ratio rule
  double smoothing = 0.004;       ///< [-] arc over which the chain code is smoothed, share of the box diagonal
  double min_turn_deg = 22;       ///< [degree] turn within that arc that makes a run of candidates
  /// The loaded garments, to compare with: when another one fits clearly better, the photo is refused and that garment
  /// is named. May hold the garment that is asked for; may be empty.
  std::span<const GarmentTemplate> others = {};
};

/// A silhouette point of high curvature: the best of its run (paper III.A).
struct Candidate {
  Vec2 pixel;           ///< [px] in the front frame
  double turn_deg = 0;  ///< signed, > 0 convex
  int contour_index = 0;
};

struct FeaturePoint {
  std::string name;       ///< the template's name
  std::string landmark;   ///< Table I body landmark, may be empty
  Vec2 pixel;             ///< [px] in the front frame (of Photo::rgb)
  std::string origin;     ///< "candidate" (snapped), "template" (placed by the template on the contour), "neckline"
  double confidence = 0;  ///< [-] 0..1
  int contour_index = 0;  ///< its place on Features::contour
};

struct NecklineChoice {
  std::string id;             ///< neckline plugin's id; empty when the garment has no neck edge
  double ratio = 0;           ///< [-] foreground / background pixels of the neck area
  bool forced = false;        ///< chosen by the user
  Vec2 low = Vec2::Zero();    ///< [px] lowest point of this panel's neckline
  bool inside_found = false;  ///< an inside of the back was seen above the front neckline and cut off this panel
};

/// What the paper calls the feature points, with the outline they lie on.
struct Features {
  std::vector<Vec2> contour;  ///< [px] closed outline of THIS panel, clockwise in the picture, simple; the inside of
                              ///< the back is cut off a front panel, sleeves lying on the body are cut free
  std::vector<FeaturePoint> points;   ///< one per template feature, in the template's order
  std::vector<Candidate> candidates;  ///< all candidates, for the debug overlay
  NecklineChoice neckline;
  std::string pose;     ///< name of the template pose that fitted
  double score = 0;     ///< [-] 0..1, how well the template explains the silhouette
  double tilt_deg = 0;  ///< [degree] of the garment in the picture, removed by the panels room
  Image labels;         ///< three-label image after the inside was found, size of the photo
  std::vector<std::string> warnings;
};

/// How well a garment's template explains a silhouette.
struct GarmentFit {
  std::string id;
  double score = 0;  ///< [-] 0..1; find_features refuses what is below 0.3
};

/// All garments, the best first, for a label image as find_silhouette makes it. Scores are made of angles and shares of
/// the garment's own size only: corners where the template asks for them and no others, edges that are plain curves,
/// covered area, lengths that suit a body. A malformed picture scores 0.
std::vector<GarmentFit> suggest_garment(const Image& labels, std::span<const GarmentTemplate> garments,
                                        const FeatureOptions& options = {});

/// Counter-clockwise quarter turns (0 to 3) that bring the garment upright: 0 unless the template fits the turned
/// silhouette clearly better. For a label image as find_silhouette makes it.
int turns_to_upright(const Image& labels, const GarmentTemplate& garment, const FeatureOptions& options = {});

/// Chain code of the eroded silhouette's 4-connected boundary, one candidate per run of high curvature, template scaled
/// to the silhouette box and matched within its search radius, neckline by the background ratio in the neck area.
/// Warnings: NECKLINE_UNCLEAR (no front neckline seen below the back's; the top edge is used), SLEEVE_ON_BODY (cut
/// where the template expects the armpit). Errors (65): NOT_THIS_GARMENT, NO_OUTLINE, SLEEVE_ON_BODY; (64):
/// UNKNOWN_NECKLINE, BAD_OPTION; (69): NO_POSES.
Result<Features> find_features(const Photo& photo, const Silhouette& silhouette, const GarmentTemplate& garment,
                               std::span<const NecklineTemplate> necklines, const FeatureOptions& options);

}  // namespace vitrine
