// SPDX-License-Identifier: GPL-3.0-or-later
// Level 4: the real rooms, on photos that are drawn from the template.
//
// What is combined: the first pose with every neckline and every fabric; every other pose with one neckline, in turn,
// and the default fabric. Poses change the photo, necklines the outline, fabrics the drape; a fault of one of them
// shows without all of the others.
#include "pipeline_checks.hpp"

#include <algorithm>
#include <cstdio>

namespace vitrine::validation {
namespace {

constexpr const char* drape_checks[] = {"pipeline.features", "pipeline.panels", "pipeline.drape",  "pipeline.residual",
                                        "pipeline.seams",    "pipeline.body",   "pipeline.pieces", "pipeline.size"};

/// Garments and necklines that the plugin meets: its own first, then those of the partners that do not bear its ids.
struct Wardrobe {
  std::vector<GarmentTemplate> partners;  ///< with a neck edge
  std::vector<NecklineTemplate> necklines;
};

Wardrobe wardrobe_of(const Session& session, const AdoptedPlugin& plugin) {
  Wardrobe wardrobe;
  wardrobe.necklines = plugin.necklines;
  const PluginRegistry registry = PluginRegistry::load(session.options.partners);
  for (const NecklineTemplate& n : registry.necklines())
    if (n.plugin != plugin.identity.id &&
        std::none_of(plugin.necklines.begin(), plugin.necklines.end(), [&](const auto& own) { return own.id == n.id; }))
      wardrobe.necklines.push_back(n);
  for (const GarmentTemplate& g : registry.garments())
    if (g.plugin != plugin.identity.id && g.neck_edge() >= 0) wardrobe.partners.push_back(g);
  return wardrobe;
}

class PipelineChecks {
 public:
  PipelineChecks(const Session& session, const AdoptedPlugin& plugin, const std::string& folder)
      : session_(session), plugin_(plugin), wardrobe_(wardrobe_of(session, plugin)), folder_(folder) {
    findings_.folder = folder;
  }

  void run() {
    for (const GarmentTemplate& garment : plugin_.garments) {
      const bool neck = garment.neck_edge() >= 0 && !wardrobe_.necklines.empty();
      const std::size_t necklines = neck ? wardrobe_.necklines.size() : 1;
      const auto poses = drawable_poses(garment);
      findings_.lying += static_cast<int>(garment.poses.size() - poses.size());
      for (std::size_t p = 0; p < poses.size(); ++p)
        for (std::size_t n = 0; n < necklines; ++n)
          if (p == 0 || n == p % necklines)
            try_item(garment, *poses[p], neck ? &wardrobe_.necklines[n] : nullptr, p == 0 ? garment.fabrics.size() : 1);
    }
    for (const NecklineTemplate& neckline : plugin_.necklines)
      for (const GarmentTemplate& garment : wardrobe_.partners)
        if (const auto poses = drawable_poses(garment); !poses.empty()) try_item(garment, *poses.front(), &neckline, 1);
    report();
  }

  /// The first pose of the first garment, to convert as a whole; empty when there is none.
  std::optional<DrawnItem> first_item() {
    const GarmentTemplate* garment = !plugin_.garments.empty()     ? &plugin_.garments.front()
                                     : !wardrobe_.partners.empty() ? &wardrobe_.partners.front()
                                                                   : nullptr;
    if (garment == nullptr) return std::nullopt;
    const bool neck = garment->neck_edge() >= 0 && !wardrobe_.necklines.empty();
    const auto poses = drawable_poses(*garment);
    if (poses.empty()) return std::nullopt;
    auto item = draw_item(session_, *garment, *poses.front(), neck ? &wardrobe_.necklines.front() : nullptr,
                          wardrobe_.necklines, folder_);
    if (!item) return std::nullopt;
    return *std::move(item);
  }

  /// Whether a whole conversion is worth while.
  bool sound() const {
    return std::all_of(findings_.broken.begin(), findings_.broken.end(),
                       [](const auto& b) { return b.second.empty(); });
  }

  void photos() {
    if (session_.options.photos.empty() || plugin_.garments.empty())
      return session_.skip("pipeline.photos",
                           session_.options.photos.empty() ? "no --photo was given" : "it brings no garment");
    session_.begin("pipeline.photos");
    std::vector<std::string> findings;
    for (const std::string& photo : session_.options.photos) {
      // A plugin of several garments: the photo shows one of them.
      std::vector<std::string> refusals;
      bool converted = false;
      for (const GarmentTemplate& garment : plugin_.garments) {
        ConvertRequest request;
        request.garment = garment;
        request.necklines = wardrobe_.necklines;
        request.front = photo;
        request.mirror_back = true;
        request.quality = Quality::draft;
        request.body = session_.options.body;
        const Conversion item = cut_and_sew(request);
        converted = converted || !item.error;
        if (item.error) refusals.push_back(item.error->code + ", " + item.error->message);
      }
      if (!converted) findings.push_back(refusals.front());
    }
    session_.conclude("pipeline.photos", findings, std::to_string(session_.options.photos.size()) + " photos");
  }

 private:
  /// A sleeve that lies on the body has no outline of its own to draw.
  static std::vector<const TemplatePose*> drawable_poses(const GarmentTemplate& garment) {
    std::vector<const TemplatePose*> poses;
    for (const TemplatePose& pose : garment.poses)
      if (crossing_edges(garment, pose).empty()) poses.push_back(&pose);
    return poses;
  }

  void try_item(const GarmentTemplate& garment, const TemplatePose& pose, const NecklineTemplate* neckline,
                std::size_t fabrics) {
    // Every photo begins anew, so that the time limit is one photo's.
    session_.begin("pipeline.features");
    const auto item = draw_item(session_, garment, pose, neckline, wardrobe_.necklines, folder_);
    if (!item) return findings_.find("pipeline.features", item.error().message);
    judge_item(*item, fabrics, findings_);
  }

  void report() {
    char worst[96];
    std::snprintf(worst, sizeof worst, "%d drapes: residual %.1e, gap %.2f mm, depth %.2f mm at most", findings_.drapes,
                  findings_.residual, findings_.gap_mm, findings_.depth_mm);
    for (const std::string_view check : drape_checks) {
      if (!findings_.done.contains(check) && !findings_.broken.contains(check)) {
        session_.skip(check, findings_.photos == 0
                                 ? "nothing could be drawn: no garment with a neck edge, or no pose clear of itself"
                                 : "nothing came that far");
        continue;
      }
      session_.conclude(check, findings_.broken[check],
                        check == "pipeline.features"
                            ? std::to_string(findings_.photos) + " photos" +
                                  (findings_.lying > 0 ? ", " + std::to_string(findings_.lying) +
                                                             " poses not drawn: a limb lies on the trunk"
                                                       : "")
                        : check == "pipeline.drape" ? worst
                                                    : "");
    }
  }

  const Session& session_;
  const AdoptedPlugin& plugin_;
  const Wardrobe wardrobe_;
  const std::string folder_;
  PipelineFindings findings_;
};

}  // namespace

void check_pipeline(const Session& session, const Subject& subject, const std::string& folder) {
  session.begin("pipeline.features");
  const std::string tables = bytes_digest(subject.tables);
  if (folder.empty()) return session.fail("pipeline.features", "no folder for the drawn photos could be made");
  PipelineChecks checks(session, subject.plugin, folder);
  checks.run();
  checks.photos();
  if (!checks.sound()) return check_determinism(session, subject, nullptr, tables);
  session.begin("pipeline.files");
  const auto item = checks.first_item();
  check_determinism(session, subject, item ? &*item : nullptr, tables);
}

}  // namespace vitrine::validation
