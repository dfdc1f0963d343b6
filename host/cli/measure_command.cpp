// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>

#include <filesystem>
#include <set>

#include "catalog_input.hpp"
#include "catalog_item.hpp"
#include "item_options.hpp"
#include "vitrine/accuracy.hpp"

namespace vitrine::cli {
namespace {

struct MeasureArguments {
  PluginOptions plugins;
  MannequinOptions mannequin;
  ItemOptions item;
  InputFlags input;
  MeasureOptions options;
  std::vector<std::string> inputs;
  std::string grid = "none";
  bool no_effects = false;
  double max_error_mm = 0;
};

MeasuredItem refused(const std::string& name, const std::string& source, const std::string& garment, Error error) {
  MeasuredItem item{name, source, {}, std::move(error)};
  item.request.garment.id = garment;
  return item;
}

MeasuredItem item_of(const CatalogItem& row, const std::string& source, const PluginRegistry& registry,
                     MannequinShelf& shelf, const std::string& mannequin) {
  if (row.refusal) return refused(row.sku, source, row.garment, *row.refusal);
  MeasuredItem item{row.sku, source, request_of(row), {}};
  if (auto e = choose_garment(registry, row.garment, row.neckline, item.request))
    return refused(row.sku, source, row.garment, *e);
  const auto body = shelf.make(row.mannequins.empty() ? mannequin : row.mannequins.front());
  if (!body) return refused(row.sku, source, row.garment, body.error());
  item.request.body = *body;
  return item;
}

/// The items of all inputs; one that cannot be read is an error as a whole.
Result<std::vector<MeasuredItem>> items_of(const MeasureArguments& a, const PluginRegistry& registry,
                                           MannequinShelf& shelf) {
  std::vector<MeasuredItem> items;
  std::set<std::string> names;
  for (const std::string& input : a.inputs) {
    const auto rows = read_items(input, a.input.options());
    if (!rows) return rows.error();
    const std::string source = std::filesystem::path(input).stem().string();
    for (const CatalogItem& row : *rows) {
      if (!names.insert(row.sku).second)
        return usage(input + ": " + row.sku + " is in an input before it too", "give each item a SKU of its own");
      items.push_back(item_of(row, source, registry, shelf, a.mannequin.file));
    }
  }
  return items;
}

int run_measure(MeasureArguments& a) {
  if (a.inputs.empty() == a.item.request.front.empty())
    return fail(usage(a.inputs.empty() ? "nothing to measure was named" : "--front and an input exclude each other",
                      "give a manifest, or --front, --back and --garment of one item"));
  if (a.inputs.empty()) {
    if (a.item.garment.empty()) return fail(usage("the garment type is missing", "give --garment with --front"));
    if (auto e = a.item.check()) return fail(*e);
  }
  const auto registry = a.plugins.load();
  if (!registry) return fail(registry.error());
  MannequinShelf shelf(a.mannequin);
  std::vector<MeasuredItem> items;
  if (a.inputs.empty()) {
    auto request = a.item.apply(*registry);
    if (!request) return fail(request.error());
    auto body = shelf.make(a.mannequin.file);
    if (!body) return fail(body.error());
    request->body = *body;
    items.push_back({a.item.request.name, "item", *std::move(request), {}});
  } else {
    auto read = items_of(a, *registry, shelf);
    if (!read) return fail(read.error());
    items = *std::move(read);
  }
  MeasureOptions& options = a.options;
  options.grid = a.grid == "full" ? Grid::full : a.grid == "short" ? Grid::shortened : Grid::none;
  options.effects = !a.no_effects;
  options.max_error = a.max_error_mm / 1000;
  options.version = std::string("vitrine ") + VITRINE_VERSION;
  options.say = [](const std::string& line) { spdlog::info("{}", line); };
  for (MeasuredItem& item : items) item.request.version = VITRINE_VERSION;
  const auto measurement = measure(items, options);
  if (!measurement) return fail(measurement.error());
  if (auto e = write_measurement(*measurement, options)) return fail(*e);
  bool compared = false;
  for (const SettingMeans& m : means_by_setting(measurement->runs)) {
    if (m.with_reference == 0) continue;
    compared = true;
    spdlog::info("{:<22} {:6.0f} nodes {:8.0f} ms  mean {:6.2f} mm  p95 {:6.1f} mm  ({} items)", m.setting, m.nodes,
                 m.cpu_ms, m.mean_mm, m.p95_mm, m.with_reference);
  }
  spdlog::info("{}/measure.md has it all", options.out_dir);
  if (compared) return 0;
  return fail({Cause::unusable, "NOTHING_MEASURED", "no item came as far as a reference",
               "see the status of each in " + options.out_dir + "/runs.csv", "measure"});
}

}  // namespace

void add_measure(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "measure", "What milliseconds buy in millimetres: one item or a manifest in many settings against a reference");
  auto a = std::make_shared<MeasureArguments>();
  command->add_option("inputs", a->inputs, "Manifests or other inputs that catalog run reads; none with --front");
  command->add_option("--out", a->options.out_dir, "Folder for tables and plots; keeps references from run to run")
      ->required();
  command
      ->add_option("--grid", a->grid, "Besides the three qualities, standard with one knob turned: none, short, full")
      ->check(CLI::IsMember({"none", "short", "full"}))
      ->capture_default_str();
  command->add_flag("--no-effects", a->no_effects, "Do not turn on what standard skips");
  command->add_option("--reference-nodes", a->options.reference_nodes, "Mesh of the reference, both panels")
      ->check(CLI::Range(100, 200'000))
      ->capture_default_str();
  command->add_option("--reference-residual", a->options.reference_residual, "Force residual of the reference")
      ->check(CLI::Range(1e-12, 1.0))
      ->capture_default_str();
  command
      ->add_option("--reference-steps", a->options.reference_iterations, "Most steps of the reference, on each level")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command->add_option("--max-error", a->max_error_mm, "Also convert with this error [mm] asked for: was it met?")
      ->check(CLI::Range(0.01, 1000.0));
  command->add_option("--jobs", a->options.jobs, "Items at a time")->check(CLI::Range(1, 256))->capture_default_str();
  a->item.add_to(*command, false);
  a->mannequin.add_to(*command);
  a->plugins.add_to(*command);
  a->input.add_to(*command);
  command->callback([a, &exit_code] { exit_code = run_measure(*a); });
}

}  // namespace vitrine::cli
