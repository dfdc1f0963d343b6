// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>

#include "item_options.hpp"

namespace vitrine::cli {
namespace {

struct ConvertArguments {
  PluginOptions plugins;
  MannequinOptions mannequin;
  JobOptions job;
  ItemOptions item;
  std::string out;
};

/// One line: what was asked, what is estimated, what was spent.
void tell_budget(const Budget& asked, const Conversion& item) {
  std::string what;
  if (asked.max_error > 0) what = fmt::format("{:g} mm", 1e3 * asked.max_error);
  if (asked.max_time > 0) what += fmt::format("{}{:g} s", what.empty() ? "" : " and ", asked.max_time);
  spdlog::info(
      "asked {}; estimated {:.2f} mm; spent {:.2f} s ({:.3g} units of work at {:.3g} a second), {} mesh levels", what,
      item.drape.error_estimate_mm.value_or(0), item.budget.spent_s, item.budget.work, asked.work_rate,
      item.drape.levels.size());
}

int run_convert(const ConvertArguments& arguments) {
  if (auto e = arguments.item.check()) return fail(*e);
  const auto registry = arguments.plugins.load();
  if (!registry) return fail(registry.error());
  auto asked = arguments.item.apply(*registry);
  if (!asked) return fail(asked.error());
  ConvertRequest request = *std::move(asked);
  if (auto e = arguments.job.apply(request)) return fail(*e);
  if (request.budget.asked() && (request.spring_k > 0 || request.node_mass > 0))
    return fail({Cause::usage, "USAGE",
                 "--spring-k and --node-mass belong to one mesh, which --max-error and --max-time choose",
                 "leave out either, and choose the mesh with --quality", ""});
  auto body = arguments.mannequin.make_body();
  if (!body) return fail(body.error());
  request.body = *body;
  request.progress = [last = std::string()](const std::string& stage, double) mutable {
    if (stage != last) spdlog::info("{} ...", stage);
    last = stage;
  };

  const Conversion item = convert(request);
  if (auto e = write_conversion(request, item, arguments.out)) return fail(*e);
  for (const std::string& warning : item.warnings) spdlog::warn("warning: {}", warning);
  if (item.error) return fail(*item.error);
  spdlog::info("{} as {}: residual {:.1e}, seam gap {:.2f} mm, penetration {:.2f} mm", arguments.out,
               request.garment.id, item.drape.residual, item.drape.seam_gap_mm_max, item.drape.penetration_mm_max);
  if (request.budget.asked()) tell_budget(request.budget, item);
  return 0;
}

}  // namespace

void add_convert(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("convert", "One item: two photos to garment.glb, dressed.glb, preview.png, report.json");
  auto a = std::make_shared<ConvertArguments>();
  a->item.add_to(*command, true);
  command->add_option("--out", a->out, "Output folder")->required();
  a->job.add_to(*command);
  a->mannequin.add_to(*command);
  a->plugins.add_to(*command);
  command->callback([a, &exit_code] { exit_code = run_convert(*a); });
}

}  // namespace vitrine::cli
