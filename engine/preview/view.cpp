// SPDX-License-Identifier: GPL-3.0-or-later
#include "view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "lights.hpp"
#include "vitrine/sampling.hpp"

namespace vitrine {
namespace {

// Occlusion and soft shadows change slowly along a surface. What the mesh brings along of them is read; for the rest
// rays are shot from every second pixel of every second row, evened out over neighbours on the same surface, and read
// from there; what changes quickly, the lie of the cloth and its colour, is looked up for each ray.
constexpr int kStep = 2;              // [px] between lighting points
constexpr int kBlur = 2;              // lighting points to each side
constexpr int kFloorStep = 8;         // [px] between points of the floor's shadow
constexpr float kSamePlane = 0.012F;  // [m] off a point's tangent plane: another surface
constexpr float kSameFacing = 0.80F;  // cosine between normals: beyond, another fold

struct Seen {
  Vec3 point, normal, start;
  double u = 0, v = 0;
  double baked = -1;  // how open the outer face lies, where that was baked into the mesh; < 0 where not
  unsigned mesh = 0;
  bool inner = false;
};

/// Baked occlusion, as a viewer of the mesh reads it; -1 for a mesh without.
double baked_openness(const RenderMesh& mesh, const Triangle& t, const std::array<double, 3>& w, double u, double v) {
  if (mesh.shade.size() == mesh.positions.size() && !mesh.shade.empty())
    return w[0] * mesh.shade[t[0]] + w[1] * mesh.shade[t[1]] + w[2] * mesh.shade[t[2]];
  const Image& picture = mesh.occlusion;
  if (picture.empty() || picture.channels != 1 || mesh.uv.empty()) return -1;
  const double x = std::clamp(u * picture.width - 0.5, 0.0, picture.width - 1.0);
  const double y = std::clamp(v * picture.height - 0.5, 0.0, picture.height - 1.0);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, picture.width - 1), y1 = std::min(y0 + 1, picture.height - 1);
  const double a = *picture.at(x0, y0) + (x - x0) * (*picture.at(x1, y0) - *picture.at(x0, y0));
  const double b = *picture.at(x0, y1) + (x - x0) * (*picture.at(x1, y1) - *picture.at(x0, y1));
  return (a + (y - y0) * (b - a)) / 255.0;
}

/// A place where the light was looked at.
struct LightPoint {
  Eigen::Vector3f point, normal;
  Visibility seen;
  unsigned mesh = std::numeric_limits<unsigned>::max();  // none
  bool inner = false;
};

class View {
 public:
  View(std::span<const RenderMesh> meshes, std::span<const TextureLookup> textures, const Tracer& tracer,
       const Framing& framing, const Camera& camera, const PreviewOptions& options)
      : meshes_(meshes),
        textures_(textures),
        tracer_(tracer),
        framing_(framing),
        camera_(camera),
        options_(options),
        lights_(tracer, camera, options.occlusion_rays),
        eye_(camera.eye()),
        columns_((options.view_width + kStep - 1) / kStep),
        rows_((options.view_height + kStep - 1) / kStep) {
    for (const RenderMesh& mesh : meshes)
      for (const Vec3& p : mesh.positions)
        shadow_radius_ = std::max(shadow_radius_, std::hypot(p.x() - camera.pivot.x(), p.z() - camera.pivot.z()));
    shadow_radius_ += kFloorReach;
  }

