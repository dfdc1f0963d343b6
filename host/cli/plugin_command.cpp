// SPDX-License-Identifier: GPL-3.0-or-later
#include <iomanip>
#include <iostream>

#include "common.hpp"
#include "plugin_commands.hpp"
#include "vitrine/host/describe.hpp"

namespace vitrine::cli {
namespace {

int list_plugins(const PluginOptions& options) {
  const PluginRegistry registry = PluginRegistry::load(options.search());
  std::cout << std::left;
  for (const GarmentTemplate& g : registry.garments())
    std::cout << std::setw(14) << g.id << "garment   " << std::setw(28) << g.title << g.plugin << ' ' << g.version
              << '\n';
  for (const NecklineTemplate& n : registry.necklines())
    std::cout << std::setw(14) << n.id << "neckline  " << std::setw(28) << n.title << n.plugin << ' ' << n.version
              << '\n';
  for (const RejectedPlugin& r : registry.rejected())
    std::cout << "refused: " << r.file << ": " << r.error.message << " [" << r.error.code << "] " << r.error.remedy
              << '\n';
  if (auto problem = registry.problem()) return fail(*problem);
  if (registry.garments().empty() && registry.necklines().empty())
    return fail({Cause::plugin, "NO_PLUGINS", "no plugin was found",
                 "give --plugin-dir, or install the built-in plugins beside the program", ""});
  return 0;
}

int inspect_plugin(const PluginOptions& options, const std::string& id, const std::string& svg) {
  const auto registry = options.load();
  if (!registry) return fail(registry.error());
  if (const GarmentTemplate* garment = registry->find_garment(id)) {
    if (svg == "-") {
      std::cout << draw_svg(*garment);
      return 0;
    }
    std::cout << describe(*garment);
    if (!svg.empty())
      if (auto e = write_file(svg, draw_svg(*garment))) return fail(*e);
    return 0;
  }
  if (const NecklineTemplate* neckline = registry->find_neckline(id)) {
    if (!svg.empty())
      return fail({Cause::usage, "USAGE", id + " is a neckline; --svg draws garments", "leave out --svg", ""});
    std::cout << describe(*neckline);
    return 0;
  }
  return fail(
      {Cause::plugin, "UNKNOWN_ID", "no plugin supplies \"" + id + "\"", "vitrine plugin list shows all ids", ""});
}

}  // namespace

void add_plugin(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("plugin", "Garment and neckline plugins");
  command->require_subcommand(1);
  auto options = std::make_shared<PluginOptions>();
  auto* list = command->add_subcommand("list", "All garments and necklines, and every refused file with its reason");
  options->add_to(*list);
  list->callback([options, &exit_code] { exit_code = list_plugins(*options); });

  struct Inspect {
    PluginOptions options;
    std::string id, svg;
  };
  auto a = std::make_shared<Inspect>();
  auto* inspect = command->add_subcommand("inspect", "One garment's or neckline's tables");
  inspect->add_option("id", a->id, "Id of a garment or neckline")->required();
  inspect->add_option("--svg", a->svg, "Also draw the template with its seams into this file; - for standard output");
  a->options.add_to(*inspect);
  inspect->callback([a, &exit_code] { exit_code = inspect_plugin(a->options, a->id, a->svg); });

  add_plugin_validate(*command, exit_code);
}

}  // namespace vitrine::cli
