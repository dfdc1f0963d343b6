// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/features.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "fitting.hpp"
#include "neckline.hpp"
#include "outline.hpp"

namespace vitrine {
namespace {

using namespace features_detail;

constexpr double kSure = 0.9;         // score of a fit that needs no comparison with other garments
constexpr double kTurnSide = 400;     // [px] picture in which a garment's upright position is looked for
constexpr double kTurnMargin = 0.05;  // merit by which a turned position must be better
constexpr double kClearly = 1.12;     // times the score asked for: another garment fits clearly better

/// Whether the tables agree with each other.
bool usable(const GarmentTemplate& garment) {
  const std::size_t count = garment.features.size();
  bool good = count >= 3 && !garment.poses.empty() && garment.edges.size() == count;
  for (const TemplatePose& pose : garment.poses) {
    good = good && pose.uv.size() == count && pose.radius.size() == count;
    for (const Vec2& uv : pose.uv) good = good && uv.allFinite();
    for (const double r : pose.radius) good = good && std::isfinite(r) && r > 0;
  }
  for (std::size_t i = 0; good && i < garment.edges.size(); ++i)
    good = garment.edges[i].from >= 0 && garment.edges[i].from < static_cast<int>(count) &&
           garment.edges[i].to == garment.edges[(i + 1) % count].from;
  for (std::size_t i = 0; good && i < count; ++i) good = garment.features[i].mirror < static_cast<int>(count);
  return good;
}

bool is_label_image(const Image& labels) {
  return labels.channels == 1 && labels.width >= 8 && labels.height >= 8 && labels.width <= 20000 &&
         labels.height <= 20000 && labels.data.size() == static_cast<std::size_t>(labels.width) * labels.height;
}

std::string two_digits(double value) {
  return std::to_string(value).substr(0, 4);
}

std::string file_of(const Photo& photo) {
  return photo.path.empty() ? std::string("the photo") : photo.path;
}

Error not_this_garment(const Photo& photo, const GarmentTemplate& garment, const std::string& why,
                       const std::optional<GarmentFit>& better) {
  Error error{Cause::unusable, "NOT_THIS_GARMENT",
              file_of(photo) + " does not look like a " + garment.id + ": " + why + ".",
              "Choose the garment type that the photo shows, or lay the garment out flat, its sleeves off its body and "
              "its legs apart.",
              ""};
  if (better)
    error.remedy = "Choose the garment type " + better->id + ", which fits best (score " + two_digits(better->score) +
                   "), or lay the garment out flat, its sleeves off its body and its legs apart.";
  return error;
}

/// The garment that fits clearly better than one with `score`.
std::optional<GarmentFit> better_garment(const cv::Mat& mask, const GarmentTemplate& garment, double score,
                                         const FeatureOptions& options) {
  std::optional<GarmentFit> best;
  for (const GarmentTemplate& other : options.others) {
    if (other.id == garment.id || !usable(other)) continue;
    const double s = fit_garment(mask, other, options).score;
    if (s >= kMinScore && s > kClearly * score && (!best || s > best->score)) best = GarmentFit{other.id, s};
  }
  return best;
}

std::optional<Error> check_input(const Photo& photo, const Silhouette& silhouette, const GarmentTemplate& garment,
                                 std::span<const NecklineTemplate> necklines, const FeatureOptions& options) {
  const Image& rgb = photo.rgb;
  const Image& labels = silhouette.labels;
  const auto bytes = [](const Image& i) { return static_cast<std::size_t>(i.width) * i.height * i.channels; };
  if (labels.channels != 1 || labels.width < 8 || labels.height < 8 || labels.width > 20000 || labels.height > 20000 ||
      labels.data.size() != bytes(labels))
    return Error{Cause::unusable, "NO_OUTLINE", file_of(photo) + " has no silhouette image.",
                 "Give a photo in which the garment stands out from its ground, or a mask.", ""};
  if (rgb.channels != 3 || rgb.width != labels.width || rgb.height != labels.height || rgb.data.size() != bytes(rgb))
    return Error{Cause::internal, "NO_OUTLINE", file_of(photo) + ": photo and silhouette differ in size.",
                 "Report this as a defect.", ""};
  if (!usable(garment))
    return Error{Cause::plugin, "NO_POSES", "Garment " + garment.id + " (" + garment.plugin + ") has no usable poses.",
                 "Run `vitrine plugin validate` on that plugin.", ""};
  if (!std::isfinite(options.smoothing) || !std::isfinite(options.min_turn_deg) || options.smoothing < 0 ||
      options.smoothing > 0.05 || options.min_turn_deg < 1 || options.min_turn_deg > 120)
    return Error{Cause::usage, "BAD_OPTION", "Feature options are out of range.",
                 "Use a smoothing of 0 to 0.05 and a turn of 1 to 120 degrees.", ""};
  if (options.neckline != "auto" && garment.neck_edge() >= 0) {
    std::string ids;
    for (const NecklineTemplate& n : necklines) {
      if (n.id == options.neckline) return std::nullopt;
      ids += (ids.empty() ? "" : ", ") + n.id;
    }
    return Error{Cause::usage, "UNKNOWN_NECKLINE", "There is no neckline called '" + options.neckline + "'.",
                 "Use auto or one of: " + (ids.empty() ? std::string("(no neckline plugin is loaded)") : ids) + ".",
                 ""};
  }
  return std::nullopt;
}

/// Outline pixels from one chain index to another, both included, clockwise.
std::vector<Vec2> stretch(const std::vector<Vec2>& chain, int from, int to) {
  std::vector<Vec2> part;
  const int n = static_cast<int>(chain.size());
  for (int i = from;; i = (i + 1) % n) {
    part.push_back(chain[i]);
    if (i == to) break;
  }
  return part;
}

int nearest_on(const std::vector<Vec2>& chain, const Vec2& p) {
  int best = 0;
  for (int i = 1; i < static_cast<int>(chain.size()); ++i)
    if ((chain[i] - p).squaredNorm() < (chain[best] - p).squaredNorm()) best = i;
  return best;
}

/// Cuts the inside of the back off the panel: what lies between the silhouette's top edge and the front neckline.
void cut_inside(cv::Mat& panel, Image& labels, const std::vector<Vec2>& top, const std::vector<Vec2>& path) {
  std::vector<cv::Point> region;
  const auto add = [&](const Vec2& p) {
    region.emplace_back(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
  };
  for (const Vec2& p : top) add(p);
  for (auto p = path.rbegin(); p != path.rend(); ++p) add(*p);
  cv::Mat fill = cv::Mat::zeros(panel.size(), CV_8U);
  cv::fillPoly(fill, std::vector<std::vector<cv::Point>>{region}, 255);
  fill &= panel;
  for (int y = 0; y < panel.rows; ++y)
    for (int x = 0; x < panel.cols; ++x)
      if (fill.at<uchar>(y, x)) *labels.at(x, y) = label_inside;
  panel.setTo(0, fill);
}

/// True when the features stand on the outline in the template's order.
bool in_order(const std::vector<int>& place, const std::vector<int>& order, int n) {
  int before = -1;
  for (const int f : order) {
    const int along = (place[f] - place[order[0]] + n) % n;
    if (along <= before) return false;
    before = along;
  }
  return true;
}

/// Chain places of the features on `outline`, from their old pixels; the neck points look for their corner again, which
/// the cut has sharpened.
std::vector<int> relocate(const Outline& outline, const std::vector<Vec2>& old, const GarmentTemplate& garment) {
  const TemplateEdge& neck = garment.edges[garment.neck_edge()];
  std::vector<int> place(old.size());
  for (std::size_t f = 0; f < old.size(); ++f) place[f] = nearest_on(outline.chain, old[f]);
  for (const int f : {neck.from, neck.to}) {
    const int plain = place[f];
    double best = 0.02 * outline.diagonal;
    for (const Candidate& c : outline.candidates) {
      const double distance = (c.pixel - old[f]).norm();
      if (c.turn_deg < 35 || distance > best) continue;
      best = distance;
      place[f] = c.contour_index;
    }
    // On a strap a few pixels wide the nearest corner may be the shoulder's.
    if (!in_order(place, outline_order(garment), static_cast<int>(outline.chain.size()))) place[f] = plain;
  }
  return place;
}

/// Smooth closed outline; the features and sharp corners stay at their pixels. Sets the points' contour_index.
bool make_contour(const Outline& outline, std::vector<int> place, Features& features) {
  const int n = static_cast<int>(outline.chain.size());
  std::vector<char> pinned(n, 0);
  for (const int p : place) pinned[p] = 1;
  for (const Candidate& c : outline.candidates) {
    bool near_feature = false;
    for (const int p : place)
      near_feature = near_feature || (outline.chain[p] - c.pixel).norm() < 0.02 * outline.diagonal;
    if (!near_feature && std::abs(c.turn_deg) > 60) pinned[c.contour_index] = 1;
  }
  const double wanted = std::max(1.5, 0.0015 * outline.diagonal);
  const int first = place[0];
  for (const double sigma : {wanted, 0.6 * wanted, 2 * wanted}) {
    const std::vector<Vec2> smooth = smooth_closed(outline.chain, sigma, pinned);
    features.contour.clear();
    std::vector<int> index(n, -1);
    for (int k = 0; k < n; ++k) {
      const int i = (first + k) % n;
      if (!pinned[i] && !features.contour.empty() && (smooth[i] - features.contour.back()).norm() < 0.75) continue;
      index[i] = static_cast<int>(features.contour.size());
      features.contour.push_back(smooth[i]);
    }
    for (std::size_t f = 0; f < place.size(); ++f) {
      features.points[f].contour_index = index[place[f]];
      features.points[f].pixel = outline.chain[place[f]];
    }
    if (is_simple(features.contour)) return true;
  }
  return false;
}

struct Work {
  const Photo& photo;
  const GarmentTemplate& garment;
  std::span<const NecklineTemplate> necklines;
  const FeatureOptions& options;
};

/// Fills in the neckline: inside of the back, ratio, choice.
Outline settle_neckline(const Work& work, cv::Mat& panel, Outline outline, std::vector<int>& place, bool inside_given,
                        Features& features) {
  const TemplateEdge& neck = work.garment.edges[work.garment.neck_edge()];
  const NecklineTemplate* forced = nullptr;
  for (const NecklineTemplate& n : work.necklines)
    if (n.id == work.options.neckline) forced = &n;
  features.neckline.inside_found = inside_given;
  settle_neck_points(outline, work.garment, features.tilt_deg, place);
  bool front_seen = inside_given;
  if (!inside_given && work.options.side == Side::front) {
    const std::vector<Vec2> top = stretch(outline.chain, place[neck.from], place[neck.to]);
    const NeckPath path = find_front_neckline(work.photo.rgb, panel, top, forced);
    if (path.found) {
      std::vector<Vec2> old;
      for (const int p : place) old.push_back(outline.chain[p]);
      cv::Mat cut = panel.clone();
      Image labels = features.labels;
      cut_inside(cut, labels, top, path.path);
      cut = clean_mask(cut, 1);
      Outline cut_outline = trace_outline(cut, work.options);
      if (!cut_outline.chain.empty() && cv::countNonZero(cut) > 0.5 * cv::countNonZero(panel)) {
        std::vector<int> cut_place = relocate(cut_outline, old, work.garment);
        const int n = static_cast<int>(cut_outline.chain.size());
        if (in_order(cut_place, outline_order(work.garment), n)) {
          panel = cut;
          features.labels = std::move(labels);
          outline = std::move(cut_outline);
          place = std::move(cut_place);
          features.neckline.inside_found = true;
        }
      }
    }
    front_seen = features.neckline.inside_found || path.expected_none;
    if (!front_seen) features.warnings.push_back("NECKLINE_UNCLEAR");
  }
  const std::vector<Vec2> edge = stretch(outline.chain, place[neck.from], place[neck.to]);
  features.neckline.ratio = neck_ratio(panel, edge, features.neckline.low);
  features.neckline.forced = forced != nullptr;
  if (forced)
    features.neckline.id = forced->id;
  else if (!work.necklines.empty())
    features.neckline.id = work.necklines[choose_neckline(work.necklines, choice_ratio(features.neckline.ratio, edge),
                                                          tip_sharpness(edge), front_seen ? relative_depth(edge) : 0)]
                               .id;
  return outline;
}

Result<Features> find(const Photo& photo, const Silhouette& silhouette, const GarmentTemplate& garment,
                      std::span<const NecklineTemplate> necklines, const FeatureOptions& options) {
  const Work work{photo, garment, necklines, options};
  Features features;
  features.labels = silhouette.labels;
  const cv::Mat labels(features.labels.height, features.labels.width, CV_8U, features.labels.data.data());
  const bool inside_given = cv::countNonZero(labels == label_inside) > 0;
  cv::Mat mask = labels == label_outside;
  const Error no_outline{Cause::unusable, "NO_OUTLINE", file_of(photo) + ": the garment has no closed outline.",
                         "Give a photo in which the whole garment is seen, or a mask.", ""};
  mask = whole_piece(mask);
  if (cv::countNonZero(mask) < 400) return no_outline;
  const cv::Mat piece = mask;
  Fit fit = fit_garment(mask, garment, options);
  if (fit.outline.chain.empty()) return no_outline;
  mask = fit.mask;
  Outline outline = std::move(fit.outline);
  const Match match = std::move(fit.match);
  features.warnings = fit.warnings;
  const double score = fit.score;
  const std::optional<GarmentFit> better =
      score < kSure ? better_garment(piece, garment, score, options) : std::optional<GarmentFit>{};
  if ((match.pose < 0 || match.features.empty()) && !fit.legs_together)
    return not_this_garment(photo, garment, "no way to lay it out matches the outline", better);
  if (score < kMinScore && fit.hidden_sleeve && !better)
    return Error{Cause::unusable, "SLEEVE_ON_BODY",
                 file_of(photo) + ": a sleeve lies on the body without a gap that shows where it ends.",
                 "Lay the sleeves off the body, so that the ground is seen between them.", ""};
  if (score < kMinScore && fit.legs_together && !better)
    return Error{Cause::unusable, "LEGS_TOGETHER",
                 file_of(photo) + ": no ground is seen between the legs that would show where they part.",
                 "Lay the legs apart, so that the ground is seen between them.", ""};
  if (better || score < kMinScore) {
    const std::string why = score < kMinScore ? match.evidence.why : better->id + " fits its outline better";
    return not_this_garment(photo, garment, why + " (score " + two_digits(score) + ")", better);
  }
  features.pose = garment.poses[match.pose].name;
  features.score = score;
  std::vector<int> place;
  std::vector<Vec2> pixels;
  for (const Placed& placed : match.features) {
    place.push_back(outline.samples[placed.sample].chain);
    pixels.push_back(outline.chain[place.back()]);
  }
  features.tilt_deg = tilt_of(pixels, garment, match.tilt_deg);
  if (garment.neck_edge() >= 0)
    outline = settle_neckline(work, mask, std::move(outline), place, inside_given, features);

  for (std::size_t f = 0; f < garment.features.size(); ++f) {
    FeaturePoint point;
    point.name = garment.features[f].name;
    point.landmark = garment.features[f].landmark;
    point.origin = match.features[f].snapped ? "candidate" : "template";
    point.confidence = match.features[f].confidence;
    if (garment.neck_edge() >= 0 && features.neckline.inside_found && !inside_given) {
      const TemplateEdge& neck = garment.edges[garment.neck_edge()];
      if (static_cast<int>(f) == neck.from || static_cast<int>(f) == neck.to) point.origin = "neckline";
    }
    if (static_cast<int>(f) == fit.guessed) {
      point.origin = "template";
      point.confidence = std::min(point.confidence, 0.35);
    }
    features.points.push_back(point);
  }
  features.candidates = outline.candidates;
  if (!make_contour(outline, place, features)) return no_outline;
  return features;
}

}  // namespace

Result<Features> find_features(const Photo& photo, const Silhouette& silhouette, const GarmentTemplate& garment,
                               std::span<const NecklineTemplate> necklines, const FeatureOptions& options) {
  if (std::optional<Error> error = check_input(photo, silhouette, garment, necklines, options)) return *error;
  try {
    return find(photo, silhouette, garment, necklines, options);
  } catch (const std::exception& e) {
    return Error{Cause::internal, "FEATURES_FAILED", file_of(photo) + ": " + e.what(), "Report this as a defect.", ""};
  }
}

int turns_to_upright(const Image& labels, const GarmentTemplate& garment, const FeatureOptions& options) {
  if (!is_label_image(labels) || !usable(garment)) return 0;
  try {
    const cv::Mat view(labels.height, labels.width, CV_8U, const_cast<std::uint8_t*>(labels.data.data()));
    cv::Mat mask = view == label_outside;
    // The question is a coarse one.
    const double scale = std::min(1.0, kTurnSide / std::max(mask.cols, mask.rows));
    cv::resize(mask, mask, {}, scale, scale, cv::INTER_AREA);
    mask = whole_piece(mask > 127);
    int best = 0;
    double best_merit = 0;
    for (int turns = 0; turns < 4; ++turns) {
      const Fit fit = fit_garment(mask, garment, options);
      // A neckline is at the top, whatever else is alike; a skirt fits its template upside down too.
      if (turns == 0 && garment.neck_edge() >= 0 && fit.score >= kSure) return 0;
      // The score says whether the corners are there, the cost whether they are where this garment has them: the waist
      // of a skirt is narrower than its hem.
      const double merit = fit.score - fit.match.cost;
      if (turns == 0 || (fit.score >= kMinScore && merit > best_merit)) {
        best = turns;
        best_merit = merit + (turns == 0 ? kTurnMargin : 0);
      }
      cv::rotate(mask, mask, cv::ROTATE_90_COUNTERCLOCKWISE);
    }
    return best;
  } catch (const std::exception&) {
    return 0;  // find_features meets the same shape, and says what is wrong with it
  }
}

std::vector<GarmentFit> suggest_garment(const Image& labels, std::span<const GarmentTemplate> garments,
                                        const FeatureOptions& options) {
  std::vector<GarmentFit> ranking;
  for (const GarmentTemplate& garment : garments) ranking.push_back({garment.id, 0});
  if (!is_label_image(labels)) return ranking;
  try {
    const cv::Mat view(labels.height, labels.width, CV_8U, const_cast<std::uint8_t*>(labels.data.data()));
    const cv::Mat mask = whole_piece(view == label_outside);
    for (std::size_t i = 0; i < garments.size(); ++i)
      if (usable(garments[i])) ranking[i].score = fit_garment(mask, garments[i], options).score;
  } catch (const std::exception&) {
    for (GarmentFit& fit : ranking) fit.score = 0;  // a shape that cannot be measured suggests nothing
  }
  std::stable_sort(ranking.begin(), ranking.end(),
                   [](const GarmentFit& a, const GarmentFit& b) { return a.score > b.score; });
  return ranking;
}

}  // namespace vitrine
