// SPDX-License-Identifier: GPL-3.0-or-later
// What was seen in one photo, drawn for people.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "as_given.hpp"
#include "draw.hpp"

namespace vitrine {
namespace {

// Names of up to 14 points need this much room to be read; photos are often smaller.
constexpr int kLegibleSide = 1100;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

const cv::Scalar kOutline(0, 230, 118), kPanel(190, 90, 255), kSeen(255, 255, 255), kPlaced(255, 150, 30),
    kDark(20, 20, 24);

/// A picture with the sizes that follow from its own.
struct Sheet {
  cv::Mat canvas;
  double unit = 1;  ///< [px] width of a thin line
  int line() const { return std::max(1, static_cast<int>(std::lround(unit))); }
  double font() const { return 0.5 * unit; }
  cv::Size text(const std::string& s, double font) const {
    int below = 0;
    const cv::Size size = cv::getTextSize(s, kFont, font, line(), &below);
    return {size.width, size.height + below};
  }
};

/// Dims the ground, tints the inside, draws the outlines with a dark rim that shows on any cloth.
void draw_regions(const Sheet& sheet, const Image& labels, const std::vector<Vec2>& panel) {
  const cv::Mat l(labels.height, labels.width, CV_8U, const_cast<std::uint8_t*>(labels.data.data()));
  cv::Mat dim = 0.72 * sheet.canvas;
  dim.copyTo(sheet.canvas, l == label_background);
  cv::Mat tint = 0.55 * sheet.canvas + 0.45 * kPanel;
  tint.copyTo(sheet.canvas, l == label_inside);

  std::vector<cv::Point> own;
  for (const Vec2& p : panel) own.push_back(fixed(p));
  if (!own.empty()) cv::polylines(sheet.canvas, own, true, kPanel, 3 * sheet.line(), cv::LINE_AA, 4);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(l != label_background, contours, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  cv::polylines(sheet.canvas, contours, true, kDark, 4 * sheet.line(), cv::LINE_AA);
  cv::polylines(sheet.canvas, contours, true, kOutline, 2 * sheet.line(), cv::LINE_AA);
}

struct Mark {
  std::string text;
  Vec2 at;
  bool seen;
};

/// Where the names go: close to their point, outwards, off each other, off the points and rather off the garment.
std::vector<cv::Rect> place_labels(const Sheet& sheet, const std::vector<Mark>& marks, const cv::Mat& garment) {
  cv::Mat sums;  // of garment pixels, to weigh a box in four look-ups
  cv::integral(garment / 255, sums, CV_32S);
  const cv::Rect page(0, 0, garment.cols, garment.rows);
  Vec2 middle(0, 0);
  for (const Mark& m : marks) middle += m.at / static_cast<double>(marks.size());
  std::vector<cv::Rect> boxes;
  for (const Mark& m : marks) {
    const int pad = 3 * sheet.line();
    const cv::Size text = sheet.text(m.text, sheet.font());
    const cv::Size size(text.width + 2 * pad, text.height + 2 * pad);
    const Vec2 outward = (m.at - middle).normalized();
    cv::Rect best;
    double least = 1e30;
    for (const double reach : {0.7, 1.4, 2.4, 3.6, 5.0, 7.0})
      for (int k = 0; k < 16; ++k) {
        const double angle = 2 * std::numbers::pi * k / 16;
        const Vec2 way(std::cos(angle), std::sin(angle));
        // The box stands so far out that its nearest corner or side is `reach` lines away from the point.
        const double half = std::abs(way.x()) * size.width / 2 + std::abs(way.y()) * size.height / 2;
        const Vec2 centre = m.at + (half + reach * size.height) * way;
        const cv::Rect box(static_cast<int>(std::lround(centre.x() - size.width / 2.0)),
                           static_cast<int>(std::lround(centre.y() - size.height / 2.0)), size.width, size.height);
        const cv::Rect seen = box & page;
        double cost = 0.5 * reach - 0.4 * way.dot(outward);
        cost += 100.0 * (1 - static_cast<double>(seen.area()) / box.area());
        for (const cv::Rect& other : boxes) cost += 60.0 * ((box & other).area() > 0);
        for (const Mark& other : marks) {
          const cv::Rect wide(box.x - pad, box.y - pad, box.width + 2 * pad, box.height + 2 * pad);
          cost += 40.0 * wide.contains(cv::Point(static_cast<int>(other.at.x()), static_cast<int>(other.at.y())));
        }
        if (seen.area() > 0) {
          const cv::Point a = seen.tl(), b = seen.br();
          const int on =
              sums.at<int>(b.y, b.x) - sums.at<int>(a.y, b.x) - sums.at<int>(b.y, a.x) + sums.at<int>(a.y, a.x);
          cost += 1.5 * on / seen.area();
        }
        if (cost < least) {
          least = cost;
          best = box;
        }
      }
    boxes.push_back(best);
  }
  return boxes;
}

void draw_mark(const Sheet& sheet, const Mark& mark, const cv::Rect& box) {
  const cv::Scalar& colour = mark.seen ? kSeen : kPlaced;
  const Vec2 end(std::clamp(mark.at.x(), static_cast<double>(box.x), static_cast<double>(box.x + box.width)),
                 std::clamp(mark.at.y(), static_cast<double>(box.y), static_cast<double>(box.y + box.height)));
  cv::line(sheet.canvas, fixed(mark.at), fixed(end), kDark, 3 * sheet.line(), cv::LINE_AA, 4);
  cv::line(sheet.canvas, fixed(mark.at), fixed(end), colour, sheet.line(), cv::LINE_AA, 4);
  const cv::Rect shown = box & cv::Rect(0, 0, sheet.canvas.cols, sheet.canvas.rows);
  cv::Mat patch = sheet.canvas(shown);
  patch = 0.25 * patch + 0.75 * kDark;
  const int pad = 3 * sheet.line();
  int below = 0;
  const int height = cv::getTextSize(mark.text, kFont, sheet.font(), sheet.line(), &below).height;
  cv::putText(sheet.canvas, mark.text, {box.x + pad, box.y + pad + height}, kFont, sheet.font(), colour, sheet.line(),
              cv::LINE_AA);
}

void draw_dot(const Sheet& sheet, const Mark& mark) {
  const auto radius = [&](double r) { return static_cast<int>(std::lround(r * sheet.unit * 16)); };
  cv::circle(sheet.canvas, fixed(mark.at), radius(5.5), kDark, cv::FILLED, cv::LINE_AA, 4);
  // Shape as well as colour tells them apart: a full disc was seen, a ring was placed.
  cv::circle(sheet.canvas, fixed(mark.at), radius(4.0), mark.seen ? cv::Scalar(235, 30, 60) : kPlaced, cv::FILLED,
             cv::LINE_AA, 4);
  if (!mark.seen) cv::circle(sheet.canvas, fixed(mark.at), radius(2.0), kDark, cv::FILLED, cv::LINE_AA, 4);
}

std::vector<std::pair<std::string, cv::Scalar>> caption(const ViewRequest& request, const View& view, bool any_placed) {
  std::ostringstream out;
  out << request.garment.id << (request.side == Side::front ? ", front" : ", back") << std::fixed
      << std::setprecision(2);
  const Features& f = view.features;
  if (!f.points.empty()) out << "; pose " << f.pose;
  if (!f.neckline.id.empty())
    out << "; " << f.neckline.id << ", ratio " << f.neckline.ratio << (f.neckline.inside_found ? ", inside seen" : "");
  out << "; outline by " << view.silhouette.method;
  std::vector<std::pair<std::string, cv::Scalar>> lines{{out.str(), kSeen}};
  if (view.error) lines.emplace_back("refused: " + view.error->code, cv::Scalar(255, 90, 70));
  std::string warnings;
  for (const std::string& w : view.warnings()) warnings += (warnings.empty() ? "" : ", ") + w;
  if (!warnings.empty()) lines.emplace_back("warnings: " + warnings, kPlaced);
  if (any_placed) lines.emplace_back("rings: low confidence, placed by the template", kPlaced);
  return lines;
}

}  // namespace

Image draw_view(const ViewRequest& request, const View& view) {
  if (labels_of(view).empty() || view.photo.rgb.empty()) return {};
  Image photo = as_given(view.photo, view.photo.rgb);
  const double enlarge = std::max(1.0, static_cast<double>(kLegibleSide) / std::max(photo.width, photo.height));
  const cv::Size size(static_cast<int>(std::lround(photo.width * enlarge)),
                      static_cast<int>(std::lround(photo.height * enlarge)));
  const Image labels = resize_labels(as_given(view.photo, labels_of(view)), size.width, size.height);
  const cv::Mat garment = cv::Mat(size, CV_8U, const_cast<std::uint8_t*>(labels.data.data())) != label_background;
  Sheet sheet;
  sheet.unit = std::max(size.width, size.height) / static_cast<double>(kLegibleSide);
  cv::resize(cv::Mat(photo.height, photo.width, CV_8UC3, photo.data.data()), sheet.canvas, size, 0, 0, cv::INTER_CUBIC);

  const Vec2 scale(static_cast<double>(size.width) / view.photo.source_width,
                   static_cast<double>(size.height) / view.photo.source_height);
  const auto place = [&](const Vec2& p) { return Vec2((p + Vec2(0.5, 0.5)).cwiseProduct(scale) - Vec2(0.5, 0.5)); };
  std::vector<Vec2> panel;
  for (const Vec2& p : view.features.contour) panel.push_back(place(pixel_as_given(view.photo, p)));
  draw_regions(sheet, labels, panel);
  std::vector<Mark> marks;
  for (const NamedPoint& p : points_as_given(request, view))
    marks.push_back({p.name, place(p.pixel), p.confidence >= low_confidence});
  const std::vector<cv::Rect> boxes = place_labels(sheet, marks, garment);
  for (std::size_t i = 0; i < marks.size(); ++i) draw_mark(sheet, marks[i], boxes[i]);
  bool any_placed = false;
  for (const Mark& m : marks) {
    draw_dot(sheet, m);
    any_placed = any_placed || !m.seen;
  }

  const auto lines = caption(request, view, any_placed);
  const int gap = 6 * sheet.line(), step = sheet.text("Ag", sheet.font()).height + gap;
  Image result(size.width, size.height + gap + step * static_cast<int>(lines.size()), 3, 24);
  cv::Mat page(result.height, result.width, CV_8UC3, result.data.data());
  sheet.canvas.copyTo(page(cv::Rect(0, 0, size.width, size.height)));
  int y = size.height;
  for (const auto& [text, colour] : lines) {
    y += step;
    const int room = size.width - 2 * gap, width = sheet.text(text, sheet.font()).width;
    const double font = sheet.font() * std::min(1.0, static_cast<double>(room) / width);
    cv::putText(page, text, {gap, y - gap / 2}, kFont, font, colour, sheet.line(), cv::LINE_AA);
  }
  return result;
}

}  // namespace vitrine
