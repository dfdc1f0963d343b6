// SPDX-License-Identifier: GPL-3.0-or-later
#include <malloc.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <exception>
#include <iostream>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "common.hpp"

int main(int argc, char** argv) {
  using namespace vitrine;
  // One thread per item: the same bytes whatever the machine, and nothing to lose when a worker is forked.
  cv::setNumThreads(1);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
#ifdef __GLIBC__
  // Images and meshes come and go in every room. Given back to the system each time, their pages would be cleared anew.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // [bytes] no more is allowed
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
#endif

  CLI::App app("Garment photos to a 3D show room: a front and a back photo become a textured garment on a mannequin.",
               "vitrine");
  app.set_version_flag("--version", std::string("vitrine ") + VITRINE_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 64 wrong usage, 65 a photo or mesh cannot be used, 66 an input is missing, 69 plugin,\n"
      "70 internal error, 73 cannot write. catalog: 0, 1 some items are not ok, 64, 66, 73, 75 run again, 78 set-up.");
  bool quiet = false;
  app.add_flag("-q,--quiet", quiet, "Only errors on standard error");

  int exit_code = 0;
  cli::add_convert(app, exit_code);
  cli::add_catalog(app, exit_code);
  cli::add_features(app, exit_code);
  cli::add_mannequin(app, exit_code);
  cli::add_measure(app, exit_code);
  cli::add_plugin(app, exit_code);
  cli::add_showroom(app, exit_code);

  auto log = spdlog::stderr_color_mt("vitrine");
  log->set_pattern("%v");
  spdlog::set_default_logger(log);
  app.parse_complete_callback([&] {
    if (quiet) spdlog::set_level(spdlog::level::err);
  });

  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    app.exit(e);
    return static_cast<int>(Cause::usage);
  } catch (const std::bad_alloc&) {
    return cli::fail({Cause::internal, "OUT_OF_MEMORY", "the machine's memory does not suffice",
                      "use smaller photos or a lower --quality", ""});
  } catch (const std::exception& e) {
    return cli::fail(
        {Cause::internal, "INTERNAL", e.what(), "please report this with the command line and the photos", ""});
  }
}
