// SPDX-License-Identifier: GPL-3.0-or-later
#include "sleeves.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "legs.hpp"

namespace vitrine::features_detail {
namespace {

constexpr double kMinHoleArea = 0.0002;   // of the garment's area: smaller holes are dirt
constexpr double kMinHoleHeight = 0.015;  // of the box diagonal
constexpr double kMaxOverlap = 0.15;      // of the box diagonal: how far a cuff may reach over the body
// The strip of cloth under a cuff is seen once but belongs to sleeve and body. Half of it goes to each, so that neither
// the cuff nor the side seam is far from the truth and the outline stays simple.
constexpr double kSleeveShare = 0.5;

struct Hole {
  cv::Mat mask;  // CV_8U, full size
  cv::Rect box;
  Vec2 centre, top, end;  // end: lowest point, on the sleeve's side
  Vec2 body_end;          // lowest point on the body's side
  int side = 0;           // -1 left, +1 right
};

std::vector<Hole> find_holes(const cv::Mat& mask, const cv::Rect& box, double area, double diagonal) {
  // Holes lie among the mask's pixels.
  const cv::Rect part = cv::boundingRect(mask);
  cv::Mat background = mask(part) == 0;
  cv::Mat padded;
  cv::copyMakeBorder(background, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 255);
  cv::Mat labels, stats, centres;
  // 4-connected background against the 8-connected walk of the outline: a diagonal leak does not open a hole.
  const int count = cv::connectedComponentsWithStats(padded, labels, stats, centres, 4);
  const int outer = labels.at<int>(0, 0);
  std::vector<Hole> holes;
  for (int i = 1; i < count; ++i) {
    if (i == outer || stats.at<int>(i, cv::CC_STAT_AREA) < kMinHoleArea * area ||
        stats.at<int>(i, cv::CC_STAT_HEIGHT) < kMinHoleHeight * diagonal)
      continue;
    Hole hole;
    hole.mask = cv::Mat::zeros(mask.size(), CV_8U);
    cv::Mat(labels == i)(cv::Rect(1, 1, part.width, part.height)).copyTo(hole.mask(part));
    hole.box = cv::boundingRect(hole.mask);
    hole.centre = Vec2(part.x + centres.at<double>(i, 0) - 1, part.y + centres.at<double>(i, 1) - 1);
    int bottom_left = -1, bottom_right = -1;
    const int last = hole.box.br().y - 1;
    for (int x = hole.box.x; x < hole.box.br().x; ++x) {
      if (hole.mask.at<uchar>(hole.box.y, x)) hole.top = Vec2(x, hole.box.y);
      if (!hole.mask.at<uchar>(last, x)) continue;
      if (bottom_left < 0) bottom_left = x;
      bottom_right = x;
    }
    const double u = (hole.centre.x() - box.x) / box.width;
    const double v = (hole.centre.y() - box.y) / box.height;
    if (v > 0.2 && u > 0.02 && u < 0.98 && std::abs(u - 0.5) > 0.12) hole.side = u < 0.5 ? -1 : 1;
    hole.end = Vec2(hole.side < 0 ? bottom_left : bottom_right, last);
    hole.body_end = Vec2(hole.side < 0 ? bottom_right : bottom_left, last);
    holes.push_back(std::move(hole));
  }
  return holes;
}

/// Direction of the sleeve's inner edge at the lower end of the gap: a line through the outer side of its lower half.
Vec2 edge_direction(const Hole& hole) {
  double n = 0, sx = 0, sy = 0, sxy = 0, syy = 0;
  const int y0 = hole.box.y + hole.box.height / 3;
  for (int y = y0; y < hole.box.br().y; ++y) {
    int edge = -1;
    for (int x = hole.box.x; x < hole.box.br().x; ++x)
      if (hole.mask.at<uchar>(y, x) && (edge < 0 || hole.side > 0)) edge = x;
    if (edge < 0) continue;
    n += 1;
    sx += edge;
    sy += y;
    sxy += static_cast<double>(edge) * y;
    syy += static_cast<double>(y) * y;
  }
  const double spread = n * syy - sy * sy;
  const double slope = spread > 0 ? std::clamp((n * sxy - sx * sy) / spread, -0.7, 0.7) : 0;
  return Vec2(slope, 1).normalized();
}

/// The concave corner between cuff and hem that the sleeve's edge runs to.
std::optional<int> find_notch(const Outline& outline, const Vec2& end, const Vec2& direction) {
  std::optional<int> best;
  double best_cost = 1e30;
  for (int s = 0; s < static_cast<int>(outline.samples.size()); ++s) {
    const Sample& sample = outline.samples[s];
    if (sample.candidate < 0 || sample.turn_deg > -35) continue;
    const Vec2 way = sample.at - end;
    const double distance = way.norm() / outline.diagonal;
    if (way.y() <= 0 || distance > 0.5) continue;
    const double off = std::acos(std::clamp(way.normalized().dot(direction), -1.0, 1.0));
    if (off > 0.7) continue;
    // Ripples of a hem bend less than the corner that a cuff makes with it, and may lie closer to the edge's line.
    const double cost = 0.7 * off + distance - 0.8 * std::min(std::abs(sample.turn_deg), 90.0) / 90;
    if (cost < best_cost) {
      best_cost = cost;
      best = s;
    }
  }
  return best;
}

Vec2 leave_mask(const cv::Mat& mask, const Vec2& end, const Vec2& direction) {
  Vec2 p = end + 2 * direction;
  for (int i = 0; i < mask.rows + mask.cols; ++i, p += direction) {
    const int x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
    if (x < 0 || y < 0 || x >= mask.cols || y >= mask.rows || mask.at<uchar>(y, x) == 0) break;
  }
  return p + direction;
}

void open_gap(cv::Mat& mask, const Outline& outline, const Hole& hole) {
  const Vec2 direction = edge_direction(hole);
  const std::optional<int> notch = find_notch(outline, hole.end, direction);
  if (!notch) {
    cut_slit(mask, hole.end, leave_mask(mask, hole.end, direction), outline.diagonal);
    return;
  }
  const int n = static_cast<int>(outline.samples.size());
  const Vec2 corner = outline.samples[*notch].at;
  // Along the cuff, away from the body: clockwise on the right of the picture is towards the hem, on the left away.
  const int arm = std::max(3, static_cast<int>(0.04 * outline.diagonal / outline.step));
  const Vec2 cuff = outline.samples[((*notch - hole.side * arm) % n + n) % n].at;
  const Vec2 inward = (corner - cuff).normalized();
  const double det = direction.x() * -inward.y() + direction.y() * inward.x();
  Vec2 tip = corner;
  if (std::abs(det) > 0.2) {
    // end + s * direction = corner + t * inward
    const Vec2 way = corner - hole.end;
    const double t = (direction.x() * way.y() - direction.y() * way.x()) / det;
    if (t > 0) tip = corner + kSleeveShare * std::min(t, kMaxOverlap * outline.diagonal) * inward;
  }
  // A cuff that only touches the body keeps what bridges the gap: the side seam stays straight.
  cut_slit(mask, tip == corner ? hole.body_end : hole.end, tip, outline.diagonal);
  if ((tip - corner).norm() > 1) cut_slit(mask, tip, corner, outline.diagonal);
}

}  // namespace

void cut_slit(cv::Mat& mask, const Vec2& from, const Vec2& to, double diagonal) {
  if (!from.allFinite() || !to.allFinite()) return;
  const int width = std::max(3, static_cast<int>(std::lround(0.002 * diagonal)));
  const auto pixel = [](const Vec2& p) {
    return cv::Point(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
  };
  cv::line(mask, pixel(from), pixel(to), 0, width);
}

bool cut_hidden_gap(cv::Mat& mask, const Outline& outline, const Vec2& armpit, int side) {
  const double middle = outline.box.x + outline.box.width / 2.0;
  int best = -1;
  double best_cost = 1e30;
  for (int s = 0; s < static_cast<int>(outline.samples.size()); ++s) {
    const Sample& sample = outline.samples[s];
    if (sample.candidate < 0 || sample.turn_deg > -45 || (sample.at.x() - middle) * side < 0.1 * outline.box.width)
      continue;
    const Vec2 way = sample.at - armpit;
    if (way.y() < 0.2 * outline.box.height) continue;
    const double cost = std::abs(way.x()) / way.y() - 0.3 * std::abs(sample.turn_deg) / 90;
    if (cost < best_cost && std::abs(way.x()) < 0.6 * way.y()) {
      best_cost = cost;
      best = s;
    }
  }
  if (best < 0) return false;
  const double area = cv::countNonZero(mask);
  cv::Mat cut = mask.clone();
  const Vec2 notch = outline.samples[best].at;
  cut_slit(cut, armpit, notch + 2 * (notch - armpit).normalized(), outline.diagonal);
  cut = clean_mask(cut, 0);
  if (cv::countNonZero(cut) < 0.96 * area) return false;
  mask = cut;
  return true;
}

SleeveCuts open_sleeve_gaps(const cv::Mat& mask, const GarmentTemplate& garment, const FeatureOptions& options) {
  SleeveCuts result;
  result.mask = mask.clone();
  const double area = cv::countNonZero(mask);
  const Outline outline = trace_outline(mask, options);
  if (outline.chain.empty()) return result;
  std::vector<Hole> holes = find_holes(mask, outline.box, area, outline.diagonal);
  for (const Hole& hole : holes)
    if (hole.side != 0) result.gap_share += cv::countNonZero(hole.mask) / area;
  if (has_sleeves(garment)) {
    std::stable_sort(holes.begin(), holes.end(), [](const Hole& a, const Hole& b) { return a.end.y() > b.end.y(); });
    const Hole* below[2] = {nullptr, nullptr};
    for (const Hole& hole : holes) {
      if (hole.side == 0) continue;
      const Hole*& lower = below[hole.side > 0];
      if (lower && lower->top.y() > hole.end.y())
        cut_slit(result.mask, hole.end, lower->top, outline.diagonal);
      else if (!lower)
        open_gap(result.mask, outline, hole);
      lower = &hole;
      ++result.opened;
    }
    const cv::Mat opened = clean_mask(result.mask, 0);
    // A cut that takes a whole sleeve off was no gap between sleeve and body.
    if (cv::countNonZero(opened) < 0.96 * area) {
      result.mask = mask.clone();
      result.opened = 0;
    } else {
      result.mask = opened;
    }
  }
  // What is still enclosed does not belong to the outline.
  std::vector<std::vector<cv::Point>> walks;
  cv::Mat padded;
  cv::copyMakeBorder(result.mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::findContours(padded.clone(), walks, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE, {-1, -1});
  cv::drawContours(result.mask, walks, -1, 255, cv::FILLED);
  return result;
}

}  // namespace vitrine::features_detail
