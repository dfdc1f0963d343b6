// SPDX-License-Identifier: GPL-3.0-or-later
// A template laid over a photo, for its author: where it looked, beside what was found.
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "as_given.hpp"
#include "draw.hpp"

namespace vitrine {
namespace {

struct Box {
  Vec2 low{1e9, 1e9}, high{-1e9, -1e9};
};

Box box_of(const Image& labels) {
  Box box;
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x)
      if (*labels.at(x, y) != label_background) {
        box.low = box.low.cwiseMin(Vec2(x, y));
        box.high = box.high.cwiseMax(Vec2(x, y));
      }
  return box;
}

}  // namespace

Image draw_template(const ViewRequest& request, const View& view) {
  Image picture = draw_view(request, view);
  const auto& poses = request.garment.poses;
  if (picture.empty() || poses.empty()) return picture;
  const auto chosen =
      std::find_if(poses.begin(), poses.end(), [&](const TemplatePose& p) { return p.name == view.features.pose; });
  const TemplatePose& pose = chosen == poses.end() ? poses.front() : *chosen;
  const Box box = box_of(labels_of(view));
  if (box.high.x() < box.low.x()) return picture;
  // draw_view() enlarges small photos and adds lines of text below; its width tells by how much.
  const double scale = static_cast<double>(picture.width) / view.photo.source_width;
  const auto place = [&](const Vec2& uv) {
    const Vec2 p = pixel_as_given(view.photo, box.low + uv.cwiseProduct(box.high - box.low));
    return Vec2(scale * (p + Vec2(0.5, 0.5)) - Vec2(0.5, 0.5));
  };
  cv::Mat canvas(picture.height, picture.width, CV_8UC3, picture.data.data());
  const double unit = std::max(1.0, picture.width / 900.0);
  const int thin = static_cast<int>(std::lround(unit));
  const cv::Scalar amber(255, 176, 32), dark(20, 20, 24);
  const double to_picture = (place(Vec2(1, 1)) - place(Vec2(0, 0))).norm();  // of the box's diagonal
  for (const cv::Scalar& ink : {dark, amber}) {
    const int width = ink == dark ? 3 * thin : thin;
    for (const TemplateEdge& edge : request.garment.edges)
      cv::line(canvas, fixed(place(pose.uv[edge.from])), fixed(place(pose.uv[edge.to])), ink, width, cv::LINE_AA, 4);
    for (std::size_t i = 0; i < pose.uv.size(); ++i) {
      const cv::Point at = fixed(place(pose.uv[i]));
      cv::circle(canvas, at, static_cast<int>(std::lround(pose.radius[i] * to_picture * 16)), ink, width, cv::LINE_AA,
                 4);
      for (const auto& [dx, dy] : {std::pair{1, 1}, std::pair{1, -1}}) {
        const cv::Point arm(static_cast<int>(96 * unit) * dx, static_cast<int>(96 * unit) * dy);
        cv::line(canvas, at - arm, at + arm, ink, width, cv::LINE_AA, 4);
      }
    }
  }
  return picture;
}

}  // namespace vitrine
