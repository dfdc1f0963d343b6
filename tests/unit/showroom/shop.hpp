// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "vitrine/export.hpp"
#include "vitrine/showroom.hpp"

namespace vitrine {

namespace fs = std::filesystem;

inline std::string slurp(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// A catalogue and its site in a folder of their own, removed at the end.
class Shop {
 public:
  Shop() {
    char name[] = "/tmp/vitrine-showroom-XXXXXX";
    root = ::mkdtemp(name);
    fs::create_directories(root / "out");
    options.catalogue = (root / "out").string();
    options.out = (root / "site").string();
    options.assets = (root / "assets").string();
    // The pages are the product's; the scripts from npm are not needed to write a site.
    fs::create_directories(root / "assets/vendor");
    fs::copy(fs::path(VITRINE_SOURCE_DIR) / "showroom/web/app", root / "assets/app", fs::copy_options::recursive);
    fs::copy(fs::path(VITRINE_SOURCE_DIR) / "showroom/web/templates", root / "assets/templates",
             fs::copy_options::recursive);
  }
  ~Shop() {
    std::error_code failed;
    fs::remove_all(root, failed);
  }

  /// A square of cloth of one colour between two heights [m], before a body 1.7 m high.
  static Bytes model(double low, double high, std::array<std::uint8_t, 3> rgb, bool dressed) {
    RenderMesh cloth;
    cloth.name = "garment";
    cloth.positions = {{-0.2, low, 0.1}, {0.2, low, 0.1}, {0.2, high, 0.1}, {-0.2, high, 0.1}};
    cloth.normals.assign(4, Vec3(0, 0, 1));
    cloth.uv = {{0.1, 0.9}, {0.9, 0.9}, {0.9, 0.1}, {0.1, 0.1}};
    cloth.triangles = {{0, 1, 2}, {0, 2, 3}};
    cloth.texture = Image(64, 64, 3);
    for (std::size_t i = 0; i < cloth.texture.data.size(); ++i) cloth.texture.data[i] = rgb[i % 3];
    std::vector<RenderMesh> meshes{cloth};
    if (dressed) {
      RenderMesh body;
      body.name = "mannequin";
      body.positions = {{-0.2, 0, 0}, {0.2, 0, 0}, {0, 1.7, 0}};
      body.normals.assign(3, Vec3(0, 0, 1));
      body.triangles = {{0, 1, 2}};
      meshes.push_back(body);
    }
    return *encode_glb(meshes);
  }

  void look(const fs::path& folder, double low, double high, std::array<std::uint8_t, 3> rgb, double bust_mm) {
    fs::create_directories(folder);
    const auto put = [&](const char* name, const Bytes& bytes) { (void)write_file((folder / name).string(), bytes); };
    put("garment.glb", model(low, high, rgb, false));
    put("dressed.glb", model(low, high, rgb, true));
    put("preview.png", *encode_png(Image(288, 144, 3, 200)));
    const nlohmann::json report{
        {"fabric", {{"name", "jersey"}}},
        {"panels", {{"mm_per_pixel_front", 0.5}}},
        {"features",
         {{{"panel", "front"}, {"name", "armpit_left"}, {"x", 100}, {"y", 50}, {"confidence", 0.9}},
          {{"panel", "front"}, {"name", "armpit_right"}, {"x", 1000}, {"y", 50}, {"confidence", 0.9}}}},
        {"mannequin",
         {{"source", "built-in woman"},
          {"measurements_mm",
           {{"height", 1720},
            {"bust", bust_mm},
            {"under_bust", 750},
            {"waist", 680},
            {"hip", 940},
            {"inside_leg", 815},
            {"arm", 575},
            {"neck_base", 365}}}}}};
    std::ofstream(folder / "report.json") << report.dump();
  }

  /// A top, in its own folder; its line of the report.
  void item(const std::string& sku, const std::string& title, std::array<std::uint8_t, 3> rgb = {200, 30, 30},
            double low = 0.85, double high = 1.45) {
    look(root / "out" / sku, low, high, rgb, 880);
    line({{"sku", sku}, {"garment", "vest"}, {"title", title}, {"status", "ok"}, {"neckline", "neck_u"}});
  }

  void line(const nlohmann::json& json) {
    std::ofstream(root / "out/report.jsonl", std::ios::app) << json.dump() << "\n";
  }

  /// Names and contents of all files of the site.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(root / "site"))
      if (entry.is_regular_file()) all[fs::relative(entry.path(), root / "site").string()] = slurp(entry.path());
    return all;
  }

  fs::path root;
  ShowroomOptions options;
};

}  // namespace vitrine
