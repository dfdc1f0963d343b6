// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>

#include "common.hpp"

namespace vitrine::cli {
namespace {

struct ConvertArguments {
  PluginOptions plugins;
  MannequinOptions mannequin;
  JobOptions job;
  ConvertRequest request;
  std::string garment, neckline = "auto", out;
  double chest_cm = 0, length_cm = 0;
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
  ConvertRequest request = arguments.request;
  if (request.back.empty() && !request.mirror_back)
    return fail({Cause::usage, "USAGE", "a back photo is missing",
                 "give --back FILE, or --mirror-back when the shop has none", ""});
  if (!request.back.empty() && request.mirror_back)
    return fail({Cause::usage, "USAGE", "--back and --mirror-back exclude each other", "leave one out", ""});
  if (!request.back_mask.empty() && request.mirror_back)
    return fail({Cause::usage, "USAGE", "--back-mask and --mirror-back exclude each other", "leave one out", ""});
  const auto loaded = arguments.plugins.load();
  if (!loaded) return fail(loaded.error());
  const PluginRegistry& registry = *loaded;
  if (auto e = choose_garment(registry, arguments.garment, arguments.neckline, request)) return fail(*e);
  if (auto e = arguments.job.apply(request)) return fail(*e);
  if (request.budget.asked() && (request.spring_k > 0 || request.node_mass > 0))
    return fail({Cause::usage, "USAGE",
                 "--spring-k and --node-mass belong to one mesh, which --max-error and --max-time choose",
                 "leave out either, and choose the mesh with --quality", ""});
  request.chest = arguments.chest_cm / 100;
  request.length = arguments.length_cm / 100;
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
  command->add_option("--front", a->request.front, "Front photo")->required();
  command->add_option("--back", a->request.back, "Back photo");
  command->add_flag("--mirror-back", a->request.mirror_back, "Make the back from the mirrored front silhouette");
  command->add_option("--garment", a->garment, "Garment type (vitrine plugin list shows them)")->required();
  command->add_option("--neckline", a->neckline, "auto or the id of a neckline")->capture_default_str();
  command->add_option("--fabric", a->request.fabric, "One of the garment's fabrics; its first when left out");
  command
      ->add_option("--spring-k", a->request.spring_k,
                   "The paper's k [N/m] of every spring of the last mesh, in place of the fabric's sheet stiffness")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--node-mass", a->request.node_mass,
                   "The paper's m [kg] of every node of the last mesh, in place of the fabric's weight by area")
      ->check(CLI::PositiveNumber);
  command->add_option("--front-mask", a->request.front_mask,
                      "8-bit mask: 0 background, 128 inside of the back, 255 garment");
  command->add_option("--back-mask", a->request.back_mask, "The same for the back photo");
  command->add_option("--chest-cm", a->chest_cm, "Flat width, armpit to armpit (skirts: waist), in cm")
      ->check(CLI::Range(5.0, 300.0));
  command->add_option("--length-cm", a->length_cm, "Flat length from top to hem, in cm")->check(CLI::Range(5.0, 300.0));
  command->add_option("--name", a->request.name, "Name or SKU, kept in the files")->capture_default_str();
  command->add_option("--out", a->out, "Output folder")->required();
  a->job.add_to(*command);
  a->mannequin.add_to(*command);
  a->plugins.add_to(*command);
  command->callback([a, &exit_code] { exit_code = run_convert(*a); });
}

}  // namespace vitrine::cli
