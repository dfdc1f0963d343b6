// SPDX-License-Identifier: GPL-3.0-or-later
// Draws two photos of a poncho as a shop lays one down: draw-poncho FRONT.png BACK.png. The same pixels every time.
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

namespace {

constexpr int width = 1200, height = 1000;

/// Outline [px], clockwise from the left of the neck. `depth` of the neck [px].
std::vector<cv::Point2d> outline(double depth) {
  std::vector<cv::Point2d> line;
  const cv::Point2d neck_left(515, 140), neck_right(685, 140);
  for (int i = 0; i <= 40; ++i) {  // half an ellipse
    const double a = M_PI * (1 - i / 40.0);
    line.push_back((neck_left + neck_right) / 2 + cv::Point2d(85 * std::cos(a), depth * std::sin(a)));
  }
  // Shoulder lines fall in a straight line, sides and hem hang through a little.
  line.insert(line.end(), {{1112, 338}, {1106, 480}, {1097, 620}, {1090, 760}, {1082, 858}});
  for (int i = 1; i < 24; ++i) line.push_back({1082 - (1082 - 118) * i / 24.0, 858 + 12 * std::sin(M_PI * i / 24)});
  line.insert(line.end(), {{118, 858}, {110, 760}, {103, 620}, {94, 480}, {88, 338}});
  return line;
}

cv::Mat1f covered(const std::vector<cv::Point2d>& line) {
  constexpr int fine = 4;
  std::vector<cv::Point> points;
  for (const cv::Point2d& p : line)
    points.emplace_back(static_cast<int>(std::lround(p.x * fine)), static_cast<int>(std::lround(p.y * fine)));
  cv::Mat1b mask(height * fine, width * fine, std::uint8_t{0});
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{points}, 255);
  cv::Mat small;
  cv::resize(mask, small, {width, height}, 0, 0, cv::INTER_AREA);
  cv::Mat1f share;
  small.convertTo(share, CV_32F, 1 / 255.0);
  return share;
}

/// BGR of the cloth: bands of a woven border along the hem, and a fine weave.
cv::Vec3d cloth(double x, double y) {
  const cv::Vec3d ground(64, 92, 158), cream(196, 222, 236), green(92, 108, 58), dark(52, 50, 74);
  cv::Vec3d colour = ground;
  const double up = 858 + 12 * std::sin(M_PI * (1082 - x) / 964) - y;  // above the hem
  for (const auto& [from, to, band] : {std::tuple{40.0, 62.0, cream},
                                       {74.0, 84.0, dark},
                                       {96.0, 140.0, green},
                                       {152.0, 162.0, dark},
                                       {174.0, 196.0, cream},
                                       {330.0, 340.0, cream}})
    if (up >= from && up < to) colour = band;
  if (up >= 108 && up < 128 && std::abs(std::remainder(x - 600, 44)) + std::abs(up - 118) < 11) colour = cream;
  return colour * (1 + 0.025 * std::sin(x * 1.9) * std::sin(y * 1.7));
}

void draw(const char* file, double depth, unsigned seed) {
  const cv::Mat1f garment = covered(outline(depth));
  // The inside of the back is seen above the front's neckline.
  const cv::Mat1f inside = covered(outline(22));
  cv::Mat1f shadow;
  cv::GaussianBlur(garment, shadow, {}, 9);
  std::mt19937 random(seed);
  const auto noise = [&] { return (static_cast<double>(random()) / 4294967296.0 - 0.5) * 5; };
  cv::Mat3b photo(height, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double light = 1 - 0.07 * (x + y) / (width + height);
      const double fold = 1 + 0.05 * std::sin(x / 61.0 + y / 400.0) + 0.03 * std::sin(x / 23.0 - y / 300.0);
      cv::Vec3d colour = cv::Vec3d(228, 234, 238) * (1 - 0.12 * shadow(y, x));
      colour += inside(y, x) * (0.55 * cloth(x, y) - colour);
      colour += garment(y, x) * (fold * cloth(x, y) - colour);
      for (int c = 0; c < 3; ++c) photo(y, x)[c] = cv::saturate_cast<std::uint8_t>(colour[c] * light + noise());
    }
  if (!cv::imwrite(file, photo)) std::perror(file), std::exit(73);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("usage: draw-poncho FRONT.png BACK.png\n", stderr), 64;
  draw(argv[1], 95, 1);
  draw(argv[2], 22, 2);
}
