// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw.hpp"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "vitrine/pipeline.hpp"

namespace vitrine {
namespace {

cv::Mat as_mat(Image& image) {
  return cv::Mat(image.height, image.width, CV_8UC(image.channels), image.data.data());
}

}  // namespace

Image draw_mesh(const PanelMesh& mesh, int height) {
  Vec2 low(1e9, 1e9), high(-1e9, -1e9);
  for (const Vec2& p : mesh.nodes) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double scale = (height - 40) / std::max(1e-6, high.y() - low.y());
  Image image(static_cast<int>((high.x() - low.x()) * scale) + 40, height, 3, 255);
  cv::Mat canvas = as_mat(image);
  const auto place = [&](const Vec2& p) {
    return fixed(Vec2(20 + (p.x() - low.x()) * scale, 20 + (high.y() - p.y()) * scale));
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
