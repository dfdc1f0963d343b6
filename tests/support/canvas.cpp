// SPDX-License-Identifier: GPL-3.0-or-later
#include <opencv2/imgproc.hpp>

#include "photo_parts.hpp"

namespace vitrine::support {

cv::Mat1f coverage(const Curve& closed, const Canvas& canvas) {
  constexpr int fine = 4;   // sub-pixels a side
  constexpr int shift = 4;  // fractional bits of fillPoly's coordinates
  cv::Mat1b mask(canvas.height * fine, canvas.width * fine, static_cast<std::uint8_t>(0));
  std::vector<cv::Point> points;
  for (const Vec2& p : closed) {
    // Pixel centres are whole numbers: the sub-pixel grid starts half a pixel further out.
    const Vec2 q = ((canvas.px(p) + Vec2(0.5, 0.5)) * fine - Vec2(0.5, 0.5)) * (1 << shift);
    points.emplace_back(static_cast<int>(std::lround(q.x())), static_cast<int>(std::lround(q.y())));
  }
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{points}, cv::Scalar(255), cv::LINE_8, shift);
  cv::Mat small, share;
  cv::resize(mask, small, {canvas.width, canvas.height}, 0, 0, cv::INTER_AREA);
  small.convertTo(share, CV_32F, 1.0 / 255);
  return share;
}

void paint_near(const Curve& curve, double reach, const Canvas& canvas,
                const std::function<void(int, int, double, double, bool)>& paint) {
  if (curve.size() < 2) return;
  std::vector<Vec2> q;
  Vec2 low(1e9, 1e9), high(-1e9, -1e9);
  for (const Vec2& p : curve) {
    q.push_back(canvas.px(p));
    low = low.cwiseMin(q.back());
    high = high.cwiseMax(q.back());
  }
  const double r = reach * canvas.scale;
  const int x0 = std::max(0, static_cast<int>(low.x() - r)),
            x1 = std::min(canvas.width - 1, static_cast<int>(high.x() + r) + 1);
  const int y0 = std::max(0, static_cast<int>(low.y() - r)),
            y1 = std::min(canvas.height - 1, static_cast<int>(high.y() + r) + 1);
  if (x1 < x0 || y1 < y0) return;
  struct Near {
    float distance, along;
    bool left;
  };
  const int w = x1 - x0 + 1;
  std::vector<Near> nearest(static_cast<std::size_t>(w) * (y1 - y0 + 1),
                            Near{std::numeric_limits<float>::max(), 0, false});
  double run = 0;
  for (std::size_t i = 0; i + 1 < q.size(); ++i) {
    const Vec2 a = q[i], d = q[i + 1] - a;
    const double length2 = d.squaredNorm();
    if (length2 <= 0) continue;
    const double length = std::sqrt(length2);
    const int sx0 = std::max(x0, static_cast<int>(std::min(a.x(), q[i + 1].x()) - r));
    const int sx1 = std::min(x1, static_cast<int>(std::max(a.x(), q[i + 1].x()) + r) + 1);
    const int sy0 = std::max(y0, static_cast<int>(std::min(a.y(), q[i + 1].y()) - r));
    const int sy1 = std::min(y1, static_cast<int>(std::max(a.y(), q[i + 1].y()) + r) + 1);
    for (int y = sy0; y <= sy1; ++y)
      for (int x = sx0; x <= sx1; ++x) {
        const Vec2 v = Vec2(x, y) - a;
        const double t = std::clamp(v.dot(d) / length2, 0.0, 1.0);
        const auto distance = static_cast<float>((v - t * d).norm());
        Near& n = nearest[static_cast<std::size_t>(y - y0) * w + (x - x0)];
        if (distance < n.distance)
          n = {distance, static_cast<float>(run + t * length), d.x() * v.y() - d.y() * v.x() < 0};
      }
    run += length;
  }
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const Near& n = nearest[static_cast<std::size_t>(y - y0) * w + (x - x0)];
      if (n.distance <= r) paint(x, y, n.distance / canvas.scale, n.along / canvas.scale, n.left);
    }
}

cv::Vec3f linear(const Rgb& srgb) {
  cv::Vec3f v;
  for (int c = 0; c < 3; ++c) v[c] = static_cast<float>(std::pow(srgb[c] / 255, 2.2));
  return v;
}

}  // namespace vitrine::support
