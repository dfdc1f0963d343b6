// SPDX-License-Identifier: GPL-3.0-or-later
// The program in one page: the rooms in the order a photo passes them.
#include <algorithm>

#include "rooms.hpp"

namespace vitrine {

namespace {

void enter_seeing_rooms(Rooms& rooms) {
  rooms.enter("request", [&] { return rooms.check_request(); });
  rooms.enter("photo", [&] { return rooms.load_photos(); });
  rooms.enter("silhouette", [&] { return rooms.find_silhouettes(); });
  rooms.enter("features", [&] { return rooms.find_feature_points(); });
}

void enter_table_rooms(Rooms& rooms) {
  rooms.enter("panels", [&] { return rooms.cut_panels(); });
  rooms.enter("mesh", [&] { return rooms.mesh_levels(); });
}

void enter_sewing_rooms(Rooms& rooms) {
  rooms.enter("fit", [&] { return rooms.place(); });
  rooms.enter("sewing", [&] { return rooms.sew(); });
}

}  // namespace

Conversion cut_and_mesh(const ConvertRequest& request) {
  Conversion item;
  Rooms rooms(request, item);
  enter_seeing_rooms(rooms);
  enter_table_rooms(rooms);
  return item;
}

Conversion cut_and_sew(const ConvertRequest& request) {
  Conversion item;
  Rooms rooms(request, item);
  enter_seeing_rooms(rooms);
  enter_table_rooms(rooms);
  enter_sewing_rooms(rooms);
  rooms.enter("sewing", [&] { return rooms.judge_drape(); });
  return item;
}

std::vector<FabricDrape> cut_and_sew_fabrics(const ConvertRequest& request, std::size_t most, Conversion& item) {
  Rooms rooms(request, item);
  enter_seeing_rooms(rooms);
  enter_table_rooms(rooms);
  rooms.enter("fit", [&] { return rooms.place(); });
  std::vector<FabricDrape> drapes;
  if (item.error) return drapes;
  for (std::size_t i = 0; i < std::min(most, request.garment.fabrics.size()); ++i) {
    item.fabric = request.garment.fabrics[i];
    rooms.enter("sewing", [&] { return rooms.sew(); });
    rooms.enter("sewing", [&] { return rooms.judge_drape(); });
    drapes.push_back({item.fabric.name, std::move(item.drape), item.error});
    item.drape = {};
    item.error.reset();
  }
  return drapes;
}

Conversion see_photos(const ConvertRequest& request) {
  Conversion item;
  Rooms rooms(request, item);
  enter_seeing_rooms(rooms);
  return item;
}

/// The mannequin room is not on this list: its body and voxels are made once and shared by every item (request.body).
Conversion convert(const ConvertRequest& request) {
  return dress(see_photos(request), request);
}

Conversion dress(Conversion item, const ConvertRequest& request) {
  Rooms rooms(request, item);
  enter_table_rooms(rooms);
  enter_sewing_rooms(rooms);
  rooms.enter("texture", [&] { return rooms.texture(); });
  rooms.enter("export", [&] { return rooms.write_glb(); });
  rooms.enter("export", [&] { return rooms.check_for_shops(); });
  rooms.enter("preview", [&] { return rooms.take_pictures(); });
  rooms.enter("sewing", [&] { return rooms.judge_drape(); });
  return item;
}

}  // namespace vitrine
