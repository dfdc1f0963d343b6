// SPDX-License-Identifier: GPL-3.0-or-later
// vitrine-bench: figures of single rooms on inputs from files, and of the programs they are compared with. Run by hand.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "drape_bench.hpp"
#include "mesh_bench.hpp"

int main(int argc, char** argv) {
  CLI::App app("Measures Vitrine's rooms; times are processor time.");
  app.require_subcommand(1);
  const auto mesh = vitrine::bench::add_mesh_command(app);
  const auto peers = vitrine::bench::add_mesh_peers_command(app);
  const auto drape = vitrine::bench::add_drape_command(app);
  CLI11_PARSE(app, argc, argv);
  try {
    if (app.got_subcommand("drape")) return drape();
    return app.got_subcommand("mesh") ? mesh() : peers();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vitrine-bench: %s\n", error.what());
    return 66;
  }
}
