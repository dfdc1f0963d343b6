// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/preview.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "camera.hpp"
#include "texture_lookup.hpp"
#include "view.hpp"
#include "vitrine/rays.hpp"

namespace vitrine {
namespace {

std::optional<Error> check_options(const PreviewOptions& o) {
  const bool size = o.view_width >= 16 && o.view_width <= 8192 && o.view_height >= 16 && o.view_height <= 8192;
  const bool rays = o.samples >= 1 && o.samples <= 256 && o.occlusion_rays >= 0 && o.occlusion_rays <= 1024;
  const bool automatic = o.frame_bottom < 0 && o.frame_top < 0;
  const bool frame = automatic || (std::isfinite(o.frame_bottom) && std::isfinite(o.frame_top) &&
                                   o.frame_top - o.frame_bottom > 1e-3 && o.frame_top - o.frame_bottom < 1e3);
  bool turns = !o.turns_deg.empty() && o.turns_deg.size() <= 72;
  for (double turn : o.turns_deg) turns = turns && std::isfinite(turn);
  turns = turns && static_cast<double>(o.turns_deg.size()) * o.view_width <= 65'500;
  if (o.subject)
    turns = turns && o.subject->low.allFinite() && o.subject->high.allFinite() &&
            (o.subject->high - o.subject->low).minCoeff() >= 0 && (o.subject->high - o.subject->low).maxCoeff() < 1e3;
  if (size && rays && frame && turns) return std::nullopt;
  return Error{Cause::usage, "BAD_PREVIEW_OPTIONS", "The preview's size, views, rays or frame are out of range.",
               "Use 16 to 8192 px, 1 to 72 views of at most 65,500 px together, 1 to 256 samples, 0 to 1024 occlusion "
               "rays and a frame whose top is above its bottom.",
               "preview"};
}

std::optional<Error> check_mesh(const RenderMesh& m) {
  bool good = !m.positions.empty() && !m.triangles.empty() && m.normals.size() == m.positions.size();
  good = good && (m.texture.empty() || (m.uv.size() == m.positions.size() && m.texture.channels == 3 &&
                                        m.texture.data.size() == 3 * static_cast<std::size_t>(m.texture.width) *
                                                                     static_cast<std::size_t>(m.texture.height)));
  for (const Triangle& t : m.triangles) good = good && std::max({t[0], t[1], t[2]}) < m.positions.size();
  for (const Vec3& p : m.positions) good = good && p.allFinite() && p.cwiseAbs().maxCoeff() < 1e3;
  for (const Vec3& n : m.normals) good = good && n.allFinite();
  for (const Vec2& t : m.uv) good = good && t.allFinite();
  if (good) return std::nullopt;
  return Error{Cause::internal, "BAD_MESH",
               "Mesh \"" + m.name + "\" cannot be drawn: it is empty or contradicts itself.",
               "Report this with the photos that caused it.", "preview"};
}

}  // namespace

Result<Image> render_preview(std::span<const RenderMesh> meshes, const PreviewOptions& options) {
  if (auto error = check_options(options)) return *error;
  if (meshes.empty()) return Error{Cause::internal, "BAD_MESH", "There is no mesh to draw.", "Report this.", "preview"};
  for (const RenderMesh& mesh : meshes)
    if (auto error = check_mesh(mesh)) return *error;
  const Framing framing = frame_subject(meshes, options);
  const auto tracer = Tracer::build(meshes);
  if (!tracer) return tracer.error();
  std::vector<TextureLookup> textures;
  const double footprint = framing.pixel / std::sqrt(static_cast<double>(options.samples));
  for (const RenderMesh& mesh : meshes) textures.emplace_back(mesh, footprint);

  Image picture(options.view_width * static_cast<int>(framing.cameras.size()), options.view_height,
                options.ground == Ground::alpha ? 4 : 3);
  for (std::size_t view = 0; view < framing.cameras.size(); ++view)
    draw_view(meshes, textures, *tracer, framing, framing.cameras[view], options, picture,
              static_cast<int>(view) * options.view_width);
  return picture;
}

std::vector<double> turntable(int count) {
  std::vector<double> turns;
  for (int i = 0; i < count; ++i) turns.push_back(360.0 * i / count);
  return turns;
}

std::array<double, 2> detail_frame(const RenderMesh& mesh) {
  double top = mesh.positions.empty() ? 0.0 : -1e30;
  for (const Vec3& p : mesh.positions) top = std::max(top, p.y());
  return {top - 0.46, top + 0.06};
}

}  // namespace vitrine
