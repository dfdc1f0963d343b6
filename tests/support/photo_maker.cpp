// SPDX-License-Identifier: GPL-3.0-or-later
#include "photo_maker.hpp"

#include <numbers>
#include <opencv2/imgproc.hpp>

#include "noise.hpp"
#include "photo_parts.hpp"

namespace vitrine::support {
namespace {

const Vec3 light = Vec3(-0.46, -0.60, 0.78).normalized();  // from the upper left, as in most product photos

Canvas place(const PhotoSpec& spec, const Shape& shape) {
  Canvas canvas;
  canvas.width = spec.width;
  canvas.height = spec.height;
  canvas.cosine = std::cos(spec.tilt * std::numbers::pi / 180);
  canvas.sine = std::sin(spec.tilt * std::numbers::pi / 180);
  Vec2 low(1e9, 1e9), high(-1e9, -1e9);
  for (const Vec2& p : shape.silhouette) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  canvas.middle_cm = (low + high) / 2;
  canvas.middle_px = Vec2(spec.width - 1, spec.height - 1) / 2;
  canvas.scale = spec.fill * std::min(spec.width / (high.x() - low.x()), spec.height / (high.y() - low.y()));
  return canvas;
}

cv::Mat1f blurred(const cv::Mat1f& image, double sigma) {
  // A wide blur is made on a reduced copy: the same to the eye, far quicker.
  const int down = sigma > 8 ? static_cast<int>(sigma / 4) : 1;
  cv::Mat small, out;
  cv::resize(image, small, {std::max(1, image.cols / down), std::max(1, image.rows / down)}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(small, small, {0, 0}, sigma / down, sigma / down, cv::BORDER_REPLICATE);
  cv::resize(small, out, image.size(), 0, 0, cv::INTER_LINEAR);
  return out;
}

/// Lambert's law over the relief, relative to flat cloth; hollows get less of the room's light.
cv::Mat1f lighting(const Layers& layers, const Canvas& canvas) {
  const cv::Mat1f around = blurred(layers.relief, 0.8 * canvas.scale);
  cv::Mat1f shade(canvas.height, canvas.width, 1.0f);
  for (int y = 1; y + 1 < canvas.height; ++y)
    for (int x = 1; x + 1 < canvas.width; ++x) {
      if (layers.total(y, x) <= 0) continue;
      const double hx = 0.5 * canvas.scale * (layers.relief(y, x + 1) - layers.relief(y, x - 1));
      const double hy = 0.5 * canvas.scale * (layers.relief(y + 1, x) - layers.relief(y - 1, x));
      const double direct = std::max(0.0, Vec3(-hx, -hy, 1).normalized().dot(light)) / light.z();
      const double hollow = std::clamp(1 + 1.1 * (layers.relief(y, x) - around(y, x)), 0.55, 1.12);
      shade(y, x) = static_cast<float>((0.15 + 0.85 * direct) * hollow);
    }
  return shade;
}

/// The inside of the back above the front neckline: darker cloth, the neck tape, the maker's label.
cv::Mat3f inside_of_back(const PhotoSpec& spec, const Shape& shape, const Canvas& canvas, const Layers& layers) {
  cv::Mat3f inside(canvas.height, canvas.width, linear(spec.colour) * 0.55f);
  if (spec.side == Side::back) return inside;
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x)
      if (layers.total(y, x) > 0 && layers.face(y, x) < 1) inside(y, x) = layers.colour(y, x) * 0.52f;
  const cv::Vec3f tape = linear(spec.trim) * 0.58f;
  const bool hangs = has_waist(spec.garment);
  const double wide = hangs ? spec.waistband : 1.3;
  paint_near(shape.top_back, wide + 0.3, canvas, [&](int x, int y, double d, double along, bool) {
    const double on = 1 - smooth_step(wide - 0.05, wide + 0.05, d);
    mix(inside(y, x), tape * static_cast<float>(1 + 0.08 * std::cos(15 * along)), on);
    const double groove = (d - wide) / 0.1;
    inside(y, x) *= static_cast<float>(1 - 0.35 * std::exp(-groove * groove));
  });
  if (hangs || spec.neck_depth < spec.back_neck_depth + 4.5) return inside;
  const Vec2 centre(0, spec.back_neck_depth + 1.7);
  const cv::Vec3f paper = linear({228, 222, 208}), ink = linear({70, 66, 62});
  const double soft = 0.6 / canvas.scale;
  const Vec2 p0 = canvas.px(warp(centre, spec));
  const int r = static_cast<int>(4 * canvas.scale);
  for (int y = std::max(0, static_cast<int>(p0.y()) - r); y < std::min(canvas.height, static_cast<int>(p0.y()) + r);
       ++y)
    for (int x = std::max(0, static_cast<int>(p0.x()) - r); x < std::min(canvas.width, static_cast<int>(p0.x()) + r);
         ++x) {
      const Vec2 q = canvas.cm(Vec2(x, y)) - warp(centre, spec);
      const auto box = [&](double cx, double cy, double hx, double hy) {
        return (1 - smooth_step(hx - soft, hx + soft, std::abs(q.x() - cx))) *
               (1 - smooth_step(hy - soft, hy + soft, std::abs(q.y() - cy)));
      };
      inside(y, x) *= static_cast<float>(1 - 0.35 * box(0.15, 0.2, 2.0, 1.05));  // its shadow
      mix(inside(y, x), paper, box(0, 0, 1.9, 0.95));
      // A row of letters, too small to read.
      const double letter = std::fmod(std::abs(q.x()) + 0.07, 0.34) < 0.22 ? 1.0 : 0.0;
      mix(inside(y, x), ink, 0.75 * letter * box(0, -0.15, 1.1, 0.2));
      mix(inside(y, x), ink, 0.5 * box(0, 0.45, 0.6, 0.06));
    }
  return inside;
}

struct Board {
  cv::Mat3f colour;
  cv::Mat1f lit;  ///< share of the lamp that arrives, for board and garment alike
};

Board make_board(const PhotoSpec& spec, const Canvas& canvas, const Layers& layers) {
  Board board{cv::Mat3f(canvas.height, canvas.width), cv::Mat1f(canvas.height, canvas.width)};
  const cv::Vec3f base = linear(spec.board);
  const auto shifted = [&](double sigma, double by) {
    const cv::Mat1f soft = blurred(layers.total, sigma * canvas.scale);
    cv::Mat out;
    const double d = by * canvas.scale;
    const cv::Matx23d move(1, 0, 0.7 * d, 0, 1, d);
    cv::warpAffine(soft, out, move, soft.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    return cv::Mat1f(out);
  };
  const cv::Mat1f tight = shifted(0.22, 0.22), wide = shifted(1.3, 0.9), room = shifted(4.5, 1.0);
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x) {
      const double u = static_cast<double>(x) / canvas.width - 0.5, v = static_cast<double>(y) / canvas.height - 0.5;
      // Light fades away from the lamp, and towards the corners through the lens.
      const double lit = 1 - spec.falloff * (0.55 + 0.75 * (0.6 * u + 0.8 * v) + 0.9 * (u * u + v * v) - 0.25);
      const double paper = spec.grain * (0.012 * fractal_noise(x / 2.6, y / 2.6, 2, spec.seed + 900) +
                                         0.012 * noise(x / 60.0, y / 45.0, spec.seed + 901));
      const double shadow = 1 - spec.shadow * (0.42 * tight(y, x) + 0.26 * wide(y, x) + 0.16 * room(y, x));
      board.lit(y, x) = static_cast<float>(lit);
      board.colour(y, x) = base * static_cast<float>((1 + paper) * std::max(0.05, shadow));
    }
  return board;
}

}  // namespace

MadePhoto make_photo(const PhotoSpec& spec) {
  const Shape shape = make_shape(spec);
  const Canvas canvas = place(spec, shape);
  Layers layers;
  layers.total = coverage(shape.silhouette, canvas);
  layers.face = cv::Mat1f(canvas.height, canvas.width);
  cv::min(static_cast<const cv::Mat&>(coverage(shape.face, canvas)), static_cast<const cv::Mat&>(layers.total),
          static_cast<cv::Mat&>(layers.face));
  add_relief(spec, shape, canvas, layers);
  add_fabric(spec, shape, canvas, layers);
  if (spec.motif) add_motif(spec, canvas, layers);
  if (has_waist(spec.garment))
    add_skirt_details(spec, shape, canvas, layers);
  else
    add_top_details(spec, shape, canvas, layers);
  const cv::Mat1f shade = lighting(layers, canvas);
  const cv::Mat3f inside = inside_of_back(spec, shape, canvas, layers);
  // The front's neckline stands off the inside of the back and throws a shadow on it.
  const cv::Mat1f lip = blurred(layers.face, 0.5 * canvas.scale);
  const Board board = make_board(spec, canvas, layers);

  MadePhoto made;
  made.pixels_per_cm = canvas.scale;
  made.rgb = Image(spec.width, spec.height, 3);
  made.labels = Image(spec.width, spec.height, 1, label_background);
  for (int y = 0; y < spec.height; ++y)
    for (int x = 0; x < spec.width; ++x) {
      cv::Vec3f pixel = board.colour(y, x);
      const float total = layers.total(y, x), face = layers.face(y, x);
      if (total > face) {
        const double dark = 1 - 0.5 * lip(y, x) + 0.04 * noise(x / 9.0, y / 9.0, spec.seed + 77);
        mix(pixel, inside(y, x) * static_cast<float>(dark), total);
      }
      mix(pixel, layers.colour(y, x) * shade(y, x), face);
      if (total >= 0.5f) *made.labels.at(x, y) = face >= 0.5f ? label_outside : label_inside;
      for (int c = 0; c < 3; ++c) {
        double grey = 255 * std::pow(std::max(0.0, static_cast<double>(pixel[c] * board.lit(y, x))), 1 / 2.2);
        // Sum of four uniform numbers: near enough to the bell curve, and the same with every library.
        double bell = -2;
        for (std::uint32_t k = 0; k < 4; ++k)
          bell += hash_unit(x, y, spec.seed * 59 + (spec.side == Side::back ? 29 : 0) + 4 * c + k);
        grey += spec.noise * 1.732 * bell;
        made.rgb.at(x, y)[c] = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
      }
    }
  for (const auto& [name, p] : shape.landmarks) made.landmarks[name] = canvas.px(p);
  return made;
}

PhotoSpec back_of(PhotoSpec front) {
  front.side = Side::back;
  front.tilt = -0.6 * front.tilt;
  return front;
}

}  // namespace vitrine::support
