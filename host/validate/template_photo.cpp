// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/template_photo.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

namespace vitrine {
namespace {

constexpr int long_side = 640;       // [px] of the garment: enough for corners, little enough to be quick
constexpr int margin = 60;           // [px] of board around it
constexpr double back_depth = 0.14;  // [-] of the neck's width: how low a neckline lies at the back

/// [m] Clothes are cut that much lower than the joint that they go around: armholes below armpits, rises below
/// crotches.
constexpr double looser = 0.07;

using Points = std::vector<Vec2>;

struct Look {
  cv::Scalar cloth, inside, board;
};

/// Clear of each other by far: what is tested is the template, not the eyes.
Look look_of(unsigned seed) {
  constexpr double hues[][3] = {{58, 96, 140}, {128, 52, 60}, {52, 104, 74}, {96, 72, 120}, {60, 62, 70}};
  const auto& c = hues[seed % std::size(hues)];
  const double board = 236 - (seed / 5 % 3) * 6.0;
  return {cv::Scalar(c[0], c[1], c[2]), cv::Scalar(0.62 * c[0], 0.62 * c[1], 0.62 * c[2]),
          cv::Scalar(board, board - 2, board - 6)};
}

/// A curve hung between two points: `at` gives (s, depth), both as shares of their distance.
template <class Curve>
void hang(Points& outline, const Vec2& from, const Vec2& to, const Curve& at) {
  const Vec2 along = to - from, down(-along.y(), along.x());
  for (int i = 1; i < 48; ++i) {
    const Vec2 p = at(i / 48.0);
    outline.push_back(from + p.x() * along + p.y() * down);
  }
}

/// Depth of a profile at s, as a share of the neckline's depth.
double depth_at(const std::vector<Vec2>& profile, double s) {
  for (std::size_t i = 1; i < profile.size(); ++i)
    if (s <= profile[i].x()) {
      const double t = (s - profile[i - 1].x()) / (profile[i].x() - profile[i - 1].x());
      return profile[i - 1].y() + t * (profile[i].y() - profile[i - 1].y());
    }
  return 0;
}

void fill(cv::Mat& canvas, const Points& outline, const cv::Scalar& colour) {
  std::vector<cv::Point> fixed;
  for (const Vec2& p : outline)
    fixed.emplace_back(static_cast<int>(std::lround(p.x() * 16)), static_cast<int>(std::lround(p.y() * 16)));
  cv::fillPoly(canvas, std::vector<std::vector<cv::Point>>{fixed}, colour, cv::LINE_AA, 4);
}

}  // namespace

double box_proportions(const GarmentTemplate& garment, const TemplatePose& pose, const Mannequin& body) {
  const ScaleRule& rule = garment.scale;
  const auto girth = body.girths.find(rule.girth);
  const double share = std::abs(pose.uv[rule.feature_a].x() - pose.uv[rule.feature_b].x());
  if (girth == body.girths.end() || share < 0.01) return 1;
  const double width = girth->second * rule.ease / 2 / share;  // [m] of the box
  std::vector<char> at_tip(garment.features.size(), 0);
  for (const TemplateLimb& limb : garment.limbs)
    for (const int tip : {limb.tip_a, limb.tip_b}) at_tip[tip] = 1;
  const auto height_of = [&](int feature) {
    const auto landmark = body.landmarks.find(garment.features[feature].landmark);
    return landmark == body.landmarks.end() ? std::nan("") : landmark->second.y();
  };
  double nearest = 1e9, height = width;
  for (const int anchor : garment.anchors)
    for (std::size_t i = 0; i < garment.features.size(); ++i) {
      const double drop = height_of(anchor) - height_of(static_cast<int>(i));
      const double shown = pose.uv[i].y() - pose.uv[anchor].y();
      // Closer than a hand's breadth the body's own slopes (of the shoulders) decide; a sleeve's end hangs anywhere.
      if (at_tip[i] || !(drop > 0.08) || shown < 0.1 || drop >= nearest) continue;
      nearest = drop;
      height = (drop + looser) / shown;
    }
  return std::clamp(height / width, 0.35, 3.0);
}

TemplatePhoto draw_template_photo(const GarmentTemplate& garment, const TemplatePose& pose,
                                  const NecklineTemplate* neckline, Side side, double proportions, unsigned seed) {
  TemplatePhoto photo;
  const Vec2 box = long_side * Vec2(std::min(1.0, 1 / proportions), std::min(1.0, proportions));
  photo.diagonal = box.norm();
  std::mt19937 random(seed);
  // Not std::uniform_real_distribution, whose numbers are the library's own.
  const auto chance = [&] { return static_cast<double>(random()) / 4294967296.0 * 2 - 1; };
  for (std::size_t i = 0; i < pose.uv.size(); ++i) {
    const double move = seed == 0 ? 0 : 0.1 * pose.radius[i] * photo.diagonal / std::sqrt(2.0);
    const Vec2 moved(move * chance(), move * chance());
    photo.features.push_back(Vec2(margin, margin) + pose.uv[i].cwiseProduct(box) + moved);
  }
  // A pose's box is that of the silhouette, which goes beyond the corners where edges are curved: a hem hangs, a
  // sleeve bends. The edge next to a side that no corner reaches is bowed until it does.
  std::vector<Vec2> bow(garment.edges.size(), Vec2::Zero());
  for (const Vec2& side_way : {Vec2(-1, 0), Vec2(1, 0), Vec2(0, -1), Vec2(0, 1)}) {
    const Vec2 corner = Vec2(margin, margin) + (side_way.cwiseMax(0)).cwiseProduct(box);
    const auto short_of = [&](const Vec2& p) { return (corner - p).dot(side_way); };
    double slack = 1e9;
    for (const Vec2& p : photo.features) slack = std::min(slack, short_of(p));
    if (slack < 0.015 * long_side || side_way.y() < 0) continue;  // a top edge is the neckline's, or straight
    // Bowed as a parabola over the chord; of all edges long enough to be bowed, the one that needs least.
    double least = 0.25 * long_side;
    std::size_t bowed = garment.edges.size();
    for (std::size_t e = 0; e < garment.edges.size(); ++e) {
      const Vec2 &from = photo.features[garment.edges[e].from], &to = photo.features[garment.edges[e].to];
      if (static_cast<int>(e) == garment.neck_edge() || (to - from).norm() < 0.2 * long_side) continue;
      // Distance d(s) to the side minus 4 s (1 - s) b has to reach 0 somewhere: b = min over s of d / (4 s (1 - s)).
      double need = 1e9;
      for (int i = 1; i < 48; ++i) {
        const double s = i / 48.0;
        need = std::min(need, short_of(from + s * (to - from)) / (4 * s * (1 - s)));
      }
      if (need >= least) continue;
      least = need;
      bowed = e;
    }
    if (bowed < garment.edges.size()) bow[bowed] += least * side_way;
  }
  Points whole, face;  // with the back's neckline, and with this side's
  const auto back_neck = [](double s) { return Vec2(s, back_depth * 4 * s * (1 - s)); };
  for (std::size_t e = 0; e < garment.edges.size(); ++e) {
    const Vec2 &from = photo.features[garment.edges[e].from], &to = photo.features[garment.edges[e].to];
    whole.push_back(from);
    face.push_back(from);
    if (bow[e] != Vec2::Zero())
      for (int i = 1; i < 48; ++i) {
        const double s = i / 48.0;
        whole.push_back(from + s * (to - from) + 4 * s * (1 - s) * bow[e]);
        face.push_back(whole.back());
      }
    if (static_cast<int>(e) != garment.neck_edge() || neckline == nullptr) continue;
    hang(whole, from, to, back_neck);
    const double depth = neckline->default_depth;
    // A neckline shallower than the back's shows nothing of the inside.
    bool deeper = false;
    for (const double s : {0.25, 0.5, 0.75})
      deeper = deeper || depth * depth_at(neckline->profile, s) > back_neck(s).y();
    if (side == Side::back || !deeper) {
      hang(face, from, to, back_neck);
      continue;
    }
    const Vec2 along = to - from, down(-along.y(), along.x());
    for (std::size_t i = 1; i + 1 < neckline->profile.size(); ++i)
      face.push_back(from + neckline->profile[i].x() * along + neckline->profile[i].y() * depth * down);
  }
  const Look look = look_of(seed);
  const int width = static_cast<int>(box.x()) + 2 * margin, height = static_cast<int>(box.y()) + 2 * margin;
  photo.rgb = Image(width, height, 3);
  cv::Mat canvas(height, width, CV_8UC3, photo.rgb.data.data());
  canvas.setTo(look.board);
  fill(canvas, whole, look.inside);
  fill(canvas, face, look.cloth);
  if (side == Side::back) cv::flip(canvas, canvas, 1);
  return photo;
}

}  // namespace vitrine
