// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "common.hpp"
#include "plugin_commands.hpp"
#include "vitrine/host/describe.hpp"

namespace vitrine::cli {
namespace {

struct InspectArguments {
  PluginOptions options;
  std::string id, svg, photo, png;
};

/// Writes the drawing, or prints it and nothing else.
template <class Template>
int show(const Template& table, const std::string& svg) {
  if (svg == "-") {
    std::cout << draw_svg(table);
    return 0;
  }
  std::cout << describe(table);
  if (!svg.empty())
    if (auto e = write_file(svg, draw_svg(table))) return fail(*e);
  return 0;
}

/// The template over a photo; a photo that was refused is drawn as far as it was seen, and the refusal is the answer.
int lay_over_photo(const InspectArguments& a, const PluginRegistry& registry) {
  ViewRequest request;
  if (auto e = choose_garment(registry, a.id, "auto", request)) return fail(*e);
  request.photo = a.photo;
  const View view = see(request);
  const Image picture = draw_template(request, view);
  if (!picture.empty()) {
    const auto png = encode_png(picture);
    if (!png) return fail(png.error());
    if (auto e = write_file(a.png, *png)) return fail(*e);
  }
  return view.error ? fail(*view.error) : 0;
}

int inspect_plugin(const InspectArguments& a) {
  if (a.photo.empty() != a.png.empty())
    return fail({Cause::usage, "USAGE", "--photo and --png belong together", "give both or none", ""});
  const auto registry = a.options.load();
  if (!registry) return fail(registry.error());
  if (const GarmentTemplate* garment = registry->find_garment(a.id)) {
    const int code = show(*garment, a.svg);
    return code != 0 || a.photo.empty() ? code : lay_over_photo(a, *registry);
  }
  if (const NecklineTemplate* neckline = registry->find_neckline(a.id)) {
    if (!a.photo.empty())
      return fail({Cause::usage, "USAGE", a.id + " is a neckline; --photo is for garments",
                   "vitrine features shows which neckline a photo has", ""});
    return show(*neckline, a.svg);
  }
  return fail(
      {Cause::plugin, "UNKNOWN_ID", "no plugin supplies \"" + a.id + "\"", "vitrine plugin list shows all ids", ""});
}

}  // namespace

void add_plugin_inspect(CLI::App& command, int& exit_code) {
  auto a = std::make_shared<InspectArguments>();
  auto* inspect = command.add_subcommand("inspect", "One garment's or neckline's tables");
  inspect->add_option("id", a->id, "Id of a garment or neckline")->required();
  inspect->add_option("--svg", a->svg,
                      "Also draw the template into this file; - for the drawing alone on standard output");
  inspect->add_option("--photo", a->photo, "A front photo to lay the garment's template over");
  inspect->add_option("--png", a->png,
                      "Picture of that: the template's points, search circles and edges, and what was found");
  a->options.add_to(*inspect);
  inspect->callback([a, &exit_code] { exit_code = inspect_plugin(*a); });
}

}  // namespace vitrine::cli
