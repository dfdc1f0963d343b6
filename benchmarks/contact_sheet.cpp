// SPDX-License-Identifier: GPL-3.0-or-later
// Every real photo beside the pictures of what was made of it, on one sheet, to be looked at as a shop would.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "vitrine/host/registry.hpp"
#include "vitrine/pipeline.hpp"

namespace vitrine::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 240, kHeight = 300, kCaption = 22, kCells = 6;

struct Row {
  std::string name, garment, front, back;
};

/// Fronts of loaded garments in the folder's index.tsv (file, garment, neckline, view, ...), each with its back.
std::vector<Row> read_index(const fs::path& photos, const PluginRegistry& registry) {
  std::vector<Row> rows;
  std::ifstream index(photos / "index.tsv");
  for (std::string line; std::getline(index, line);) {
    std::istringstream fields(line);
    std::string file, garment, neckline, view;
    for (auto* field : {&file, &garment, &neckline, &view}) std::getline(fields, *field, '\t');
    if (garment == "longsleeve") garment = "long_sleeve";
    if (view != "front" || !registry.find_garment(garment)) continue;
    Row row{file.substr(0, file.find("-front")), garment, (photos / file).string(), ""};
    std::string back = file;
    back.replace(back.find("front"), 5, "back");
    if (fs::exists(photos / back)) row.back = (photos / back).string();
    rows.push_back(row);
  }
  return rows;
}

/// Puts a picture into a cell without cutting or stretching it.
void place(cv::Mat& sheet, const cv::Mat& picture, int column, int top) {
  if (picture.empty()) return;
  const double scale = std::min(1.0 * kWidth / picture.cols, 1.0 * kHeight / picture.rows);
  cv::Mat small;
  cv::resize(picture, small,
             {std::max(1, static_cast<int>(picture.cols * scale)), std::max(1, static_cast<int>(picture.rows * scale))},
             0, 0, cv::INTER_AREA);
  small.copyTo(sheet(
      cv::Rect(column * kWidth + (kWidth - small.cols) / 2, top + (kHeight - small.rows) / 2, small.cols, small.rows)));
}

cv::Mat draw_row(const Row& row, const Conversion& item) {
  cv::Mat strip(kHeight + kCaption, kCells * kWidth, CV_8UC3, cv::Scalar::all(255));
  place(strip, cv::imread(row.front), 0, kCaption);
  if (!row.back.empty()) place(strip, cv::imread(row.back), 1, kCaption);
  for (std::size_t i = 0; i < item.pictures.size(); ++i)
    place(strip, cv::imdecode(item.pictures[i].bytes, cv::IMREAD_COLOR), static_cast<int>(i) + 2, kCaption);
  std::string caption = row.name + (row.back.empty() ? "  (no back photo)" : "");
  if (item.error) caption += "  " + item.error->code;
  for (const std::string& warning : item.warnings) caption += "  " + warning.substr(0, warning.find(':'));
  cv::putText(strip, caption, {6, 15}, cv::FONT_HERSHEY_SIMPLEX, 0.42, cv::Scalar::all(0), 1, cv::LINE_AA);
  return strip;
}

int run(const std::string& photos, const std::string& out, Quality quality) {
  PluginSearch search;
  search.folders = {std::string(VITRINE_BINARY_DIR) + "/lib/vitrine-1/plugins"};
  search.built_in = false;
  const PluginRegistry registry = PluginRegistry::load(search);
  const std::vector<Row> rows = read_index(photos, registry);
  if (rows.empty()) {
    std::fprintf(stderr, "%s/index.tsv: no front photo of a loaded garment\n", photos.c_str());
    return 66;
  }
  auto body = std::make_shared<Body>();
  body->mannequin = *build_mannequin({});
  body->field = *voxelise(body->mannequin.mesh);
  std::vector<cv::Mat> strips;
  for (const Row& row : rows) {
    ConvertRequest request;
    request.name = row.name;
    request.front = row.front;
    request.back = row.back;
    request.mirror_back = row.back.empty();
    request.garment = *registry.find_garment(row.garment);
    request.necklines.assign(registry.necklines().begin(), registry.necklines().end());
    request.others.assign(registry.garments().begin(), registry.garments().end());
    request.quality = quality;
    request.body = body;
    request.pictures.views.assign(std::begin(view_names), std::end(view_names));
    request.pictures.format = PictureFormat::png;
    request.pictures.width = 2 * kWidth;
    request.pictures.height = 2 * kHeight;
    const Conversion item = convert(request);
    std::printf("%-16s %s\n", row.name.c_str(), item.error ? item.error->message.c_str() : "converted");
    strips.push_back(draw_row(row, item));
  }
  const int columns = 2, high = (static_cast<int>(strips.size()) + columns - 1) / columns;
  cv::Mat sheet(high * (kHeight + kCaption), columns * kCells * kWidth, CV_8UC3, cv::Scalar::all(255));
  for (std::size_t i = 0; i < strips.size(); ++i)
    strips[i].copyTo(
        sheet(cv::Rect(static_cast<int>(i) % columns * kCells * kWidth,
                       static_cast<int>(i) / columns * (kHeight + kCaption), strips[i].cols, strips[i].rows)));
  Bytes bytes;
  cv::imencode(".jpg", sheet, bytes, {cv::IMWRITE_JPEG_QUALITY, 90});
  if (auto e = write_file(out, bytes)) {
    std::fprintf(stderr, "%s\n", e->message.c_str());
    return e->exit_code();
  }
  return 0;
}

}  // namespace
}  // namespace vitrine::bench

int main(int argc, char** argv) {
  using namespace vitrine;
  cv::setNumThreads(1);
  CLI::App app("A contact sheet of real photos and what was made of them");
  std::string photos = std::string(VITRINE_SOURCE_DIR) + "/../shared/photos", out = "contact-sheet.jpg",
              quality = "standard";
  app.add_option("--photos", photos, "Folder with index.tsv")->capture_default_str();
  app.add_option("--out", out, "The sheet, a JPEG")->capture_default_str();
  app.add_option("--quality", quality, "draft, standard or fine")->check(CLI::IsMember({"draft", "standard", "fine"}));
  CLI11_PARSE(app, argc, argv);
  return bench::run(photos, out,
                    quality == "draft"  ? Quality::draft
                    : quality == "fine" ? Quality::fine
                                        : Quality::standard);
}
