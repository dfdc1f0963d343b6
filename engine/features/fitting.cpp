// SPDX-License-Identifier: GPL-3.0-or-later
#include "fitting.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "legs.hpp"
#include "sleeves.hpp"

namespace vitrine::features_detail {
namespace {

constexpr double kHairShare = 0.002;    // threads thinner than twice this share of the diagonal are no outline
constexpr double kLongestNotch = 0.08;  // of a hanger's clip, share of the diagonal
constexpr double kGuessed = 0.8;        // score of a crotch that was not seen
constexpr double kWaist = 0.25;         // clips bite from above, share of the height

/// Clips of a hanger bite notches into a waistband; a garment without sleeves and neckline has no narrow notch of its
/// own. A long gap is none: legs or straps end there, and show that this is another garment.
void close_notches(cv::Mat& mask) {
  const cv::Rect box = cv::boundingRect(mask);
  const double diagonal = std::hypot(box.width, box.height);
  const int reach = std::max(1, static_cast<int>(0.028 * diagonal));
  cv::Mat padded;
  const int rim = reach + 2;
  // Of the picture only the garment's box is looked at.
  cv::Mat part = mask(box);
  cv::copyMakeBorder(part, padded, rim, rim, rim, rim, cv::BORDER_CONSTANT | cv::BORDER_ISOLATED, 0);
  // Closing by a disc, as two distances: a kernel of this size would cost a hundred times more.
  cv::Mat distance;
  cv::distanceTransform(padded == 0, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::distanceTransform(distance <= reach, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  padded = distance > reach;
  const cv::Mat closed = padded(cv::Rect(rim, rim, part.cols, part.rows)) & ~part;
  cv::Mat pieces, stats, centres;
  const int count = cv::connectedComponentsWithStats(closed, pieces, stats, centres, 8);
  for (int i = 1; i < count; ++i) {
    const double extent = std::max(stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    const bool at_waist = centres.at<double>(i, 1) < kWaist * box.height;
    if (at_waist && extent < kLongestNotch * diagonal) part.setTo(255, pieces == i);
  }
}

/// Where `wanted` features (each with its side) would lie if the garment were as wide on their side as on their
/// partners'; empty unless all partners were seen.
std::vector<Vec2> mirrored_places(const GarmentTemplate& garment, const Outline& outline, const Match& match,
                                  const std::vector<std::pair<int, int>>& wanted) {
  if (match.features.empty()) return {};
  const auto place = [&](int f) { return outline.samples[match.features[f].sample].at; };
  double middle = 0;
  int pairs = 0;
  for (int f = 0; f < static_cast<int>(garment.features.size()); ++f) {
    const int partner = garment.features[f].mirror;
    if (partner <= f || !match.features[f].snapped || !match.features[partner].snapped) continue;
    middle += (place(f).x() + place(partner).x()) / 2;
    ++pairs;
  }
  if (pairs == 0) return {};
  std::vector<Vec2> places;
  for (const auto& [f, side] : wanted) {
    const int partner = garment.features[f].mirror;
    if (partner < 0 || !match.features[partner].snapped) return {};
    places.emplace_back(2 * middle / pairs - place(partner).x(), place(partner).y());
  }
  return places;
}

/// Sleeves without any gap to the body: where a limb's armpit was not found as a corner, the template's place is tried.
/// True when the outline has the notch of a cuff on the body, so that this is what is wrong with it.
bool free_hidden_sleeves(const GarmentTemplate& garment, const FeatureOptions& options, cv::Mat& mask, Outline& outline,
                         Match& match, std::vector<std::string>& warnings) {
  std::vector<std::pair<int, int>> closed;  // armpit feature, side
  for (const TemplateLimb& limb : garment.limbs)
    for (const int f : {limb.root_a, limb.root_b})
      if (!is_leg(garment, limb) && f >= 0 && f < static_cast<int>(garment.features.size()) &&
          garment.features[f].turn == Turn::concave && (match.features.empty() || !match.features[f].snapped))
        closed.emplace_back(f, garment.poses[0].uv[f].x() < 0.5 ? -1 : 1);
  if (closed.empty()) return false;
  bool notched = false;
  cv::Mat best_mask;
  Outline best_outline;
  // Guesses of the closed armpits' places: across from the other side's, when that one was seen; else each pose's.
  std::vector<std::vector<Vec2>> guesses;
  if (auto places = mirrored_places(garment, outline, match, closed); !places.empty())
    guesses.push_back(std::move(places));
  const bool across = !guesses.empty();
  bool across_fits = false;
  for (const TemplatePose& pose : garment.poses) {
    std::vector<Vec2> places;
    for (const auto& [f, side] : closed)
      places.emplace_back(outline.box.x + pose.uv[f].x() * outline.box.width,
                          outline.box.y + pose.uv[f].y() * outline.box.height);
    guesses.push_back(std::move(places));
  }
  for (std::size_t g = 0; g < guesses.size(); ++g) {
    cv::Mat tried = mask.clone();
    bool cut = false;
    for (std::size_t k = 0; k < closed.size(); ++k)
      cut = cut_hidden_gap(tried, outline, guesses[g][k], closed[k].second) || cut;
    if (!cut) continue;
    notched = true;
    Outline freed = trace_outline(tried, options);
    Match again = match_template(freed, tried, garment);
    // Once what the other side shows has fitted, a pose has to fit clearly better.
    const double lead = across_fits ? 0.05 : 0;
    if (again.score <= std::max(match.score + lead, kMinScore)) continue;
    across_fits = across_fits || (across && g == 0);
    match = std::move(again);
    best_mask = tried;
    best_outline = std::move(freed);
  }
  if (best_mask.empty()) return notched;
  mask = best_mask;
  outline = std::move(best_outline);
  warnings.push_back("SLEEVE_ON_BODY");
  return notched;
}

}  // namespace

cv::Mat whole_piece(const cv::Mat& mask) {
  const double size = std::hypot(mask.cols, mask.rows);
  return clean_mask(mask, std::max(1, static_cast<int>(kHairShare * size / 2)));
}

Fit fit_garment(const cv::Mat& piece, const GarmentTemplate& garment, const FeatureOptions& options) {
  Fit fit;
  if (cv::countNonZero(piece) < 400) return fit;
  fit.mask = piece.clone();
  if (!has_sleeves(garment) && garment.neck_edge() < 0) close_notches(fit.mask);
  const int crotch = crotch_of(garment);
  LegCut legs;
  if (crotch >= 0) legs = open_legs(fit.mask, garment);
  fit.legs_together = crotch >= 0 && !legs.gap;
  const SleeveCuts cuts = open_sleeve_gaps(fit.mask, garment, options);
  fit.mask = cuts.mask;
  fit.outline = trace_outline(fit.mask, options);
  if (fit.outline.chain.empty()) return fit;
  fit.match = match_template(fit.outline, fit.mask, garment);
  fit.hidden_sleeve = free_hidden_sleeves(garment, options, fit.mask, fit.outline, fit.match, fit.warnings);
  if (fit.match.pose < 0 || fit.match.features.empty()) return fit;
  fit.score = fit.match.score;
  if (garment.limbs.empty()) fit.score *= std::exp(-120 * cuts.gap_share);
  if (legs.guessed) {
    fit.score *= kGuessed;
    fit.guessed = crotch;
    fit.warnings.push_back("LEGS_TOGETHER");
  }
  return fit;
}

}  // namespace vitrine::features_detail
