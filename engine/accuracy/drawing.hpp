// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "vitrine/model/geometry.hpp"
#include "vitrine/model/image.hpp"

namespace vitrine::accuracy {

enum class Anchor { start, middle, end };

/// Lines, dots and words on white, in pixels from the top left corner: as SVG and as pixels.
class Drawing {
 public:
  Drawing(int width, int height) : width_(width), height_(height) {}
  void line(const std::vector<Vec2>& points, const std::string& colour, double width);  ///< colour: #rrggbb
  void dot(const Vec2& at, double radius, const std::string& colour);
  void words(const Vec2& at, const std::string& text, const std::string& colour, Anchor anchor = Anchor::start,
             double size = 12);
  std::string svg() const;
  Image pixels(int scale) const;  ///< RGB

 private:
  struct Mark {
    std::vector<Vec2> points;
    std::string text, colour;  ///< text: empty for lines and dots
    double size = 0;           ///< width, radius or height of the letters
    Anchor anchor = Anchor::start;
  };
  int width_, height_;
  std::vector<Mark> marks_;
};

}  // namespace vitrine::accuracy
