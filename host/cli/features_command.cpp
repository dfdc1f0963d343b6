// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>

#include <filesystem>

#include "common.hpp"

namespace vitrine::cli {
namespace {

struct FeaturesArguments {
  PluginOptions plugins;
  std::string front, back, front_mask, back_mask;
  std::string garment, neckline = "auto", mask, overlay;
  bool json = false;
};

std::optional<Error> check_arguments(const FeaturesArguments& a) {
  if (a.front.empty() == a.back.empty())
    return usage(a.front.empty() ? "a photo is missing" : "--front and --back exclude each other",
                 "give one of them; run the command once for each photo");
  if (!(a.front.empty() ? a.front_mask : a.back_mask).empty())
    return usage("the mask is for the other side's photo", "give --front-mask with --front, --back-mask with --back");
  const auto same = [](const std::string& x, const std::string& y) {
    std::error_code failed;
    return !x.empty() && !y.empty() && (x == y || std::filesystem::equivalent(x, y, failed));
  };
  for (const std::string* output : {&a.mask, &a.overlay})
    for (const std::string* input : {&a.front, &a.back, &a.front_mask, &a.back_mask})
      if (same(*output, *input)) return usage(*output + ": this would overwrite an input", "name another output file");
  if (same(a.mask, a.overlay)) return usage("--mask and --overlay name the same file", "name two files");
  return std::nullopt;
}

/// Writes one picture; a photo that was refused before there was one must not leave an earlier run's.
std::optional<Error> write_picture(const std::string& path, const Image& image) {
  if (path.empty()) return std::nullopt;
  if (image.empty()) {
    std::error_code failed;
    if (std::filesystem::is_regular_file(path, failed)) std::filesystem::remove(path, failed);
    return std::nullopt;
  }
  const auto png = encode_png(image);
  if (!png) return png.error();
  return write_file(path, *png);
}

int run_features(const FeaturesArguments& a) {
  if (auto e = check_arguments(a)) return fail(*e);
  ViewRequest request;
  request.side = a.front.empty() ? Side::back : Side::front;
  request.photo = a.front.empty() ? a.back : a.front;
  request.mask = a.front.empty() ? a.back_mask : a.front_mask;
  request.garment.id = a.garment;

  View view;
  const auto registry = a.plugins.load();
  if (!registry)
    view.error = registry.error();
  else if (auto e = choose_garment(*registry, a.garment, a.neckline, request))
    view.error = e;
  else
    view = see(request);

  if (auto e = write_picture(a.mask, mask_as_given(view))) view.error = e;
  if (!a.overlay.empty())
    if (auto e = write_picture(a.overlay, draw_view(request, view))) view.error = e;
  if (a.json || !view.error)
    if (auto e = print(a.json ? view_json(request, view) : view_table(request, view))) return fail(*e);
  for (const std::string& warning : view.warnings()) spdlog::warn("warning: {}", warning);
  return view.error ? fail(*view.error) : 0;
}

}  // namespace

void add_features(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("features", "One photo: its silhouette and feature points, to look at or as JSON");
  auto a = std::make_shared<FeaturesArguments>();
  command->add_option("--front", a->front, "Front photo");
  command->add_option("--back", a->back, "Back photo, instead of --front");
  command->add_option("--garment", a->garment, "Garment type (vitrine plugin list shows them)")->required();
  command->add_option("--neckline", a->neckline, "auto or the id of a neckline")->capture_default_str();
  command->add_option("--front-mask", a->front_mask, "8-bit mask: 0 background, 128 inside of the back, 255 garment");
  command->add_option("--back-mask", a->back_mask, "The same for the back photo");
  command->add_flag("--json", a->json, "JSON on standard output, in pixels of the photo as given");
  command->add_option("--mask", a->mask, "Write the three-label mask (0, 128, 255) as PNG in the photo's size");
  command->add_option("--overlay", a->overlay, "Write a PNG to look at: outline, inside, named points");
  a->plugins.add_to(*command);
  command->callback([a, &exit_code] { exit_code = run_features(*a); });
}

}  // namespace vitrine::cli
