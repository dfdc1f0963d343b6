// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>

#include "vitrine/accuracy.hpp"

namespace vitrine {
namespace {

std::string text(const char* format, double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

class List {
 public:
  explicit List(Grid grid) : grid_(grid) {}

  /// `in_short`: also in the short grid.
  template <class Turn>
  void add(const std::string& knob, const std::string& value, bool in_short, Turn&& turn) {
    if (grid_ == Grid::none || (grid_ == Grid::shortened && !in_short)) return;
    Setting setting{knob + "=" + value, knob, value, settings_of(Quality::standard), 0};
    turn(setting);
    settings.push_back(std::move(setting));
  }

  std::vector<Setting> settings;

 private:
  const Grid grid_;
};

}  // namespace

std::vector<int> levels_up_to(const std::vector<int>& coarser, int nodes) {
  std::vector<int> levels;
  for (const int n : coarser)
    if (n < 0.6 * nodes) levels.push_back(n);
  levels.push_back(nodes);
  return levels;
}

std::vector<Setting> settings_to_measure(Grid grid) {
  List list(grid);
  for (const auto& [name, quality] :
       {std::pair{"draft", Quality::draft}, {"standard", Quality::standard}, {"fine", Quality::fine}})
    list.settings.push_back({name, "", "", settings_of(quality), 0});

  const std::vector<int> fine = settings_of(Quality::fine).level_nodes;
  for (const int nodes : {600, 1000, 4000, 8000})
    list.add("nodes", std::to_string(nodes), nodes == 1000 || nodes == 4000,
             [&](Setting& s) { s.settings.level_nodes = levels_up_to(fine, nodes); });
  for (const double residual : {3e-2, 1e-2, 3e-3, 3e-4, 1e-4})
    list.add("residual", text("%.0e", residual), residual == 1e-2 || residual == 1e-4,
             [&](Setting& s) { s.settings.residual = residual; });
  for (const double millimetres : {4.0, 9.0, 12.0})
    list.add("voxel_mm", text("%.0f", millimetres), millimetres == 12,
             [&](Setting& s) { s.voxel = millimetres / 1000; });
  for (const double strain : {1e-2, 3e-3, 3e-4})
    list.add("weight_strain", text("%.0e", strain), strain == 1e-2,
             [&](Setting& s) { s.settings.max_weight_strain = strain; });
  list.add("weight_strain", "uncapped", false, [](Setting& s) { s.settings.max_weight_strain = 0; });
  for (const int side : {600, 1200})
    list.add("photo_px", std::to_string(side), side == 600, [&](Setting& s) { s.settings.photo_side = side; });
  list.add("bending", "off", true, [](Setting& s) { s.settings.bending = false; });
  list.add("friction", "off", true, [](Setting& s) { s.settings.friction = false; });
  list.add("front_back", "never", false, [](Setting& s) { s.settings.front_back = FrontBack::never; });
  list.add("front_back", "always", true, [](Setting& s) { s.settings.front_back = FrontBack::always; });
  list.add("between_nodes", "everywhere", true, [](Setting& s) { s.settings.contact_between_nodes = true; });
  return list.settings;
}

}  // namespace vitrine
