// SPDX-License-Identifier: GPL-3.0-or-later
// What the photo on the garment is worth, measured on the test generator's photos: fidelity inside the panel, board
// that shows at an outline, the step of colour across sewn seams, and the price of a picture and of occlusion.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "texture_probe.hpp"

namespace vitrine::bench {
namespace {

struct BenchSettings {
  std::string folder, out;
  int size = 2048, quality = 0;
  bool pictures = true;
};

double seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// The atlas as a viewer gets it: out of the JPEG in the GLB that the pipeline would write.
Image through_file(const Atlas& atlas, std::size_t& bytes, int& quality) {
  // The same ladder as in the writer.
  const GlbOptions o;
  Bytes jpeg;
  if (quality > 0)
    jpeg = *encode_jpeg(atlas.rgb, quality);
  else
    for (quality = o.jpeg_quality;; quality = std::max(o.lowest_quality, quality - o.quality_step)) {
      jpeg = *encode_jpeg(atlas.rgb, quality);
      if (jpeg.size() <= o.texture_bytes || quality <= o.lowest_quality) break;
    }
  bytes = jpeg.size();
  const cv::Mat bgr = cv::imdecode(jpeg, cv::IMREAD_COLOR);
  Image rgb(bgr.cols, bgr.rows, 3);
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x)
      for (int c = 0; c < 3; ++c) rgb.at(x, y)[c] = bgr.at<cv::Vec3b>(y, x)[2 - c];
  return rgb;
}

void run(Variant variant, const char* title, const BenchSettings& s, const PluginRegistry& registry,
         const std::shared_ptr<const Body>& body) {
  std::printf("\n%s\n%-22s %9s %7s %4s %9s %9s %9s %9s %11s %8s %8s %7s\n", title, "item", "atlas", "kB", "q",
              "front dB", "back dB", "mask dB", "scale", "board", "dE point", "dE seam", "gain");
  std::vector<double> all, seams;
  for (const TextureCase& c : make_cases(variant, s.folder, registry, body)) {
    if (c.item.error) {
      std::printf("%-22s refused: %s\n", c.name.c_str(), c.item.error->message.c_str());
      continue;
    }
    const auto sources = sources_of(c);
    const auto atlas = make_atlas(sources, {.max_size = s.size});
    if (!atlas) {
      std::printf("%-22s %s\n", c.name.c_str(), atlas.error().message.c_str());
      continue;
    }
    std::size_t bytes = 0;
    int quality = s.quality;
    const Image shown = through_file(*atlas, bytes, quality);
    Fidelity f[2];
    BoardTexels board;
    for (int p : {0, 1}) {
      f[p] = measure_fidelity(sources[p], atlas->uv[p], shown, 6, atlas->panels[p].gain);
      const BoardTexels b = count_board(sources[p], atlas->uv[p], shown);
      board.near += b.near;
      board.wrong += b.wrong;
      board.worst = std::max(board.worst, b.worst);
    }
    const SeamSteps steps = seam_steps(c, atlas->uv, shown);
    all.insert(all.end(), steps.points.begin(), steps.points.end());
    seams.insert(seams.end(), steps.seams.begin(), steps.seams.end());
    std::printf("%-22s %4dx%4d %7.0f %4d %9.1f %9.1f %9.1f %9.2f %4d/%6d %8.2f %8.2f %7.3f\n", c.name.c_str(),
                shown.width, shown.height, static_cast<double>(bytes) / 1e3, quality, f[0].psnr, f[1].psnr,
                std::min(f[0].psnr_mask, f[1].psnr_mask), atlas->panels[0].scale, board.wrong, board.near,
                median_of(steps.points), median_of(steps.seams), atlas->panels[1].gain[1]);
    if (!s.out.empty())
      if (auto e = write_file(s.out + "/" + c.name + "-" + std::to_string(static_cast<int>(variant)) + ".png",
                              *encode_png(shown)))
        std::printf("%s\n", e->message.c_str());
  }
  std::printf("median dE across all seams: %.2f between points, %.2f between the sides of a seam\n", median_of(all),
              median_of(seams));
}

/// Processor seconds of a picture of 800 x 1,000 and of the occlusion, on whole standard items.
void time_pictures(const PluginRegistry& registry, const std::shared_ptr<const Body>& body, const BenchSettings& s) {
  std::printf("\nprocessor seconds\n%-22s %16s %16s %10s %10s\n", "item", "picture 800x1000", "occlusion", "garment kB",
              "dressed kB");
  for (TextureCase& c : make_cases(Variant::plain, s.folder, registry, body)) {
    c.request.texture.max_size = s.size;
    const Conversion item = convert(c.request);
    if (item.error) {
      std::printf("%-22s %s\n", c.name.c_str(), item.error->message.c_str());
      continue;
    }
    RenderMesh both[] = {item.garment, item.mannequin};
    PreviewOptions o;
    o.turns_deg = {0};
    o.view_width = 800;
    o.view_height = 1000;
    double picture = 1e9, occlusion = 1e9;
    for (int i = 0; i < 3; ++i) {
      double start = seconds();
      if (!render_preview(both, o)) return;
      picture = std::min(picture, seconds() - start);
      start = seconds();
      if (bake_occlusion(both[0], both[1])) return;
      occlusion = std::min(occlusion, seconds() - start);
    }
    std::printf("%-22s %16.2f %16.2f %10.0f %10.0f\n", c.name.c_str(), picture, occlusion,
                static_cast<double>(item.garment_glb.size()) / 1e3, static_cast<double>(item.dressed_glb.size()) / 1e3);
  }
}

/// Occlusion as a viewer reads it, in levels of 0 to 255, at a few places of each triangle.
std::vector<double> shown_occlusion(const RenderMesh& mesh) {
  std::vector<double> levels;
  const Image& picture = mesh.occlusion;
  for (const Triangle& t : mesh.triangles)
    for (const double w : {1.0 / 3, 0.8, 0.1}) {
      const Vec2 uv = w * mesh.uv[t[0]] + 0.5 * (1 - w) * (mesh.uv[t[1]] + mesh.uv[t[2]]);
      const double x = std::clamp(uv.x() * picture.width - 0.5, 0.0, picture.width - 1.001);
      const double y = std::clamp(uv.y() * picture.height - 0.5, 0.0, picture.height - 1.001);
      const int i = static_cast<int>(x), j = static_cast<int>(y);
      const double a = *picture.at(i, j) + (x - i) * (*picture.at(i + 1, j) - *picture.at(i, j));
      const double b = *picture.at(i, j + 1) + (x - i) * (*picture.at(i + 1, j + 1) - *picture.at(i, j + 1));
      levels.push_back(a + (y - j) * (b - a));
    }
  return levels;
}

/// What coarser occlusion and fewer rays cost and change, against 512 rays for each texel of 1.5 mm.
void trade_occlusion(const PluginRegistry& registry, const std::shared_ptr<const Body>& body, const BenchSettings& s) {
  std::printf("\nocclusion: processor seconds, and difference from 512 rays at 1.5 mm in levels of 0 to 255\n");
  std::printf("%-22s %9s %6s %9s %9s %9s %11s\n", "item", "texel mm", "rays", "seconds", "mean", "p99", "body mean");
  for (TextureCase& c : make_cases(Variant::plain, s.folder, registry, body)) {
    c.request.texture.max_size = s.size;
    const Conversion item = convert(c.request);
    if (item.error) continue;
    RenderMesh garment = item.garment, mannequin = item.mannequin;
    if (bake_occlusion(garment, mannequin, {.texel = 0.0015, .rays = 512})) return;
    const std::vector<double> wanted = shown_occlusion(garment);
    const std::vector<float> shade = mannequin.shade;
    for (const double texel : {0.003, 0.006, 0.012})
      for (const int rays : {16, 32, 64}) {
        const double start = seconds();
        if (bake_occlusion(garment, mannequin, {.texel = texel, .rays = rays})) return;
        const double spent = seconds() - start;
        std::vector<double> off = shown_occlusion(garment);
        double sum = 0, body_sum = 0;
        for (std::size_t i = 0; i < off.size(); ++i) sum += off[i] = std::abs(off[i] - wanted[i]);
        for (std::size_t v = 0; v < shade.size(); ++v) body_sum += 255 * std::abs(shade[v] - mannequin.shade[v]);
        std::sort(off.begin(), off.end());
        std::printf("%-22s %9.1f %6d %9.3f %9.2f %9.2f %11.2f\n", c.name.c_str(), 1e3 * texel, rays, spent,
                    sum / static_cast<double>(off.size()), off[off.size() * 99 / 100],
                    body_sum / static_cast<double>(shade.size()));
      }
  }
}

}  // namespace
}  // namespace vitrine::bench

