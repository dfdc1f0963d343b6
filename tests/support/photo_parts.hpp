// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <functional>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "photo_maker.hpp"

// The steps of make_photo, private to this folder: shape -> relief -> colour -> details -> light.
namespace vitrine::support {

using Curve = std::vector<Vec2>;

/// The garment as it lies, in centimetres. Arrays: 0 = left of the picture, 1 = right. Curves run left to right, or
/// from the middle of the garment outwards, or from top to bottom.
struct Shape {
  Curve silhouette;           ///< closed: the whole garment
  Curve face;                 ///< closed: what is seen of it from outside
  Curve top_front, top_back;  ///< neckline or waist of the two sides of the garment
  Curve hem;
  std::array<Curve, 2> shoulder, armhole, sleeve, cuff;  ///< sleeve: closed
  std::map<std::string, Vec2> landmarks;
};
Shape make_shape(const PhotoSpec& spec);

/// Where an even piece of cloth would lie before it was laid down a little crookedly.
Vec2 warp(const Vec2& p, const PhotoSpec& spec);

/// Height in [-1, 1] of the hanging folds of a wide skirt. `at_hem`: where the thread through this point meets the hem
/// [cm from the middle]; `down`: 0 at the waistband, 1 at the hem.
double hanging_fold(double at_hem, double y, double down, const PhotoSpec& spec);

/// Places the garment in the picture.
struct Canvas {
  int width = 0, height = 0;
  double scale = 1;  ///< [px/cm]
  double cosine = 1, sine = 0;
  Vec2 middle_cm = Vec2::Zero(), middle_px = Vec2::Zero();
  Vec2 px(const Vec2& cm) const {
    const Vec2 d = scale * (cm - middle_cm);
    return middle_px + Vec2(cosine * d.x() - sine * d.y(), sine * d.x() + cosine * d.y());
  }
  Vec2 cm(const Vec2& px) const {
    const Vec2 d = (px - middle_px) / scale;
    return middle_cm + Vec2(cosine * d.x() + sine * d.y(), -sine * d.x() + cosine * d.y());
  }
};

/// Share of each pixel that a closed curve [cm] covers.
cv::Mat1f coverage(const Curve& closed, const Canvas& canvas);

/// Calls `paint(x, y, distance, along, left)` for each pixel within `reach` of the curve: nearest distance and position
/// along the curve in centimetres; left: seen along the curve, the pixel is on its left.
void paint_near(const Curve& curve, double reach, const Canvas& canvas,
                const std::function<void(int, int, double, double, bool)>& paint);

struct Layers {
  cv::Mat1f total, face;  ///< coverage of the silhouette and of its outside
  cv::Mat1f relief;       ///< [cm] height of the cloth
  cv::Mat3f colour;       ///< linear RGB
  cv::Mat1b part;         ///< 0 body, 1 left sleeve, 2 right sleeve
};

cv::Vec3f linear(const Rgb& srgb);
/// Mixes a colour into a pixel.
inline void mix(cv::Vec3f& pixel, const cv::Vec3f& colour, double share) {
  pixel += static_cast<float>(share) * (colour - pixel);
}

void add_relief(const PhotoSpec& spec, const Shape& shape, const Canvas& canvas, Layers& layers);
void add_fabric(const PhotoSpec& spec, const Shape& shape, const Canvas& canvas, Layers& layers);
void add_motif(const PhotoSpec& spec, const Canvas& canvas, Layers& layers);
void add_top_details(const PhotoSpec& spec, const Shape& shape, const Canvas& canvas, Layers& layers);
void add_skirt_details(const PhotoSpec& spec, const Shape& shape, const Canvas& canvas, Layers& layers);
/// Two rows of dashes `gap` apart, the first `inset` from the curve, with the groove they pull into the cloth.
void add_stitches(const Curve& curve, double inset, int rows, double gap, const cv::Vec3f& thread, const Canvas& canvas,
                  Layers& layers);
/// A seam: a fine dark line in a groove.
void add_seam(const Curve& curve, double inset, const Canvas& canvas, Layers& layers);

}  // namespace vitrine::support
