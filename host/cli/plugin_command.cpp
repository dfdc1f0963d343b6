// SPDX-License-Identifier: GPL-3.0-or-later
#include <iomanip>
#include <iostream>

#include "common.hpp"
#include "plugin_commands.hpp"

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

}  // namespace

void add_plugin(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("plugin", "Garment and neckline plugins");
  command->require_subcommand(1);
  add_plugin_new(*command, exit_code);
  auto options = std::make_shared<PluginOptions>();
  auto* list = command->add_subcommand("list", "All garments and necklines, and every refused file with its reason");
  options->add_to(*list);
  list->callback([options, &exit_code] { exit_code = list_plugins(*options); });

  add_plugin_inspect(*command, exit_code);
  add_plugin_validate(*command, exit_code);
}

}  // namespace vitrine::cli
