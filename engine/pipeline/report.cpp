// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <nlohmann/json.hpp>

#include "as_given.hpp"
#include "budget.hpp"
#include "digest.hpp"

namespace vitrine {
namespace {

using Json = nlohmann::ordered_json;

void add_features(Json& list, const char* panel, const ViewRequest& request, const View& view) {
  for (const NamedPoint& point : points_as_given(request, view)) {
    Json entry{{"panel", panel}};
    entry.update(point_json(point));
    list.push_back(std::move(entry));
  }
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

Json texture_json(const TextureFigures& f) {
  return {{"atlas_pixels_per_photo_pixel", f.scale},
          {"light_gain", f.gain},
          {"filled_share", f.filled_share},
          {"print_taken_off_share", f.print_share}};
}

/// The paper's eight measurements, as they are read off the mesh.
Json mannequin_json(const Mannequin& body) {
  Json j{{"source", body.source}};
  for (const char* name : {"height", "bust", "under_bust", "waist", "hip", "inside_leg", "arm", "neck_base"})
    if (const auto found = body.girths.find(name); found != body.girths.end())
      j["measurements_mm"][name] = std::round(found->second * 1e4) / 10;
  return j;
}

Json commerce_json(const std::vector<CommerceFinding>& findings) {
  constexpr const char* names[] = {"pass", "warn", "fail"};
  Json list = Json::array();
  for (const CommerceFinding& f : findings)
    list.push_back({{"rule", f.rule},
                    {"verdict", names[static_cast<int>(f.verdict)]},
                    {"value", f.value},
                    {"limit", f.limit},
                    {"sources", f.sources}});
  return list;
}

/// All that is known before the models are written.
void add_facts(Json& j, const ConvertRequest& request, const Conversion& item) {
  j["garment"] = {{"id", request.garment.id}, {"plugin", request.garment.plugin}, {"version", request.garment.version}};
  j["photos"] = {{"front", request.front}, {"back", request.mirror_back ? "mirrored front" : request.back}};
  if (!item.front.silhouette.method.empty()) j["silhouette"]["front"] = silhouette_json(item.front.silhouette);
  if (!item.back.silhouette.method.empty()) j["silhouette"]["back"] = silhouette_json(item.back.silhouette);
  j["features"] = Json::array();
  add_features(j["features"], "front", view_of(request, Side::front), item.front);
  add_features(j["features"], "back", view_of(request, Side::back), item.back);
  const Features& front = item.front.features;
  if (!front.points.empty()) {
    j["pose"] = front.pose;
    j["template_score"] = front.score;
    if (!front.neckline.id.empty()) j["neckline"] = neckline_json(front.neckline);
  }
  if (!item.panels.scale_source.empty())
    j["panels"] = {{"scale_source", item.panels.scale_source},
                   {"mm_per_pixel_front", item.panels.metres_per_pixel_front * 1e3 * item.front.photo.scale},
                   {"mm_per_pixel_back", item.panels.metres_per_pixel_back * 1e3 * item.back.photo.scale},
                   {"worst_seam_ratio", item.panels.worst_seam_ratio}};
  if (item.pattern.meshes.size() == 2) {
    j["mesh"] = {{"edge_length_mm", item.pattern.edge_length * 1e3},
                 {"front", mesh_json(item.pattern.meshes[0])},
                 {"back", mesh_json(item.pattern.meshes[1])},
                 {"seam_pairs", item.pattern.pairs.size()}};
  }
  if (request.body) j["mannequin"] = mannequin_json(request.body->mannequin);
  const Drape& d = item.drape;
  if (!d.status.empty()) {
    Json levels = Json::array();
    for (const LevelFigures& l : d.levels)
      levels.push_back({{"nodes", l.nodes},
                        {"iterations", l.iterations},
                        {"residual", l.residual},
                        {"change_mean_mm", l.change_mean_mm},
                        {"change_max_mm", l.change_max_mm},
                        {"change_surface_mm", l.change_surface_mm},
                        {"loose_turn", l.loose_turn},
                        {"gap_mm", l.gap_mm},
                        {"error_estimate_mm", l.error_estimate_mm},
                        {"work_units", l.work}});
    j["fabric"] = {{"name", item.fabric.name}, {"stretch", item.fabric.stretch}, {"shear", item.fabric.shear},
                   {"bend", item.fabric.bend}, {"mass", item.fabric.mass},       {"friction", item.fabric.friction}};
    if (request.spring_k > 0) j["fabric"]["spring_k"] = request.spring_k;
    if (request.node_mass > 0) j["fabric"]["node_mass"] = request.node_mass;
    j["drape"] = {{"status", d.status},
                  {"detail", d.detail},
                  {"residual", d.residual},
                  {"seam_gap_mm_max", d.seam_gap_mm_max},
                  {"penetration_mm_max", d.penetration_mm_max},
                  {"strain_p99", d.strain_p99},
                  {"stretch_p99", d.stretch_p99},
                  {"strain_max", d.strain_max},
                  {"error_estimate_mm", d.error_estimate_mm ? Json(*d.error_estimate_mm) : Json(nullptr)},
                  {"front_back_touching", d.self_touching},
                  {"front_back_crossed", d.self_crossed},
                  {"front_back_crossed_mm_max", d.self_crossed_mm_max},
                  {"stiffness_cap", d.stiffness_cap},
                  {"energy", d.energy},
                  {"levels", levels},
                  {"modelled", d.modelled},
                  {"skipped", d.skipped}};
  }
  if (request.budget.asked() && !d.status.empty()) j["budget"] = budget_as_json(request, item);
  if (item.texture.size() == 2)
    j["texture"] = {{"atlas_px", {item.garment.texture.width, item.garment.texture.height}},
                    {"front", texture_json(item.texture[0])},
                    {"back", texture_json(item.texture[1])}};
  j["warnings"] = item.warnings;
  j["versions"] = {{"vitrine", request.version}, {"report", 1}};
}

std::string to_text(const Json& j, int indent) {
  return j.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string stage_ms_json(const Conversion& item) {
  Json ms = Json::object();
  for (const auto& [stage, value] : item.stage_ms) ms[stage] = ms.value(stage, 0.0) + value;
  return ms.dump();
}

std::string report_hash(const ConvertRequest& request, const Conversion& item) {
  Json j;
  j["name"] = request.name;
  add_facts(j, request, item);
  const std::string text = to_text(j, -1);
  return sha256_hex(text.data(), text.size());
}

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
  add_facts(j, request, item);
  if (!item.garment_check.empty())
    j["commerce"] = {{"garment.glb", commerce_json(item.garment_check)},
                     {"dressed.glb", commerce_json(item.dressed_check)}};
  // Processor time is the one part of a conversion that differs between two runs; it is kept apart, last, and in no
  // other file.
  if (request.times_in_report) j["ms"] = Json::parse(stage_ms_json(item));
  return to_text(j, 2) + "\n";
}

}  // namespace vitrine
