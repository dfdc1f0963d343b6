// SPDX-License-Identifier: GPL-3.0-or-later
#include "dressing.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <stdexcept>

namespace vitrine::bench {
namespace {

double polygon_area(const std::vector<Vec2>& p) {
  double twice = 0;
  for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++) twice += p[j].x() * p[i].y() - p[i].x() * p[j].y();
  return std::abs(twice) / 2;
}

}  // namespace

std::string write_png(const std::string& folder, const std::string& name, const Image& picture) {
  const auto png = encode_png(picture);
  if (!png) throw std::runtime_error(png.error().message);
  const std::string path = (std::filesystem::path(folder) / (name + ".png")).string();
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(png->data()), static_cast<std::streamsize>(png->size()));
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
  return path;
}

DrawnGarment draw_garment(support::GarmentKind kind, const std::string& folder) {
  support::PhotoSpec spec = support::random_spec(11, kind);
  const std::string name = support::id_of(kind);
  return {write_png(folder, name + "-front", support::make_photo(spec).rgb),
          write_png(folder, name + "-back", support::make_photo(support::back_of(spec)).rgb), kind};
}

SeenGarment see_garment(const DrawnGarment& drawn, const PluginRegistry& registry, std::shared_ptr<const Body> body) {
  ConvertRequest request;
  request.front = drawn.front;
  request.back = drawn.back;
  request.garment = *registry.find_garment(support::id_of(drawn.kind));
  request.necklines = registry.necklines();
  request.body = std::move(body);
  SeenGarment item{request.garment, see_photos(request)};
  if (item.seen.error) throw std::runtime_error(item.seen.error->code + ": " + item.seen.error->message);
  return item;
}

Result<Drape> dress_garment(const SeenGarment& item, const Body& body, const Dressing& dressing) {
  PanelOptions options;
  options.girths = body.mannequin.girths;
  options.edge_length = 0.03;
  const auto cut = [&] {
    return make_panels(item.seen.front.features, item.seen.back.features, item.garment, options);
  };
  const auto first = cut();
  if (!first) return first.error();
  const double area = polygon_area(first->front.outline) + polygon_area(first->back.outline);
  std::vector<Pattern> levels;
  for (const int nodes : dressing.level_nodes) {
    // A hexagonal lattice of spacing h spends h^2 sqrt(3)/2 of area on each node.
    options.edge_length = std::sqrt(area / (nodes * std::numbers::sqrt3 / 2));
    auto panels = cut();
    if (!panels) return panels.error();
    Pattern pattern;
    pattern.panels = {panels->front, panels->back};
    pattern.pairs = panels->pairs;
    pattern.edge_length = options.edge_length;
    pattern.metres_per_pixel = panels->metres_per_pixel_front;
    MeshOptions mesh_options;
    mesh_options.edge_length = options.edge_length;
    for (const Panel& panel : pattern.panels) {
      auto mesh = mesh_panel(panel.outline, mesh_options);
      if (!mesh) return mesh.error();
      pattern.meshes.push_back(*std::move(mesh));
    }
    levels.push_back(std::move(pattern));
  }
  const auto placed = place_panels(item.garment, levels.front(), body.mannequin, body.field);
  if (!placed) return placed.error();
  const Fabric& fabric = dressing.fabric.name.empty() ? item.garment.fabrics.front() : dressing.fabric;
  return sew_and_drape(levels, *placed, fabric, body.field, dressing.sewing);
}

Outcome outcome_of(const Error& error) {
  Outcome o;
  o.status = error.code;
  o.refused = true;
  o.note = error.message;
  return o;
}

Outcome outcome_of(const Result<Drape>& drape) {
  if (!drape) return outcome_of(drape.error());
  Outcome o;
  o.status = drape->status;
  o.residual = drape->residual;
  o.gap_mm = drape->seam_gap_mm_max;
  o.penetration_mm = drape->penetration_mm_max;
  o.stretch_p99 = drape->stretch_p99;
  for (const auto& panel : drape->positions)
    for (const Vec3& p : panel) o.finite = o.finite && p.allFinite();
  o.finite = o.finite && !drape->positions.empty() && std::isfinite(drape->residual);
  o.note = drape->detail;
  return o;
}

}  // namespace vitrine::bench
