// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>

#include "catalog_input.hpp"
#include "common.hpp"
#include "vitrine/catalog.hpp"

namespace vitrine::cli {
namespace {

struct CatalogArguments {
  PluginOptions plugins;
  MannequinOptions mannequin;
  JobOptions job;
  CatalogOptions catalog;
  InputFlags input;
  std::string manifest;
};

/// What one item leaves in report.jsonl: enough to sort a night's work by, the rest is in the item's report.json.
std::string report_line(const Conversion& item) {
  nlohmann::ordered_json line = nlohmann::ordered_json::object();
  if (item.error)
    line = {{"code", item.error->code},
            {"message", item.error->message},
            {"remedy", item.error->remedy},
            {"stage", item.error->stage}};
  if (!item.drape.status.empty())
    line.update({{"neckline", item.front.features.neckline.id},
                 {"residual", item.drape.residual},
                 {"seam_gap_mm_max", item.drape.seam_gap_mm_max},
                 {"penetration_mm_max", item.drape.penetration_mm_max},
                 {"strain_p99", item.drape.strain_p99}});
  if (!item.warnings.empty()) line["warnings"] = item.warnings;
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

ItemOutcome refuse(const Error& error) {
  Conversion item;
  item.error = error;
  return {error.exit_code(), report_line(item)};
}

int run_catalog_command(const CatalogArguments& arguments) {
  ConvertRequest probe;
  if (auto e = arguments.job.apply(probe)) return fail(*e);
  const auto items = read_items(arguments.manifest, arguments.input.options());
  if (!items) return fail(items.error());
  const auto registry = arguments.plugins.load();
  if (!registry) return fail(registry.error());
  // Made once, before the workers are forked: they share these pages.
  spdlog::info("{} items; making the mannequin ...", items->size());
  const auto body = arguments.mannequin.make_body();
  if (!body) return fail(body.error());

  const auto convert_item = [&](const CatalogItem& row, const std::string& folder) -> ItemOutcome {
    if (row.refusal) return refuse(*row.refusal);
    ConvertRequest request;
    request.name = row.sku;
    request.front = row.front;
    request.back = row.back;
    request.front_mask = row.front_mask;
    request.back_mask = row.back_mask;
    request.mirror_back = row.mirror_back;
    request.fabric = row.fabric;
    request.chest = row.chest_cm.value_or(0) / 100;
    request.length = row.length_cm.value_or(0) / 100;
    request.body = *body;
    if (auto e = arguments.job.apply(request)) return refuse(*e);
    if (!row.copyright.empty()) request.copyright = row.copyright;
    if (auto e = choose_garment(*registry, row.garment, row.neckline, request)) return refuse(*e);
    const Conversion item = convert(request);
    if (auto e = write_conversion(request, item, folder)) return refuse(*e);
    return {item.exit_code(), report_line(item)};
  };
  const auto summary = run_catalog(*items, arguments.catalog, convert_item);
  if (!summary) return fail(summary.error());
  spdlog::info("{} of {} converted, {} refused, {} failed, {} crashed, {} timed out; report: {}", summary->ok,
               summary->total, summary->refused, summary->failed, summary->crashed, summary->timed_out,
               summary->report);
  return summary->exit_code;
}

}  // namespace

void add_catalog(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("catalog", "A whole catalogue");
  command->require_subcommand(1);
  add_catalog_input(*command, exit_code);
  auto* run =
      command->add_subcommand("run", "Convert every item of a manifest, feed or folder, each in a worker of its own");
  auto a = std::make_shared<CatalogArguments>();
  run->add_option("manifest", a->manifest, "Manifest, shop feed or folder of photos (docs/CATALOG.md)")->required();
  run->add_option("--out", a->catalog.out_dir, "Output folder; one folder per SKU and report.jsonl")->required();
  run->add_option("--jobs", a->catalog.jobs, "Workers at a time")->check(CLI::Range(1, 256))->capture_default_str();
  a->input.add_to(*run);
  a->job.add_to(*run);
  a->mannequin.add_to(*run);
  a->plugins.add_to(*run);
  run->callback([a, &app, &exit_code] {
    a->catalog.progress = app.get_option("--quiet")->count() == 0;
    exit_code = run_catalog_command(*a);
  });
}

}  // namespace vitrine::cli
