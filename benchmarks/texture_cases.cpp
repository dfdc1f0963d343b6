// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture_cases.hpp"

#include <algorithm>
#include <cmath>

#include "sample_items.hpp"

namespace vitrine::bench {
namespace {

double distance(const support::Rgb& a, const support::Rgb& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// A board that nobody would take for the garment: of a few bright papers the one furthest from all its colours.
support::Rgb loud_board(const support::PhotoSpec& spec) {
  const support::Rgb papers[] = {{232, 30, 190}, {40, 215, 60}, {250, 215, 20}, {30, 90, 240}};
  const auto away = [&](const support::Rgb& paper) {
    return std::min({distance(paper, spec.colour), distance(paper, spec.second), distance(paper, spec.trim)});
  };
  return *std::max_element(std::begin(papers), std::end(papers),
                           [&](const auto& a, const auto& b) { return away(a) < away(b); });
}

/// Less of the same light, before the camera's curve.
void dim(Image& rgb, double share) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const auto encoded = [](double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; };
  for (std::uint8_t& v : rgb.data) v = static_cast<std::uint8_t>(std::lround(255 * encoded(share * linear(v / 255.0))));
}

bool save(const Image& rgb, const std::string& path) {
  const auto bytes = support::to_jpeg(rgb, 92);
  return !write_file(path, std::span<const std::uint8_t>(bytes));
}

}  // namespace

std::vector<TextureCase> make_cases(Variant variant, const std::string& folder, const PluginRegistry& registry,
                                    const std::shared_ptr<const Body>& body) {
  std::vector<TextureCase> cases;
  for (const support::SampleItem& sample : support::sample_items()) {
    TextureCase c;
    c.name = sample.sku;
    c.front = sample.front;
    if (variant == Variant::loud_board) c.front.board = loud_board(c.front);
    support::MadePhoto back = support::make_photo(support::back_of(c.front));
    if (variant == Variant::darker_back) dim(back.rgb, 0.85);
    c.request.front = folder + "/" + c.name + "-front.jpg";
    c.request.back = folder + "/" + c.name + "-back.jpg";
    if (!save(support::make_photo(c.front).rgb, c.request.front) || !save(back.rgb, c.request.back)) return {};
    c.request.garment = *registry.find_garment(support::id_of(c.front.garment));
    c.request.necklines.assign(registry.necklines().begin(), registry.necklines().end());
    c.request.body = body;
    c.item = cut_and_mesh(c.request);
    cases.push_back(std::move(c));
  }
  return cases;
}

std::vector<TextureSource> sources_of(const TextureCase& c) {
  const Conversion& i = c.item;
  return {{&i.front.photo.rgb, &i.front.features.labels, &i.pattern.panels[0], &i.pattern.meshes[0]},
          {&i.back.photo.rgb, &i.back.features.labels, &i.pattern.panels[1], &i.pattern.meshes[1]}};
}

}  // namespace vitrine::bench
