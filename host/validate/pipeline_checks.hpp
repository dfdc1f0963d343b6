// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "session.hpp"

namespace vitrine::validation {

/// What the conversions of a whole plugin have found, check by check.
struct PipelineFindings {
  std::map<std::string_view, std::vector<std::string>> broken;
  std::set<std::string_view> done;  ///< checks that had something to look at
  int photos = 0, drapes = 0;
  double residual = 0, gap_mm = 0, depth_mm = 0;  ///< the worst
  int lying = 0;                                  ///< poses that cannot be drawn, because a limb lies on the trunk
  std::string folder;  ///< of the drawn photos; left out of messages, which are the same in every run
  void find(std::string_view check, std::string what) {
    for (std::size_t at; (at = what.find(folder + "/")) != std::string::npos;) what.erase(at, folder.size() + 1);
    broken[check].push_back(std::move(what));
  }
};

/// A garment in one pose with one neckline, drawn into two files.
struct DrawnItem {
  std::string what;  ///< for messages: garment "vest", pose "wide", neckline "neck_u"
  ConvertRequest request;
  std::vector<Vec2> features;  ///< [px] of the front, per template feature
  double diagonal = 0;         ///< [px]
  const TemplatePose* pose = nullptr;
};

/// Draws and writes the two photos; the error names the file.
Result<DrawnItem> draw_item(const Session& session, const GarmentTemplate& garment, const TemplatePose& pose,
                            const NecklineTemplate* neckline, const std::vector<NecklineTemplate>& necklines,
                            const std::string& folder);

/// Converts a drawn item as far as the cloth at rest, in the first `fabrics` fabrics, and judges it.
void judge_item(const DrawnItem& item, std::size_t fabrics, PipelineFindings& findings);

/// pipeline.files and level 5. No item: nothing can be converted, or what was tried failed before.
void check_determinism(const Session& session, const Subject& subject, const DrawnItem* item,
                       const std::string& tables_before);

}  // namespace vitrine::validation
