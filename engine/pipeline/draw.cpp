// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "vitrine/pipeline.hpp"

namespace vitrine {
namespace {

cv::Mat as_mat(Image& image) {
  return cv::Mat(image.height, image.width, CV_8UC(image.channels), image.data.data());
}

cv::Point to_point(const Vec2& p) {
  // Sub-pixel drawing: OpenCV takes fixed-point coordinates with `shift` fractional bits.
  return {static_cast<int>(std::lround(p.x() * 16)), static_cast<int>(std::lround(p.y() * 16))};
}

}  // namespace

Image draw_features(const Photo& photo, const Silhouette& silhouette, const Features& features) {
  Image image = photo.rgb;
  cv::Mat canvas = as_mat(image);
  const Image& labels = features.labels.empty() ? silhouette.labels : features.labels;
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      std::uint8_t* p = image.at(x, y);
      const std::uint8_t label = *labels.at(x, y);
      if (label == label_background)
        for (int c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>(p[c] / 3);
      else if (label == label_inside)
        p[0] = static_cast<std::uint8_t>((p[0] + 510) / 3), p[2] = static_cast<std::uint8_t>((p[2] + 255) / 2);
    }
  const int unit = std::max(1, std::max(image.width, image.height) / 400);
  std::vector<cv::Point> line;
  for (const Vec2& p : features.contour) line.push_back(to_point(p));
  if (!line.empty()) cv::polylines(canvas, line, true, {0, 255, 120}, unit, cv::LINE_AA, 4);
  for (const Candidate& c : features.candidates)
    cv::circle(canvas, to_point(c.pixel), 2 * unit * 16, {255, 255, 0}, cv::FILLED, cv::LINE_AA, 4);
  for (const FeaturePoint& f : features.points) {
    const cv::Scalar colour = f.origin == "candidate" ? cv::Scalar(255, 40, 40) : cv::Scalar(255, 140, 0);
    cv::circle(canvas, to_point(f.pixel), 4 * unit * 16, colour, unit, cv::LINE_AA, 4);
    cv::putText(canvas, f.name, {static_cast<int>(f.pixel.x()) + 5 * unit, static_cast<int>(f.pixel.y()) - 3 * unit},
                cv::FONT_HERSHEY_SIMPLEX, 0.32 * unit, colour, unit, cv::LINE_AA);
  }
  return image;
}

Image draw_mesh(const PanelMesh& mesh, int height) {
  Vec2 low(1e9, 1e9), high(-1e9, -1e9);
  for (const Vec2& p : mesh.nodes) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double scale = (height - 40) / std::max(1e-6, high.y() - low.y());
  Image image(static_cast<int>((high.x() - low.x()) * scale) + 40, height, 3, 255);
  cv::Mat canvas = as_mat(image);
  const auto place = [&](const Vec2& p) {
    return to_point(Vec2(20 + (p.x() - low.x()) * scale, 20 + (high.y() - p.y()) * scale));
  };
  for (const Triangle& t : mesh.triangles) {
    const cv::Point corners[] = {place(mesh.nodes[t[0]]), place(mesh.nodes[t[1]]), place(mesh.nodes[t[2]])};
    const cv::Point* contour = corners;
    const int count = 3;
    cv::polylines(canvas, &contour, &count, 1, true, {60, 80, 120}, 1, cv::LINE_AA, 4);
  }
  return image;
}

}  // namespace vitrine
