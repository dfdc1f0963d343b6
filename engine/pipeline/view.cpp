// SPDX-License-Identifier: GPL-3.0-or-later
// The first three rooms, for one photo.
#include <algorithm>

#include "rooms.hpp"

namespace vitrine {
namespace {

/// The error is kept in the view, and names the room and the file.
std::optional<Error> close_room(const char* room, const ViewRequest& request, View& view, std::optional<Error> error) {
  if (error) {
    if (error->stage.empty()) error->stage = room;
    if (error->message.find(request.photo) == std::string::npos) error->message = request.photo + ": " + error->message;
  }
  view.error = error;
  return error;
}

}  // namespace

std::optional<Error> load_view(const ViewRequest& request, View& view) {
  PhotoOptions options;
  options.mirror = request.side == Side::back;
  options.max_side = request.max_side;
  // A fault of the mask file names the mask, not the photo.
  view.error = keep(load_photo(request.photo, request.mask, options), view.photo);
  if (view.error && view.error->stage.empty()) view.error->stage = "photo";
  return view.error;
}

std::optional<Error> outline_view(const ViewRequest& request, View& view) {
  return close_room("silhouette", request, view, keep(find_silhouette(view.photo), view.silhouette));
}

std::optional<Error> name_points(const ViewRequest& request, View& view) {
  FeatureOptions options;
  options.side = request.side;
  options.neckline = request.neckline;
  options.others = request.others;
  // Every garment's template stands upright; so does what the rooms from here on see.
  if (const int turns = turns_to_upright(view.silhouette.labels, request.garment, options); turns != 0) {
    turn_photo(view.photo, turns);
    view.silhouette.labels = turned(view.silhouette.labels, turns);
  }
  return close_room(
      "features", request, view,
      keep(find_features(view.photo, view.silhouette, request.garment, request.necklines, options), view.features));
}

View see(const ViewRequest& request) {
  View view;
  if (!load_view(request, view) && !outline_view(request, view)) name_points(request, view);
  return view;
}

std::vector<std::string> View::warnings() const {
  std::vector<std::string> all;
  for (const auto* list : {&silhouette.warnings, &features.warnings})
    for (const std::string& warning : *list)
      if (std::find(all.begin(), all.end(), warning) == all.end()) all.push_back(warning);
  return all;
}

ViewRequest view_of(const ConvertRequest& request, Side side) {
  ViewRequest view;
  static_cast<GarmentChoice&>(view) = request;
  view.side = side;
  if (request.settings) view.max_side = request.settings->photo_side;
  const bool front_file = side == Side::front || request.mirror_back;
  view.photo = front_file ? request.front : request.back;
  view.mask = front_file ? request.front_mask : request.back_mask;
  if (side == Side::back) view.neckline = "auto";  // the back's neckline is its own: the choice is the front's
  return view;
}

}  // namespace vitrine
