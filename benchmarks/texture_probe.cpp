// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture_probe.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "vitrine/colour.hpp"

namespace vitrine::bench {
namespace {

using Lab = std::array<float, 3>;

Vec3 sample(const Image& image, const Vec2& uv) {
  const double x = std::clamp(uv.x() * image.width - 0.5, 0.0, image.width - 1.0);
  const double y = std::clamp(uv.y() * image.height - 0.5, 0.0, image.height - 1.0);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, image.width - 1), y1 = std::min(y0 + 1, image.height - 1);
  Vec3 out;
  for (int c = 0; c < 3; ++c) {
    const double a = image.at(x0, y0)[c] + (x - x0) * (image.at(x1, y0)[c] - image.at(x0, y0)[c]);
    const double b = image.at(x0, y1)[c] + (x - x0) * (image.at(x1, y1)[c] - image.at(x0, y1)[c]);
    out[c] = a + (y - y0) * (b - a);
  }
  return out;
}

Lab lab_of(const Vec3& rgb) {
  std::uint8_t bytes[3];
  for (int c = 0; c < 3; ++c) bytes[c] = static_cast<std::uint8_t>(std::lround(std::clamp(rgb[c], 0.0, 255.0)));
  Lab lab;
  lab_from_srgb(bytes, lab.data(), 1);
  return lab;
}

double difference(const Lab& a, const Lab& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

cv::Mat distance_inside(const Image& labels, std::uint8_t label) {
  cv::Mat mask(labels.height, labels.width, CV_8U);
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) mask.at<uchar>(y, x) = *labels.at(x, y) == label ? 255 : 0;
  cv::Mat distance;
  cv::distanceTransform(mask, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance;
}

/// Colours that at least a thousandth of the pixels have, where `distance` is beyond `clear`.
std::vector<Lab> palette(const Image& rgb, const cv::Mat& distance, double clear) {
  std::vector<int> count(32 * 32 * 32, 0);
  std::vector<Vec3> sum(count.size(), Vec3::Zero());
  int all = 0;
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x) {
      if (distance.at<float>(y, x) <= clear) continue;
      const std::uint8_t* p = rgb.at(x, y);
      const std::size_t cell = static_cast<std::size_t>(((p[0] >> 3) * 32 + (p[1] >> 3)) * 32 + (p[2] >> 3));
      ++count[cell];
      sum[cell] += Vec3(p[0], p[1], p[2]);
      ++all;
    }
  std::vector<Lab> colours;
  for (std::size_t i = 0; i < count.size(); ++i)
    if (count[i] > 0 && count[i] * 1000 >= all) colours.push_back(lab_of(sum[i] / count[i]));
  return colours;
}

double nearest(const std::vector<Lab>& colours, const Lab& c) {
  double best = 1e9;
  for (const Lab& other : colours) best = std::min(best, difference(other, c));
  return best;
}

double brightened(double v, double gain) {
  const double c = v / 255.0;
  const double light = gain * (c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  return std::min(255.0, 255.0 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055));
}

}  // namespace

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

Fidelity measure_fidelity(const TextureSource& source, const std::vector<Vec2>& uv, const Image& atlas, double rim,
                          const std::array<double, 3>& gain) {
  const Image& photo = *source.rgb;
  const cv::Mat depth = distance_inside(*source.labels, label_outside);
  std::vector<char> done(static_cast<std::size_t>(photo.width) * photo.height, 0);
  double all = 0, clear = 0;
  std::size_t pixels = 0, clear_pixels = 0;
  for (const Triangle& t : source.mesh->triangles) {
    std::array<Vec2, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = source.panel->pixel_from_panel(source.mesh->nodes[t[k]]);
    const Vec2 a = p[1] - p[0], b = p[2] - p[0];
    const double det = a.x() * b.y() - a.y() * b.x();
    if (std::abs(det) < 1e-12) continue;
    const Vec2 low = p[0].cwiseMin(p[1]).cwiseMin(p[2]), high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
    for (int y = std::max(0, static_cast<int>(std::ceil(low.y()))); y <= std::min<double>(photo.height - 1, high.y());
         ++y)
      for (int x = std::max(0, static_cast<int>(std::ceil(low.x()))); x <= std::min<double>(photo.width - 1, high.x());
           ++x) {
        const Vec2 q = Vec2(x, y) - p[0];
        const double w1 = (q.x() * b.y() - q.y() * b.x()) / det, w2 = (a.x() * q.y() - a.y() * q.x()) / det;
        if (w1 < 0 || w2 < 0 || w1 + w2 > 1) continue;
        char& seen = done[static_cast<std::size_t>(y) * photo.width + x];
        if (seen || *source.labels->at(x, y) != label_outside) continue;
        seen = 1;
        const Vec3 shown = sample(atlas, (1 - w1 - w2) * uv[t[0]] + w1 * uv[t[1]] + w2 * uv[t[2]]);
        double squares = 0;
        for (int c = 0; c < 3; ++c) {
          const double d = shown[c] - brightened(photo.at(x, y)[c], gain[c]);
          squares += d * d / 3;
        }
        all += squares;
        ++pixels;
        if (depth.at<float>(y, x) <= rim) continue;
        clear += squares;
        ++clear_pixels;
      }
  }
  const auto psnr = [](double squares, std::size_t n) {
    return n ? 10 * std::log10(255.0 * 255.0 / std::max(1e-9, squares / static_cast<double>(n))) : 0.0;
  };
  Fidelity f{psnr(clear, clear_pixels), psnr(all, pixels), 0};
  if (pixels) f.rim_share = 1.0 - static_cast<double>(clear_pixels) / static_cast<double>(pixels);
  return f;
}

