// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "vitrine/pipeline.hpp"

namespace vitrine {
namespace {

using Json = nlohmann::ordered_json;

/// Name of the same feature in a mirrored picture: what the front frame calls left is the right of a back photo.
std::string swap_sides(std::string name) {
  const auto swap_end = [&](const std::string& from, const std::string& to) {
    if (name.size() < from.size() || name.compare(name.size() - from.size(), from.size(), from) != 0) return false;
    name.replace(name.size() - from.size(), from.size(), to);
    return true;
  };
  if (!swap_end("_left", "_right")) swap_end("_right", "_left");
  return name;
}

/// A pixel of the front frame as a pixel of the photo as given.
Vec2 source_pixel(const Photo& photo, Vec2 p) {
  if (photo.mirrored) p.x() = photo.rgb.width - 1 - p.x();
  return p / photo.scale;
}

void add_features(Json& list, const char* panel, const Photo& photo, const Features& features) {
  for (const FeaturePoint& f : features.points) {
    const Vec2 p = source_pixel(photo, f.pixel);
    list.push_back({{"panel", panel},
                    {"name", photo.mirrored ? swap_sides(f.name) : f.name},
                    {"landmark", f.landmark},
                    {"x", p.x()},
                    {"y", p.y()},
                    {"origin", f.origin},
                    {"confidence", f.confidence}});
  }
  if (!features.points.empty() && !features.neckline.id.empty()) {
    const Vec2 p = source_pixel(photo, features.neckline.low);
    list.push_back({{"panel", panel},
                    {"name", "neck_low"},
                    {"landmark", panel == std::string("front") ? "neck_front" : "neck_back"},
                    {"x", p.x()},
                    {"y", p.y()},
                    {"origin", "neckline"},
                    {"confidence", features.neckline.inside_found ? 0.9 : 0.7}});
  }
}

Json silhouette_json(const Silhouette& s) {
  Json j{{"method", s.method}, {"edge_support", s.edge_support}};
  if (!s.method_reason.empty()) j["method_reason"] = s.method_reason;
  return j;
}

Json mesh_json(const PanelMesh& mesh) {
  const MeshStats s = measure_mesh(mesh);
  return {{"nodes", s.nodes},
          {"triangles", s.triangles},
          {"min_angle_deg", s.min_angle_deg},
          {"mean_min_angle_deg", s.mean_min_angle_deg},
          {"flat_share", s.flat_share},
          {"edge_cv", s.edge_cv}};
}

}  // namespace

std::string report_json(const ConvertRequest& request, const Conversion& item) {
  Json j;
  j["name"] = request.name;
  j["status"] = item.error ? "REFUSED" : item.drape.status;
  if (item.error && !item.garment_glb.empty()) j["status"] = item.error->code;  // written, but marked
  if (item.error)
    j["error"] = {{"stage", item.error->stage},
                  {"code", item.error->code},
                  {"message", item.error->message},
                  {"remedy", item.error->remedy},
                  {"exit_code", item.error->exit_code()}};
  j["garment"] = {{"id", request.garment.id}, {"plugin", request.garment.plugin}, {"version", request.garment.version}};
  j["photos"] = {{"front", request.front}, {"back", request.mirror_back ? "mirrored front" : request.back}};
  if (!item.front_silhouette.method.empty()) j["silhouette"]["front"] = silhouette_json(item.front_silhouette);
  if (!item.back_silhouette.method.empty()) j["silhouette"]["back"] = silhouette_json(item.back_silhouette);
  j["features"] = Json::array();
  add_features(j["features"], "front", item.front_photo, item.front_features);
  add_features(j["features"], "back", item.back_photo, item.back_features);
  if (!item.front_features.points.empty()) {
    j["pose"] = item.front_features.pose;
    j["template_score"] = item.front_features.score;
    const NecklineChoice& n = item.front_features.neckline;
    if (!n.id.empty())
      j["neckline"] = {{"id", n.id}, {"ratio", n.ratio}, {"forced", n.forced}, {"inside_found", n.inside_found}};
  }
  if (!item.panels.scale_source.empty())
    j["panels"] = {{"scale_source", item.panels.scale_source},
                   {"mm_per_pixel_front", item.panels.metres_per_pixel_front * 1e3 * item.front_photo.scale},
                   {"mm_per_pixel_back", item.panels.metres_per_pixel_back * 1e3 * item.back_photo.scale},
                   {"worst_seam_ratio", item.panels.worst_seam_ratio}};
  if (item.pattern.meshes.size() == 2) {
    j["mesh"] = {{"edge_length_mm", item.pattern.edge_length * 1e3},
                 {"front", mesh_json(item.pattern.meshes[0])},
                 {"back", mesh_json(item.pattern.meshes[1])},
                 {"seam_pairs", item.pattern.pairs.size()}};
  }
  if (request.body) j["mannequin"] = {{"source", request.body->mannequin.source}};
  const Drape& d = item.drape;
  if (!d.status.empty()) {
    Json levels = Json::array();
    for (const LevelFigures& l : d.levels)
      levels.push_back({{"nodes", l.nodes},
                        {"iterations", l.iterations},
                        {"residual", l.residual},
                        {"change_mean_mm", l.change_mean_mm},
                        {"change_max_mm", l.change_max_mm}});
    j["fabric"] = {{"name", item.fabric.name}, {"stretch", item.fabric.stretch}, {"shear", item.fabric.shear},
                   {"bend", item.fabric.bend}, {"mass", item.fabric.mass},       {"friction", item.fabric.friction}};
    j["drape"] = {{"status", d.status},
                  {"detail", d.detail},
                  {"residual", d.residual},
                  {"seam_gap_mm_max", d.seam_gap_mm_max},
                  {"penetration_mm_max", d.penetration_mm_max},
                  {"strain_p99", d.strain_p99},
                  {"stretch_p99", d.stretch_p99},
                  {"strain_max", d.strain_max},
                  {"stiffness_cap", d.stiffness_cap},
                  {"energy", d.energy},
                  {"levels", levels},
                  {"modelled", d.modelled},
                  {"skipped", d.skipped}};
  }
  j["warnings"] = item.warnings;
  // Processor time is the one part of a conversion that differs between two runs; it is kept apart, last, and in no
  // other file.
  Json ms = Json::object();
  for (const auto& [stage, value] : item.stage_ms) ms[stage] = ms.value(stage, 0.0) + value;
  j["versions"] = {{"vitrine", request.version}, {"report", 1}};
  j["ms"] = ms;
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace vitrine
