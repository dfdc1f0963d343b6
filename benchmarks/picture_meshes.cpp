// SPDX-License-Identifier: GPL-3.0-or-later
// One panel of the sample catalogue meshed at the three qualities, side by side.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "vitrine/host/registry.hpp"
#include "vitrine/pipeline.hpp"

namespace vitrine {
namespace {

void require(const std::optional<Error>& error) {
  if (error) throw std::runtime_error(error->message);
}

Image beside(const std::vector<Image>& pictures) {
  int width = 0, height = 0;
  for (const Image& p : pictures) width += p.width, height = std::max(height, p.height);
  Image all(width, height, 3, 255);
  int left = 0;
  for (const Image& p : pictures) {
    for (int y = 0; y < p.height; ++y)
      std::memcpy(all.data.data() + 3 * (static_cast<std::size_t>(y) * width + left),
                  p.data.data() + 3 * static_cast<std::size_t>(y) * p.width, 3 * static_cast<std::size_t>(p.width));
    left += p.width;
  }
  return all;
}

void draw(const std::string& garment, const std::string& item, const std::string& out) {
  PluginSearch search;
  search.folders = {std::string(VITRINE_BINARY_DIR) + "/lib/vitrine-1/plugins"};
  search.built_in = false;
  const PluginRegistry registry = PluginRegistry::load(search);
  const GarmentTemplate* found = registry.find_garment(garment);
  if (!found) throw std::runtime_error("no such garment: " + garment);
  auto mannequin = build_mannequin({});
  if (!mannequin) require(mannequin.error());
  auto body = std::make_shared<Body>();
  body->mannequin = *std::move(mannequin);

  const std::string photo = std::string(VITRINE_SOURCE_DIR) + "/catalog/sample/" + item;
  ConvertRequest request;
  request.front = photo + "-front.jpg";
  request.back = photo + "-back.jpg";
  request.garment = *found;
  request.necklines = registry.necklines();
  request.body = body;
  std::vector<Image> pictures;
  for (const Quality quality : {Quality::draft, Quality::standard, Quality::fine}) {
    request.quality = quality;
    const Conversion made = cut_and_mesh(request);
    require(made.error);
    const MeshStats s = measure_mesh(made.pattern.meshes[0]);
    std::printf("%d nodes, smallest angle %.1f, edge CV %.3f\n", s.nodes, s.min_angle_deg, s.edge_cv);
    pictures.push_back(draw_mesh(made.pattern.meshes[0], 900));
  }
  const auto jpeg = encode_jpeg(beside(pictures), 80);
  if (!jpeg) require(jpeg.error());
  require(write_file(out, *jpeg));
}

}  // namespace
}  // namespace vitrine

int main(int argc, char** argv) {
  CLI::App app("Draws the front panel of a sample garment meshed at draft, standard and fine.");
  std::string garment = "vest", item = "vest-sailor", out = "docs/meshes.jpg";
  app.add_option("--garment", garment, "Garment of the built-in plugins");
  app.add_option("--item", item, "Item of the sample catalogue, without -front.jpg");
  app.add_option("--out", out, "JPEG to write");
  CLI11_PARSE(app, argc, argv);
  try {
    vitrine::draw(garment, item, out);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 70;
  }
}