  void draw(Image& picture, int left) {
    look_at_light();
    look_at_floor();
    std::optional<std::array<std::uint8_t, 4>> known;  // the bare backdrop, which is most of a picture
    const Sequence places(0, 0, 0);                    // the same places in every pixel keep edges even
    for (int y = 0; y < options_.view_height; ++y)
      for (int x = 0; x < options_.view_width; ++x) {
        Eigen::Vector4f sum = Eigen::Vector4f::Zero();  // premultiplied
        std::uint8_t* out = picture.at(left + x, y);
        const bool empty = empty_around(x, y);
        const bool plain = empty && floor_shadow(x + 0.5, y + 0.5) == 0.0F;
        if (plain && known) {
          std::copy(known->begin(), known->begin() + picture.channels, out);
          continue;
        }
        if (empty) {
          sum = static_cast<float>(options_.samples) * ground(x + 0.5, y + 0.5);
        } else if (smooth_around(x, y)) {
          const Vec2 at(x + 0.5, y + 0.5);
          sum = static_cast<float>(options_.samples) * look(at, trace(at.x(), at.y()), x, y);
        } else {
          for (int s = 0; s < options_.samples; s += 4) {
            std::array<Vec2, 4> at;
            std::array<Vec3, 4> directions;
            for (int k = 0; k < 4; ++k) {
              at[k] = Vec2(x, y) + places.point(s + k);
              directions[k] = camera_.direction(film(at[k].x(), at[k].y()));
            }
            const auto hits = tracer_.first_hits(eye_, directions);
            for (int k = 0; k < std::min(4, options_.samples - s); ++k)
              sum += look(at[k], seen(directions[k], hits[k]), x, y);
          }
        }
        sum /= static_cast<float>(options_.samples);
        const bool alpha = picture.channels == 4;
        const float cover = alpha ? sum[3] : 1.0F;
        for (int c = 0; c < 3; ++c) out[c] = cover > 1e-4F ? linear_to_srgb(sum[c] / cover) : std::uint8_t{0};
        if (alpha) out[3] = static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(cover, 0.0F, 1.0F)));
        if (plain) {
          known.emplace();
          std::copy(out, out + picture.channels, known->begin());
        }
      }
  }

 private:
  Vec2 film(double x, double y) const { return framing_.top_left + framing_.pixel * Vec2(x, -y); }

  std::optional<Seen> trace(double x, double y) const {
    const Vec3 direction = camera_.direction(film(x, y));
    return seen(direction, tracer_.first_hit(eye_, direction));
  }

  std::optional<Seen> seen(const Vec3& direction, const std::optional<Hit>& hit) const {
    if (!hit) return std::nullopt;
    const RenderMesh& mesh = meshes_[hit->mesh];
    const Triangle& t = mesh.triangles[hit->triangle];
    const Vec3& origin = mesh.positions[t[0]];
    Vec3 flat = (mesh.positions[t[1]] - origin).cross(mesh.positions[t[2]] - origin);
    if (!(flat.norm() > 0)) return std::nullopt;
    flat.normalize();
    Seen s;
    s.mesh = hit->mesh;
    s.inner = flat.dot(direction) > 0;
    const double side = s.inner ? -1.0 : 1.0;
    const std::array<double, 3> w{1.0 - hit->u - hit->v, hit->u, hit->v};
    const SurfacePoint at = surface_point(mesh, t, w, side);
    s.point = at.point;
    s.normal = at.normal;
    s.start = at.start + kLift * side * flat;
    if (!mesh.uv.empty())
      for (int i = 0; i < 3; ++i) {
        s.u += w[i] * mesh.uv[t[i]].x();
        s.v += w[i] * mesh.uv[t[i]].y();
      }
    if (!s.inner) s.baked = baked_openness(mesh, t, w, s.u, s.v);
    return s;
  }

  /// How far two places belong to one surface, 0 to 1.
  static float same_surface(const LightPoint& p, const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                            unsigned mesh, bool inner) {
    if (p.mesh != mesh || p.inner != inner) return 0.0F;
    const float facing = p.normal.dot(normal);
    if (facing < kSameFacing) return 0.0F;
    const float off = std::abs((p.point - point).dot(normal));
    return off > kSamePlane ? 0.0F : (1.0F - off / kSamePlane) * (facing - kSameFacing) / (1.0F - kSameFacing);
  }

  void look_at_light() {
    std::vector<LightPoint> raw(static_cast<std::size_t>(columns_) * rows_);
    for (int j = 0; j < rows_; ++j)
      for (int first = 0; first < columns_; first += 4) {
        std::array<Vec3, 4> directions;
        for (int k = 0; k < 4; ++k)
          directions[k] = camera_.direction(film((first + k + 0.5) * kStep, (j + 0.5) * kStep));
        const auto hits = tracer_.first_hits(eye_, directions);
        for (int k = 0, i = first; k < std::min(4, columns_ - first); ++k, ++i)
          if (const auto s = seen(directions[k], hits[k]))
            raw[static_cast<std::size_t>(j) * columns_ + i] = {s->point.cast<float>(), s->normal.cast<float>(),
                                                               lights_.see(s->start, s->normal, s->baked, i, j),
                                                               s->mesh, s->inner};
      }
    points_ = raw;
    for (int j = 0; j < rows_; ++j)
      for (int i = 0; i < columns_; ++i) {
        LightPoint& p = points_[static_cast<std::size_t>(j) * columns_ + i];
        if (p.mesh == std::numeric_limits<unsigned>::max()) continue;
        float open = 0, key = 0, sum = 0;
        for (int v = std::max(0, j - kBlur); v <= std::min(rows_ - 1, j + kBlur); ++v)
          for (int u = std::max(0, i - kBlur); u <= std::min(columns_ - 1, i + kBlur); ++u) {
            const LightPoint& q = raw[static_cast<std::size_t>(v) * columns_ + u];
            const float w = same_surface(q, p.point, p.normal, p.mesh, p.inner);
            open += w * q.seen.open;
            key += w * q.seen.key;
            sum += w;
          }
        if (sum > 0) p.seen = {open / sum, key / sum};
      }
  }

  Visibility visibility(const Seen& s, double x, double y, int px, int py) const {
    const double gx = x / kStep - 0.5, gy = y / kStep - 0.5;
    const int i0 = static_cast<int>(std::floor(gx)), j0 = static_cast<int>(std::floor(gy));
    const Eigen::Vector3f point = s.point.cast<float>(), normal = s.normal.cast<float>();
    float open = 0, key = 0, sum = 0;
    for (int dj = 0; dj <= 1; ++dj)
      for (int di = 0; di <= 1; ++di) {
        const int i = i0 + di, j = j0 + dj;
        if (i < 0 || j < 0 || i >= columns_ || j >= rows_) continue;
        const float near = static_cast<float>((1.0 - std::abs(gx - i)) * (1.0 - std::abs(gy - j))) + 0.02F;
        const LightPoint& p = points_[static_cast<std::size_t>(j) * columns_ + i];
        const float w = near * same_surface(p, point, normal, s.mesh, s.inner);
        open += w * p.seen.open;
        key += w * p.seen.key;
        sum += w;
      }
    if (sum > 1e-3F) return {open / sum, key / sum};
    return lights_.see(s.start, s.normal, s.baked, px, py);  // a thin part that no lighting point met
  }

  /// Whether `holds` of the lighting point at the pixel and of all around it.
  template <class F>
  bool all_around(int x, int y, F&& holds) const {
    const int i = x / kStep, j = y / kStep;
    for (int v = std::max(0, j - 1); v <= std::min(rows_ - 1, j + 1); ++v)
      for (int u = std::max(0, i - 1); u <= std::min(columns_ - 1, i + 1); ++u)
        if (!holds(points_[static_cast<std::size_t>(v) * columns_ + u])) return false;
    return true;
  }

  /// No lighting point near the pixel saw the subject, so no ray within it will; parts thinner than that are lost.
  bool empty_around(int x, int y) const {
    return all_around(x, y, [](const LightPoint& p) { return p.mesh == std::numeric_limits<unsigned>::max(); });
  }

  /// All lighting points near the pixel lie on one surface of one colour: a single ray shows what many would.
  bool smooth_around(int x, int y) const {
    const LightPoint& own = points_[static_cast<std::size_t>(y / kStep) * columns_ + x / kStep];
    if (own.mesh == std::numeric_limits<unsigned>::max() || !meshes_[own.mesh].texture.empty()) return false;
    return all_around(
        x, y, [&](const LightPoint& p) { return same_surface(p, own.point, own.normal, own.mesh, own.inner) > 0; });
  }

  Eigen::Vector4f look(const Vec2& at, const std::optional<Seen>& s, int px, int py) const {
    if (!s) return ground(at.x(), at.y());
    const float light = lights_.shade(s->normal, visibility(*s, at.x(), at.y(), px, py), s->inner);
    const Colour c = shoulder(light * textures_[s->mesh].at(s->u, s->v));
    return {c[0], c[1], c[2], 1.0F};
  }

  /// A seamless sweep: one colour everywhere, darker only where the subject stands close.
  Eigen::Vector4f ground(double x, double y) const {
    const float dark = floor_shadow(x, y);
    if (options_.ground == Ground::alpha) return {0, 0, 0, dark};
    const Colour c = backdrop() * (1.0F - dark);
    return {c[0], c[1], c[2], 1.0F};
  }

  void look_at_floor() {
    floor_columns_ = options_.view_width / kFloorStep + 2;
    const int rows = options_.view_height / kFloorStep + 2;
    floor_.assign(static_cast<std::size_t>(floor_columns_) * rows, 0.0F);
    const double half = -framing_.top_left.x();
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < floor_columns_; ++i) {
        const Vec2 at = film(i * kFloorStep, j * kFloorStep);
        const Vec3 direction = camera_.direction(at);
        const double down = framing_.ground - eye_.y();
        if (!(direction.y() * down > 0)) continue;
        const Vec3 point = eye_ + direction * (down / direction.y());
        const double away = std::hypot(point.x() - camera_.pivot.x(), point.z() - camera_.pivot.z()) / shadow_radius_;
        if (away >= 1.0) continue;
        // Neighbouring views meet without a step.
        const double fade =
            std::clamp(4.0 * (1.0 - away), 0.0, 1.0) * std::clamp((half - std::abs(at.x())) / (0.3 * half), 0.0, 1.0);
        if (fade > 0)
          floor_[static_cast<std::size_t>(j) * floor_columns_ + i] =
              static_cast<float>(fade) * lights_.floor_shadow(point, i, j);
      }
  }

  float floor_shadow(double x, double y) const {
    const double gx = x / kFloorStep, gy = y / kFloorStep;
    const int i = static_cast<int>(gx), j = static_cast<int>(gy);
    const float fx = static_cast<float>(gx - i), fy = static_cast<float>(gy - j);
    const float* p = &floor_[static_cast<std::size_t>(j) * floor_columns_ + i];
    const float a = p[0] + fx * (p[1] - p[0]), b = p[floor_columns_] + fx * (p[floor_columns_ + 1] - p[floor_columns_]);
    return a + fy * (b - a);
  }

  std::span<const RenderMesh> meshes_;
  std::span<const TextureLookup> textures_;
  const Tracer& tracer_;
  const Framing& framing_;
  const Camera& camera_;
  const PreviewOptions& options_;
  const Lights lights_;
  const Vec3 eye_;
  double shadow_radius_ = 0;  // [m] around the pivot in which the floor can be dark
  int columns_ = 0, rows_ = 0, floor_columns_ = 0;
  std::vector<LightPoint> points_;
  std::vector<float> floor_;
};

}  // namespace

void draw_view(std::span<const RenderMesh> meshes, std::span<const TextureLookup> textures, const Tracer& tracer,
               const Framing& framing, const Camera& camera, const PreviewOptions& options, Image& picture, int left) {
  View(meshes, textures, tracer, framing, camera, options).draw(picture, left);
}

}  // namespace vitrine
