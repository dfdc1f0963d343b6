// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vitrine/rays.hpp"
#include "vitrine/sampling.hpp"
#include "vitrine/texture.hpp"

namespace vitrine {
namespace {

constexpr double kLift = 6e-4;  // [m] off the surface; the cloth lies 4 mm off the body

/// How often the texture can be halved until a texel spans `wanted` metres of cloth; neither side below 16.
int halvings(const RenderMesh& mesh, double wanted) {
  double surface = 0, share = 0;  // [m^2] and of the texture
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[1]] - mesh.positions[t[0]], b = mesh.positions[t[2]] - mesh.positions[t[0]];
    const Vec2 c = mesh.uv[t[1]] - mesh.uv[t[0]], d = mesh.uv[t[2]] - mesh.uv[t[0]];
    surface += a.cross(b).norm();
    share += std::abs(c.x() * d.y() - c.y() * d.x());
  }
  const double texels = share * mesh.texture.width * mesh.texture.height;
  if (!(texels > 0)) return 0;
  int n = 0;
  for (double span = 2 * std::sqrt(surface / texels);
       span <= wanted && (std::min(mesh.texture.width, mesh.texture.height) >> (n + 1)) >= 16; span *= 2)
    ++n;
  return n;
}

/// Calls `visit(x, y, weights)` for each texel whose centre lies in the triangle or within half a texel of it.
template <class F>
void each_texel(const std::array<Vec2, 3>& corner, int width, int height, F&& visit) {
  const Vec2 a = corner[1] - corner[0], b = corner[2] - corner[0];
  const double det = a.x() * b.y() - a.y() * b.x();
  if (std::abs(det) < 1e-12) return;
  const auto bound = [&](int axis, bool upper) {
    const double v = upper ? std::max({corner[0][axis], corner[1][axis], corner[2][axis]}) + 0.5
                           : std::min({corner[0][axis], corner[1][axis], corner[2][axis]}) - 0.5;
    return static_cast<int>(std::floor(v));
  };
  for (int y = std::max(0, bound(1, false)); y <= std::min(height - 1, bound(1, true)); ++y)
    for (int x = std::max(0, bound(0, false)); x <= std::min(width - 1, bound(0, true)); ++x) {
      const Vec2 p = Vec2(x + 0.5, y + 0.5) - corner[0];
      std::array<double, 3> w{0, (p.x() * b.y() - p.y() * b.x()) / det, (a.x() * p.y() - a.y() * p.x()) / det};
      w[0] = 1.0 - w[1] - w[2];
      if (std::min({w[0], w[1], w[2]}) < -1e-9) {
        // A centre just outside belongs to the nearest point of the triangle: the border of a panel runs through
        // texels.
        for (double& v : w) v = std::clamp(v, 0.0, 1.0);
        const double sum = w[0] + w[1] + w[2];
        for (double& v : w) v /= sum;
        const Vec2 q = w[0] * corner[0] + w[1] * corner[1] + w[2] * corner[2];
        if ((q - Vec2(x + 0.5, y + 0.5)).cwiseAbs().maxCoeff() > 0.75) continue;
        visit(x, y, w, false);
      } else {
        visit(x, y, w, true);
      }
    }
}

/// One value for each vertex; two averages over neighbours take the rays' noise.
std::vector<float> vertex_openness(const Sky& sky, const RenderMesh& mesh) {
  std::vector<float> open(mesh.positions.size());
  for (std::size_t v = 0; v < open.size(); ++v)
    open[v] = static_cast<float>(sky.open(mesh.positions[v] + kLift * mesh.normals[v], mesh.normals[v],
                                          Sequence(static_cast<std::uint32_t>(v), 0, 12)));
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<float> sum(open.size(), 0.0F), count(open.size(), 0.0F);
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t)
        for (const std::uint32_t w : t) {
          sum[v] += open[w];
          count[v] += 1.0F;
        }
    for (std::size_t v = 0; v < open.size(); ++v)
      if (count[v] > 0) open[v] = sum[v] / count[v];
  }
  return open;
}

}  // namespace

std::optional<Error> bake_occlusion(RenderMesh& garment, RenderMesh& mannequin, const OcclusionOptions& options) {
  if (!(options.texel > 0 && options.texel <= 1) || options.rays < 1 || options.rays > 4096 ||
      !(options.reach > 0 && options.reach <= 10))
    return Error{Cause::usage, "BAD_OCCLUSION_OPTIONS", "The occlusion's texel, rays or reach are out of range.",
                 "Use a texel up to 1 m, 1 to 4096 rays and a reach up to 10 m.", "texture"};
  // Meshes that contradict themselves are empty here, and the writers refuse them by name.
  if (garment.positions.empty() || garment.texture.empty() || mannequin.positions.empty()) return std::nullopt;
  const RenderMesh both[] = {garment, mannequin};
  const auto tracer = Tracer::build(both);
  if (!tracer) return tracer.error();

  const Sky sky(*tracer, options.rays, options.reach);
  const int n = halvings(garment, options.texel);
  const int width = garment.texture.width >> n, height = garment.texture.height >> n;
  cv::Mat1f open(height, width, -1.0F);
  cv::Mat1b exact(height, width, uchar{0});
  for (const Triangle& t : garment.triangles) {
    std::array<Vec2, 3> corner;
    for (int i = 0; i < 3; ++i) corner[i] = garment.uv[t[i]].cwiseProduct(Vec2(width, height));
    const Vec3 &p0 = garment.positions[t[0]], &p1 = garment.positions[t[1]], &p2 = garment.positions[t[2]];
    Vec3 flat = (p1 - p0).cross(p2 - p0);
    if (!(flat.norm() > 0)) continue;
    flat.normalize();
    each_texel(corner, width, height, [&](int x, int y, const std::array<double, 3>& w, bool within) {
      if (exact(y, x) || (!within && open(y, x) >= 0)) return;
      exact(y, x) = within;
      const SurfacePoint at = surface_point(garment, t, w);
      open(y, x) = static_cast<float>(sky.open(at.start + kLift * flat, at.normal, Sequence(x, y, 11)));
    });
  }
  // A little smoothing over covered texels takes the rays' noise; then the gutter takes its neighbour's value.
  cv::Mat1f value(height, width, 0.0F), weight(height, width, 0.0F);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (open(y, x) >= 0) {
        value(y, x) = open(y, x);
        weight(y, x) = 1;
      }
  const cv::Mat1f covered = weight.clone();
  cv::GaussianBlur(value, value, {3, 3}, 0.8);
  cv::GaussianBlur(weight, weight, {3, 3}, 0.8);
  cv::Mat distance, labels;
  cv::distanceTransform(covered == 0, distance, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  std::vector<float> of_label(static_cast<std::size_t>(width) * height + 1, 1.0F);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (covered(y, x) > 0) of_label[labels.at<int>(y, x)] = value(y, x) / weight(y, x);
  garment.occlusion = Image(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      *garment.occlusion.at(x, y) = cv::saturate_cast<uchar>(255.0F * of_label[labels.at<int>(y, x)]);

  // Averages over a vertex' neighbours make up for the rays that it does without.
  mannequin.shade = vertex_openness(Sky(*tracer, (options.rays + 1) / 2, options.reach), mannequin);
  return std::nullopt;
}

}  // namespace vitrine
