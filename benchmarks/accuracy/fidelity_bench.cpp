// SPDX-License-Identifier: GPL-3.0-or-later
// vitrine-fidelity-bench: does the dressed garment look like its photo? Every front of a folder of marked photos is
// dressed, seen from the photo's camera and laid over the photo's silhouette. Run by hand; never part of a test.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "../marked_photos.hpp"
#include "vitrine/fidelity.hpp"
#include "vitrine/host/registry.hpp"
#include "vitrine/pipeline.hpp"

namespace {

using namespace vitrine;
namespace fs = std::filesystem;

using bench::Item;
using bench::marked_photos;
using bench::must;

/// The silhouette that was marked by hand, turned as the photo was; empty where its size is another.
Image marked_labels(const Item& item, const Photo& photo) {
  PhotoOptions options;
  options.max_side = std::max(photo.rgb.width, photo.rgb.height);
  const auto marked = load_photo(item.front, item.mask, options);
  if (!marked) return {};
  const Image labels = turned(marked->mask, photo.quarter_turns);
  return labels.width == photo.rgb.width && labels.height == photo.rgb.height ? labels : Image{};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("The dressed garment against the silhouette of its photo", "vitrine-fidelity-bench");
  std::string photos, csv, pictures, quality = "standard", only, who = "woman-m";
  int rows = 512;
  app.add_option("--photos", photos, "Folder of marked photos with index.tsv")->required();
  app.add_option("--mannequin", who, "Preset or mesh file")->capture_default_str();
  app.add_option("--quality", quality, "draft, standard or fine")->capture_default_str();
  app.add_option("--rows", rows, "Height of the pictures compared [px]")->capture_default_str();
  app.add_option("--only", only, "Only items whose name contains this");
  app.add_option("--csv", csv, "Write one row for each item");
  app.add_option("--pictures", pictures, "Folder for both silhouettes over each other, a PNG for each item");
  CLI11_PARSE(app, argc, argv);

  PluginSearch search;
  search.folders = {std::string(VITRINE_BINARY_DIR) + "/lib/vitrine-1/plugins"};
  search.built_in = false;
  const PluginRegistry registry = PluginRegistry::load(search);
  std::ofstream out;
  if (!csv.empty()) out.open(csv);
  out << "item,garment,status,iou_posed,turn_deg,leg_swing,iou,iou_marked,iou_uniform,iou_true_size,width,height,"
         "uniform_scale,landmark_mean_mm,landmark_max_mm,worst_landmark\n";
  double sum = 0, as_it_lies_sum = 0, marked_sum = 0, miss_sum = 0;
  int count = 0;
  try {
    auto body = std::make_shared<Body>();
    const auto preset = preset_measurements(who);
    body->mannequin = must(preset ? build_mannequin(*preset) : import_mannequin(who));
    body->field = must(voxelise(body->mannequin.mesh));
    if (!pictures.empty()) fs::create_directories(pictures);
    for (const Item& item : marked_photos(photos, registry)) {
      if (item.name.find(only) == std::string::npos) continue;
      ConvertRequest request;
      request.name = item.name;
      request.front = item.front;
      request.back = item.back;
      request.mirror_back = item.back.empty();
      request.garment = *registry.find_garment(item.garment);
      request.necklines = registry.necklines();
      request.quality = quality == "draft" ? Quality::draft : quality == "fine" ? Quality::fine : Quality::standard;
      request.body = body;
      const Conversion made = cut_and_sew(request);
      const std::string status = made.error ? made.error->code : made.drape.status;
      if (made.drape.positions.empty()) {
        std::printf("%-14s refused: %s\n", item.name.c_str(), status.c_str());
        out << item.name << ',' << item.garment << ',' << status << ",,,,,,,,,,,,,\n";
        continue;
      }
      FidelityOptions options;
      options.rows = rows;
      const auto compare = [&](const Image& labels) {
        return compare_with_photo(labels, request.garment, made.pattern, made.drape.positions, options);
      };
      const Fidelity f = must(compare(made.front.features.labels));
      const Image labels = marked_labels(item, made.front.photo);
      const double marked = labels.empty() ? 0 : must(compare(labels)).iou_posed;
      const LandmarkMiss* worst = nullptr;
      for (const LandmarkMiss& miss : f.landmarks)
        if (!worst || miss.miss_mm > worst->miss_mm) worst = &miss;
      char row[300];
      std::snprintf(row, sizeof row, "%s,%s,%s,%.4f,%.2f,%.3f,%.4f,%.4f,%.4f,%.4f,%.3f,%.3f,%.3f,%.1f,%.1f,%s\n",
                    item.name.c_str(), item.garment.c_str(), status.c_str(), f.iou_posed,
                    f.camera_turn * 180 / std::numbers::pi, f.leg_swing, f.iou, marked, f.iou_uniform, f.iou_true_size,
                    f.fit.width, f.fit.height, f.uniform_scale, f.landmark_mean_mm, f.landmark_max_mm,
                    worst ? worst->name.c_str() : "");
      out << row;
      std::printf("%s", row);
      std::fflush(stdout);
      sum += f.iou_posed;
      as_it_lies_sum += f.iou;
      marked_sum += marked;
      miss_sum += f.landmark_mean_mm;
      ++count;
      if (pictures.empty()) continue;
      const Bytes png = must(encode_png(draw_fidelity(f)));
      std::ofstream file(fs::path(pictures) / (item.name + ".png"), std::ios::binary);
      file.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vitrine-fidelity-bench: %s\n", error.what());
    return 66;
  }
  if (count == 0) return 66;
  std::printf("%d items: mean IoU %.4f (as it lies %.4f, with the marked silhouettes %.4f), points %.1f mm off\n",
              count, sum / count, as_it_lies_sum / count, marked_sum / count, miss_sum / count);
  return sum / count >= 0.90 ? 0 : 1;
}
