// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <ctime>

#include "vitrine/fit.hpp"
#include "vitrine/pipeline.hpp"

namespace vitrine {

/// The steps of see(), one for each room. Each stops with the room's error, which is also kept in the view.
std::optional<Error> load_view(const ViewRequest& request, View& view);
std::optional<Error> outline_view(const ViewRequest& request, View& view);
std::optional<Error> name_points(const ViewRequest& request, View& view);

/// Moves a room's value into its place, or hands its error on.
template <class T>
std::optional<Error> keep(Result<T> result, T& place) {
  if (!result) return result.error();
  place = *std::move(result);
  return std::nullopt;
}

/// Carries one item through the rooms: each step takes what the rooms before it left in the Conversion. After the first
/// error no further room is entered.
class Rooms {
 public:
  Rooms(const ConvertRequest& request, Conversion& item)
      : request_(request),
        settings_(request.settings.value_or(settings_of(request.quality))),
        front_(view_of(request, Side::front)),
        back_(view_of(request, Side::back)),
        item_(item) {}

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
  Step check_for_shops();
  Step judge_drape();

 private:
  PanelOptions panel_options(double edge_length) const;
  std::optional<Error> mesh(Pattern& level) const;

  const ConvertRequest& request_;
  const Settings settings_;
  const ViewRequest front_, back_;
  Conversion& item_;
  std::vector<Panels> cuts_;     ///< one for each level
  std::vector<Pattern> levels_;  ///< with a budget those beyond the first are meshed when they are needed
  double cloth_area_ = 0;        ///< [m^2] of both panels
  Placement placed_;
};

}  // namespace vitrine
