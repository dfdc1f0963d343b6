// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing.hpp"

#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

namespace vitrine::accuracy {
namespace {

constexpr int shift = 4;  // OpenCV draws at sixteenths of a pixel
constexpr auto font = cv::FONT_HERSHEY_SIMPLEX;

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", v);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

cv::Scalar rgb(const std::string& colour) {
  unsigned r = 0, g = 0, b = 0;
  std::sscanf(colour.c_str(), "#%2x%2x%2x", &r, &g, &b);
  return cv::Scalar(r, g, b);
}

cv::Point fixed(const Vec2& p, int scale) {
  return {static_cast<int>(std::lround(p.x() * scale * (1 << shift))),
          static_cast<int>(std::lround(p.y() * scale * (1 << shift)))};
}

}  // namespace

void Drawing::line(const std::vector<Vec2>& points, const std::string& colour, double width) {
  if (points.size() > 1) marks_.push_back({points, "", colour, width, Anchor::start});
}

void Drawing::dot(const Vec2& at, double radius, const std::string& colour) {
  marks_.push_back({{at}, "", colour, radius, Anchor::start});
}

void Drawing::words(const Vec2& at, const std::string& text, const std::string& colour, Anchor anchor, double size) {
  if (!text.empty()) marks_.push_back({{at}, text, colour, size, anchor});
}

std::string Drawing::svg() const {
  const std::string size = std::to_string(width_) + "' height='" + std::to_string(height_);
  std::string out = "<svg xmlns='http://www.w3.org/2000/svg' width='" + size + "' viewBox='0 0 " +
                    std::to_string(width_) + " " + std::to_string(height_) +
                    "' font-family='sans-serif'>\n<rect width='100%' height='100%' fill='#ffffff'/>\n";
  for (const Mark& m : marks_) {
    const Vec2& at = m.points.front();
    if (!m.text.empty()) {
      const char* anchor = m.anchor == Anchor::start ? "start" : m.anchor == Anchor::middle ? "middle" : "end";
      out += "<text x='" + number(at.x()) + "' y='" + number(at.y()) + "' font-size='" + number(m.size) + "' fill='" +
             m.colour + "' text-anchor='" + anchor + "'>" + escaped(m.text) + "</text>\n";
    } else if (m.points.size() == 1) {
      out += "<circle cx='" + number(at.x()) + "' cy='" + number(at.y()) + "' r='" + number(m.size) + "' fill='" +
             m.colour + "'/>\n";
    } else {
      out += "<polyline points='";
      for (const Vec2& p : m.points) out += number(p.x()) + "," + number(p.y()) + " ";
      out.back() = '\'';
      out += " fill='none' stroke='" + m.colour + "' stroke-width='" + number(m.size) + "'/>\n";
    }
  }
  return out + "</svg>\n";
}

Image Drawing::pixels(int scale) const {
  Image image(width_ * scale, height_ * scale, 3, 255);
  cv::Mat canvas(image.height, image.width, CV_8UC3, image.data.data());
  for (const Mark& m : marks_) {
    if (!m.text.empty()) {
      const double height = m.size * scale * 0.72 / 22;  // a capital of this font is 22 px high at scale 1
      int below = 0;
      const int thick = std::max(1, scale / 2);
      const cv::Size box = cv::getTextSize(m.text, font, height, thick, &below);
      const double left = m.anchor == Anchor::start ? 0 : m.anchor == Anchor::middle ? box.width / 2.0 : box.width;
      cv::putText(canvas, m.text,
                  {static_cast<int>(std::lround(m.points[0].x() * scale - left)),
                   static_cast<int>(std::lround(m.points[0].y() * scale))},
                  font, height, rgb(m.colour), thick, cv::LINE_AA);
    } else if (m.points.size() == 1) {
      cv::circle(canvas, fixed(m.points[0], scale), static_cast<int>(std::lround(m.size * scale * (1 << shift))),
                 rgb(m.colour), cv::FILLED, cv::LINE_AA, shift);
    } else {
      for (std::size_t i = 1; i < m.points.size(); ++i)
        cv::line(canvas, fixed(m.points[i - 1], scale), fixed(m.points[i], scale), rgb(m.colour),
                 std::max(1, static_cast<int>(std::lround(m.size * scale))), cv::LINE_AA, shift);
    }
  }
  return image;
}

}  // namespace vitrine::accuracy