BoardTexels count_board(const TextureSource& source, const std::vector<Vec2>& uv, const Image& atlas) {
  const std::vector<Lab> garment = palette(*source.rgb, distance_inside(*source.labels, label_outside), 8);
  const std::vector<Lab> board = palette(*source.rgb, distance_inside(*source.labels, label_background), 8);
  cv::Mat away(atlas.height, atlas.width, CV_8U, cv::Scalar(255));
  const std::size_t n = source.panel->outline.size();
  constexpr int shift = 4;
  const auto place = [&](std::size_t i) {
    const Vec2 p = uv[i].cwiseProduct(Vec2(atlas.width, atlas.height)) - Vec2(0.5, 0.5);
    return cv::Point(static_cast<int>(std::lround(p.x() * (1 << shift))),
                     static_cast<int>(std::lround(p.y() * (1 << shift))));
  };
  for (std::size_t i = 0; i < n; ++i) cv::line(away, place(i), place((i + 1) % n), cv::Scalar(0), 1, cv::LINE_8, shift);
  cv::Mat distance;
  cv::distanceTransform(away, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  BoardTexels count;
  for (int y = 0; y < atlas.height; ++y)
    for (int x = 0; x < atlas.width; ++x) {
      if (distance.at<float>(y, x) > 3) continue;
      ++count.near;
      const std::uint8_t* p = atlas.at(x, y);
      const Lab own = lab_of(Vec3(p[0], p[1], p[2]));
      const double lead = nearest(garment, own) - nearest(board, own);
      if (lead <= 0) continue;
      ++count.wrong;
      count.worst = std::max(count.worst, lead);
    }
  return count;
}

SeamSteps seam_steps(const TextureCase& c, const std::vector<std::vector<Vec2>>& uv, const Image& atlas) {
  constexpr double half = 0.004, inset = 0.006;  // [m] patches of 8 mm, 2 mm from the seam
  const auto source_density = [](const Eigen::Matrix2d& in_uv, const Eigen::Matrix2d& flat, const Image& picture) {
    const double texels = std::abs(in_uv.determinant()) * picture.width * picture.height;
    return std::sqrt(texels / std::abs(flat.determinant()));
  };
  const auto colour = [&](int panel, int node) {
    const Panel& flat = c.item.pattern.panels[panel];
    const int n = static_cast<int>(flat.outline.size());
    const Vec2 along = flat.outline[(node + 1) % n] - flat.outline[(node + n - 1) % n];
    const Vec2 inward = Vec2(-along.y(), along.x()).normalized();
    // Both panels map by a similarity: its linear part from three nodes of the mesh.
    const Triangle& t = c.item.pattern.meshes[panel].triangles[0];
    const auto& nodes = c.item.pattern.meshes[panel].nodes;
    Eigen::Matrix2d flat_axes, uv_axes;
    flat_axes << nodes[t[1]] - nodes[t[0]], nodes[t[2]] - nodes[t[0]];
    uv_axes << uv[panel][t[1]] - uv[panel][t[0]], uv[panel][t[2]] - uv[panel][t[0]];
    const Vec2 at = uv[panel][node] + uv_axes * flat_axes.inverse() * (inset * inward);
    const int reach = std::max(1, static_cast<int>(std::lround(half * source_density(uv_axes, flat_axes, atlas))));
    Vec3 mean = Vec3::Zero();
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx)
        mean += sample(atlas, at + Vec2(1.0 * dx / atlas.width, 1.0 * dy / atlas.height));
    return lab_of(mean / ((2.0 * reach + 1) * (2.0 * reach + 1)));
  };
  SeamSteps steps;
  std::map<int, std::array<std::array<std::vector<double>, 3>, 2>> sides;
  for (const NodePair& pair : c.item.pattern.pairs) {
    if (pair.panel_a == pair.panel_b) continue;
    const Lab a = colour(pair.panel_a, pair.node_a), b = colour(pair.panel_b, pair.node_b);
    steps.points.push_back(difference(a, b));
    for (int k = 0; k < 3; ++k) {
      sides[pair.seam][pair.panel_a][k].push_back(a[k]);
      sides[pair.seam][pair.panel_b][k].push_back(b[k]);
    }
  }
  for (const auto& [seam, side] : sides) {
    Lab middle[2];
    for (int p : {0, 1})
      for (int k = 0; k < 3; ++k) middle[p][k] = static_cast<float>(median_of(side[p][k]));
    steps.seams.push_back(difference(middle[0], middle[1]));
  }
  return steps;
}

}  // namespace vitrine::bench
