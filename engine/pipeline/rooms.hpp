// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <ctime>

#include "vitrine/fit.hpp"
#include "vitrine/pipeline.hpp"

namespace vitrine {

/// Node counts (both panels) and residual of one quality.
struct QualityPlan {
  std::vector<int> level_nodes;
  double residual;
};
QualityPlan plan_for(Quality quality);

/// Carries one item through the rooms: each step takes what the rooms before it left in the Conversion. After the first
/// error no further room is entered.
class Rooms {
 public:
  Rooms(const ConvertRequest& request, Conversion& item) : request_(request), item_(item) {}

  using Step = std::optional<Error>;

  template <class F>
  void enter(const char* room, F&& step) {
    if (item_.error) return;
    if (request_.progress) request_.progress(room, 0);
    const std::clock_t start = std::clock();
    Step error = step();
    item_.stage_ms.emplace_back(room, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    if (error) {
      if (error->stage.empty()) error->stage = room;
      item_.error = std::move(error);
    }
  }

  Step check_request();
  Step load_photos();
  Step find_silhouettes();
  Step find_feature_points();
  Step cut_panels();
  Step mesh_levels();
  Step place();
  Step sew();
  Step texture();
  Step write_glb();
  Step take_pictures();
  Step judge_drape();

 private:
  PanelOptions panel_options(double edge_length) const;

  const ConvertRequest& request_;
  Conversion& item_;
  QualityPlan plan_;
  std::vector<Pattern> levels_;
  Placement placed_;
};

}  // namespace vitrine
