// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline_checks.hpp"
#include "vitrine/template_photo.hpp"

namespace vitrine::validation {
namespace {

constexpr double most_residual = 1e-2, most_gap_mm = 2, most_depth_mm = 1;

/// Pieces that the sewn cloth falls into.
int pieces(const Pattern& pattern, const Drape& drape) {
  std::uint32_t count = 0;
  for (const auto& panel : drape.welded)
    for (const std::uint32_t node : panel) count = std::max(count, node + 1);
  std::vector<std::uint32_t> parent(count);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<char> used(count, 0);
  for (std::size_t p = 0; p < pattern.meshes.size() && p < drape.welded.size(); ++p)
    for (const Triangle& t : pattern.meshes[p].triangles)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = drape.welded[p][t[k]], b = drape.welded[p][t[(k + 1) % 3]];
        used[a] = used[b] = 1;
        parent[root(a)] = root(b);
      }
  int roots = 0;
  for (std::uint32_t i = 0; i < count; ++i) roots += used[i] && parent[i] == i;
  return roots;
}

void judge_features(const DrawnItem& item, const Conversion& flat, PipelineFindings& findings) {
  findings.done.insert("pipeline.features");
  const Features& seen = flat.front.features;
  for (std::size_t i = 0; i < seen.points.size() && i < item.features.size(); ++i) {
    const double away = (seen.points[i].pixel - item.features[i]).norm(), most = item.pose->radius[i] * item.diagonal;
    if (!(away <= most))
      findings.find("pipeline.features", item.what + ": \"" + seen.points[i].name + "\" was found " +
                                             number(away / item.diagonal) + " of the box diagonal from where it was " +
                                             "drawn, its search radius is " + number(item.pose->radius[i]));
  }
}

void judge_drape(const DrawnItem& item, const Pattern& pattern, const FabricDrape& sewn, PipelineFindings& findings) {
  const std::string what = item.what + ", fabric \"" + sewn.fabric + "\"";
  ++findings.drapes;
  findings.done.insert("pipeline.drape");
  if (sewn.error) findings.find("pipeline.drape", what + ": " + sewn.error->code + ", " + sewn.error->message);
  const Drape& d = sewn.drape;
  if (d.positions.empty()) return;
  for (const char* check : {"pipeline.residual", "pipeline.seams", "pipeline.body", "pipeline.pieces", "pipeline.size"})
    findings.done.insert(check);
  findings.residual = std::max(findings.residual, d.residual);
  findings.gap_mm = std::max(findings.gap_mm, d.seam_gap_mm_max);
  findings.depth_mm = std::max(findings.depth_mm, d.penetration_mm_max);
  if (!(d.residual <= most_residual)) findings.find("pipeline.residual", what + ": " + number(d.residual));
  if (!(d.seam_gap_mm_max <= most_gap_mm))
    findings.find("pipeline.seams", what + ": " + number(d.seam_gap_mm_max) + " mm");
  if (!(d.penetration_mm_max <= most_depth_mm))
    findings.find("pipeline.body", what + ": " + number(d.penetration_mm_max) + " mm");
  if (const int count = pieces(pattern, d); count != 1)
    findings.find("pipeline.pieces", what + ": " + std::to_string(count) + " pieces");
  Vec3 low(1e9, 1e9, 1e9), high = -low;
  bool finite = true;
  for (const auto& panel : d.positions)
    for (const Vec3& p : panel) {
      finite = finite && p.allFinite();
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  const Vec3 size = high - low;
  if (!finite || size.maxCoeff() < 0.15 || size.maxCoeff() > 2.5 || size.minCoeff() < 0.05)
    findings.find("pipeline.size",
                  what + ": " + number(size.x()) + " x " + number(size.y()) + " x " + number(size.z()) + " m");
}

}  // namespace

Result<DrawnItem> draw_item(const Session& session, const GarmentTemplate& garment, const TemplatePose& pose,
                            const NecklineTemplate* neckline, const std::vector<NecklineTemplate>& necklines,
                            const std::string& folder) {
  DrawnItem item;
  item.what = "garment \"" + garment.id + "\", pose \"" + pose.name + "\"";
  if (neckline != nullptr) item.what += ", neckline \"" + neckline->id + "\"";
  item.pose = &pose;
  const unsigned seed = session.options.seed;
  const double proportions = box_proportions(garment, pose, session.options.body->mannequin);
  ConvertRequest& request = item.request;
  request.name = garment.id;
  request.garment = garment;
  request.necklines = necklines;
  request.neckline = neckline != nullptr ? neckline->id : "auto";
  request.quality = Quality::draft;
  request.texture.max_size = 512;
  request.body = session.options.body;
  for (const Side side : {Side::front, Side::back}) {
    const TemplatePhoto photo = draw_template_photo(garment, pose, neckline, side, proportions, seed);
    const std::string path = folder + (side == Side::front ? "/front.png" : "/back.png");
    const auto png = encode_png(photo.rgb);
    if (!png) return png.error();
    if (auto e = write_file(path, *png)) return *e;
    if (!session.options.keep.empty())
      if (auto e = write_file(session.options.keep + "/" + garment.id + "-" + pose.name +
                                  (neckline != nullptr ? "-" + neckline->id : "") +
                                  (side == Side::front ? "-front.png" : "-back.png"),
                              *png))
        return *e;
    (side == Side::front ? request.front : request.back) = path;
    if (side == Side::front) {
      item.features = photo.features;
      item.diagonal = photo.diagonal;
    }
  }
  return item;
}

void judge_item(const DrawnItem& item, std::size_t fabrics, PipelineFindings& findings) {
  ++findings.photos;
  Conversion flat;
  const auto drapes = cut_and_sew_fabrics(item.request, fabrics, flat);
  if (flat.front.error || flat.back.error) {
    const Error& error = flat.front.error ? *flat.front.error : *flat.back.error;
    findings.done.insert("pipeline.features");
    findings.find("pipeline.features", item.what + ": " + error.code + ", " + error.message);
    return;
  }
  judge_features(item, flat, findings);
  findings.done.insert("pipeline.panels");
  if (flat.error) {
    findings.find("pipeline.panels", item.what + ": " + flat.error->code + ", " + flat.error->message);
    return;
  }
  for (const FabricDrape& sewn : drapes) judge_drape(item, flat.pattern, sewn, findings);
}

}  // namespace vitrine::validation
