// SPDX-License-Identifier: GPL-3.0-or-later
#include "showroom_command.hpp"

#include <spdlog/spdlog.h>

#include <csignal>
#include <cstdio>
#include <filesystem>

#include "common.hpp"
#include "vitrine/showroom.hpp"

namespace vitrine::cli {
namespace {

namespace fs = std::filesystem;

volatile std::sig_atomic_t stopped = 0;

struct ShowroomArguments {
  ShowroomOptions site;
  bool serve = false;
  int port = 0;
};

/// Beside the program, as plugins are: bin/../share/vitrine-1/showroom.
std::string assets_folder() {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  return (program.parent_path().parent_path() / "share/vitrine-1/showroom").string();
}

int serve(const std::string& site, int port) {
  std::signal(SIGINT, [](int) { stopped = 1; });
  std::signal(SIGTERM, [](int) { stopped = 1; });
  const auto served = serve_site(
      {site, port},
      [](int at) {
        std::printf("http://127.0.0.1:%d/\n", at);
        std::fflush(stdout);
        spdlog::info("Only this machine can see it; Ctrl-C ends it.");
      },
      [] { return stopped != 0; });
  return served ? 0 : fail(served.error());
}

int run(const ShowroomArguments& a) {
  if (a.serve && a.site.out.empty()) return serve(a.site.catalogue, a.port);
  if (a.site.out.empty())
    return fail({Cause::usage, "USAGE", "neither --out nor --serve is given",
                 "name the site's folder with --out, or look at a finished site with --serve", ""});
  if (const int code = write_showroom(a.site); code != 0) return code;
  return a.serve ? serve(a.site.out, a.port) : 0;
}

}  // namespace

int write_showroom(ShowroomOptions options) {
  if (options.assets.empty()) options.assets = assets_folder();
  const auto made = make_showroom(options);
  if (!made) return fail(made.error());
  for (const std::string& warning : made->warnings) spdlog::warn("warning: {}", warning);
  spdlog::info("show room: {} items on {} mannequins, {} tops and {} bottoms for outfits: {}", made->items,
               made->mannequins, made->outfit_tops, made->outfit_bottoms, options.out);
  return 0;
}

void add_showroom_options(CLI::App& app, ShowroomOptions& options) {
  app.add_option("--shop", options.title, "Name above the pages")->capture_default_str()->group("Show room");
  app.add_option("--language", options.language, "Language of the titles, as en or pt-BR")
      ->capture_default_str()
      ->group("Show room");
  app.add_option("--photo-root", options.photo_root, "Folder that the report's photo paths start from")
      ->group("Show room");
}

void add_showroom(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("showroom", "A static site of a finished catalogue, or a look at one");
  auto a = std::make_shared<ShowroomArguments>();
  command->add_option("folder", a->site.catalogue, "Output folder of vitrine catalog run; with --serve alone, a site")
      ->required();
  command->add_option("--out", a->site.out, "Folder of the site, made anew as a whole");
  command->add_flag("--serve", a->serve, "Show the site on this machine, http://127.0.0.1, until Ctrl-C");
  command->add_option("--port", a->port, "Port of --serve; 0 = a free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  add_showroom_options(*command, a->site);
  command->callback([a, &exit_code] { exit_code = run(*a); });
}

}  // namespace vitrine::cli
