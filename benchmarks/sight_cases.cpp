// SPDX-License-Identifier: GPL-3.0-or-later
#include "sight_cases.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "noise.hpp"
#include "photo_maker.hpp"

namespace vitrine::sight {
namespace {

std::string swapped(std::string name) {
  const auto left = name.find("left"), right = name.find("right");
  if (left != std::string::npos)
    name.replace(left, 4, "right");
  else if (right != std::string::npos)
    name.replace(right, 5, "left");
  return name;
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, '\t');) out.push_back(cell);
  return out;
}

}  // namespace

std::vector<Case> marked_photos(const std::filesystem::path& folder) {
  std::ifstream index(folder / "index.tsv");
  std::vector<Case> cases;
  std::string line;
  std::getline(index, line);
  while (std::getline(index, line)) {
    const auto cell = cells(line);
    if (cell.size() < 5) continue;
    Case c;
    c.name = std::filesystem::path(cell[0]).stem().string();
    c.garment = cell[1] == "longsleeve" ? "long_sleeve" : cell[1];
    c.neckline = cell[2] == "none" ? "" : "neck_" + cell[2];
    std::transform(c.neckline.begin(), c.neckline.end(), c.neckline.begin(), [](char l) { return std::tolower(l); });
    c.back = cell[3] == "back";
    c.ground = cell[4];
    PhotoOptions options;
    options.mirror = c.back;
    const auto photo = load_photo((folder / cell[0]).string(), (folder / (c.name + ".mask.png")).string(), options);
    if (!photo) {
      std::fprintf(stderr, "%s\n", photo.error().message.c_str());
      continue;
    }
    c.photo = *photo;
    c.truth = c.photo.mask;
    c.photo.mask = {};
    const auto json = nlohmann::json::parse(std::ifstream(folder / (c.name + ".landmarks.json")));
    for (const auto& [key, at] : json["points"].items()) {
      Vec2 p(at[0].get<double>(), at[1].get<double>());
      p *= c.photo.scale;
      if (c.back) p.x() = c.photo.rgb.width - 1 - p.x();
      c.points[c.back ? swapped(key) : key] = p;
    }
    cases.push_back(std::move(c));
  }
  return cases;
}

Case variant(std::uint32_t seed) {
  using namespace support;
  static const GarmentKind kinds[] = {GarmentKind::vest, GarmentKind::long_sleeve, GarmentKind::skirt,
                                      GarmentKind::t_shirt, GarmentKind::dress};
  const GarmentKind kind = kinds[seed % std::size(kinds)];
  PhotoSpec spec = random_spec(seed, kind);
  Dice dice(seed * 7919u + 13u);
  // Contrast: the board's colour is drawn towards the garment's until the distance is the drawn one.
  const double wanted = dice.range(30, 160), now = contrast(spec);
  if (now > wanted)
    for (int k = 0; k < 3; ++k) spec.board[k] = spec.colour[k] + (spec.board[k] - spec.colour[k]) * wanted / now;
  spec.noise = dice.range(0.5, 8);
  spec.falloff = dice.range(0, 0.35);
  spec.tilt = dice.range(-20, 20);
  if (std::abs(spec.tilt) > 8) spec.fill = std::min(spec.fill, 0.78);
  const MadePhoto made = make_photo(spec);
  Case c;
  c.name = "variant-" + std::to_string(seed);
  c.garment = id_of(kind);
  c.neckline = kind == GarmentKind::skirt ? "" : id_of(spec.neck);
  c.ground = "generated";
  c.photo.path = c.name;
  c.photo.rgb = made.rgb;
  c.photo.source_width = made.rgb.width;
  c.photo.source_height = made.rgb.height;
  c.truth = made.labels;
  c.points = made.landmarks;
  return c;
}

}  // namespace vitrine::sight