int main(int argc, char** argv) {
  using namespace vitrine;
  using namespace vitrine::bench;
  cv::setNumThreads(1);
  CLI::App app("Texture fidelity, board at outlines, colour steps at seams, price of pictures");
  BenchSettings s;
  bool texture = true;
  app.add_option("--size", s.size, "Largest atlas [px]")->capture_default_str();
  app.add_option("--quality", s.quality, "JPEG quality; 0 = as the writer chooses")->capture_default_str();
  app.add_option("--atlases", s.out, "Folder to keep the atlases in");
  app.add_flag("!--no-pictures", s.pictures, "Leave out the times");
  app.add_flag("!--no-texture", texture, "Only the times");
  bool occlusion = false;
  app.add_flag("--occlusion", occlusion, "Also what coarser occlusion and fewer rays cost and change");
  CLI11_PARSE(app, argc, argv);
  PluginSearch search;
  search.folders = {std::string(VITRINE_BINARY_DIR) + "/lib/vitrine-1/plugins"};
  search.built_in = false;
  const PluginRegistry registry = PluginRegistry::load(search);
  auto body = std::make_shared<Body>();
  body->mannequin = *build_mannequin({});
  if (s.pictures || occlusion) body->field = *voxelise(body->mannequin.mesh);
  std::string pattern = (std::filesystem::temp_directory_path() / "vitrine_texture_XXXXXX").string();
  if (!::mkdtemp(pattern.data())) return 73;
  s.folder = pattern;
  if (texture) {
    run(Variant::plain, "as the sample catalogue", s, registry, body);
    run(Variant::loud_board, "on a loud board", s, registry, body);
    run(Variant::darker_back, "back photo with 15 % less light", s, registry, body);
  }
  if (s.pictures) time_pictures(registry, body, s);
  if (occlusion) trade_occlusion(registry, body, s);
  std::filesystem::remove_all(s.folder);
  return 0;
}
