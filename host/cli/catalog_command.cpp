// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdio>
#include <set>

#include "catalog_input.hpp"
#include "catalog_item.hpp"
#include "common.hpp"
#include "showroom_command.hpp"
#include "vitrine/catalog.hpp"
#include "vitrine/run_catalog.hpp"

namespace vitrine::cli {
namespace {

struct CatalogArguments {
  PluginOptions plugins;
  MannequinOptions mannequin;
  JobOptions job;
  CatalogOptions catalog;
  InputFlags input;
  std::string manifest, shard, item_memory = "4G", progress = "auto", fail_on = "any";
  std::vector<std::string> mannequins;
  ShowroomOptions showroom;  ///< no site when `out` is empty
};

struct MergeArguments {
  std::vector<std::string> folders;
  std::string out, fail_on = "any";
};

/// A catalogue's exit codes are for schedulers: an item's reason is the item's, in the report, and what keeps all items
/// from being made is a mistake in the set-up.
int fail_run(Error error) {
  if (error.cause == Cause::unusable || error.cause == Cause::plugin || error.cause == Cause::internal)
    error.cause = Cause::setup;
  return fail(error);
}

std::optional<Error> read_fail_on(const std::string& text, double& share) {
  if (text == "any" || text == "never") {
    share = text == "any" ? 0 : 1;
    return std::nullopt;
  }
  double percent = 0;
  int end = 0;
  if (std::sscanf(text.c_str(), "%lf%%%n", &percent, &end) != 1 || end != static_cast<int>(text.size()) ||
      !(percent >= 0 && percent <= 100))
    return usage("--fail-on " + text + ": neither any, never nor a share", "give for example 5%");
  share = percent / 100;
  return std::nullopt;
}

std::optional<Error> read_shard(const std::string& text, CatalogOptions& options) {
  int end = 0;
  if (std::sscanf(text.c_str(), "%d/%d%n", &options.shard, &options.shards, &end) != 2 ||
      end != static_cast<int>(text.size()))
    return usage("--shard " + text + ": not of the form i/n", "give for example 0/8 for the first of eight shards");
  return std::nullopt;
}

std::optional<Error> read_memory(const std::string& text, std::uint64_t& bytes) {
  double number = 0;
  char unit = 0;
  const int got = std::sscanf(text.c_str(), "%lf%c", &number, &unit);
  const double factor = unit == 'G' ? 0x1p30 : unit == 'M' ? 0x1p20 : 0;
  if (text == "0") {
    bytes = 0;
    return std::nullopt;
  }
  if (got != 2 || text.back() != unit || factor == 0 || !(number > 0) || number * factor > 0x1p50)
    return usage("--item-memory " + text + " is no amount of memory", "give for example 500M or 4G, or 0 for no limit");
  bytes = static_cast<std::uint64_t>(number * factor);
  return std::nullopt;
}

std::string plugins_text(const PluginRegistry& registry) {
  std::string text;
  for (const PluginIdentity& plugin : registry.plugins())
    text += plugin.id + " " + plugin.version + " " + hash_of_file(plugin.file) + "\n";
  return text;
}

/// All options of the command that decide an item's bytes, with their values: every one but those that are known not
/// to, so that an option that is new makes items anew.
std::string settings_text(const CLI::App& command) {
  static const std::set<std::string> how_to_run{"Run", "Limits", "Plugins", "Mannequin", "Input", "Show room"};
  static const std::set<std::string> others{"manifest", "--out", "--jobs", "--help"};
  std::string text;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (how_to_run.count(option->get_group()) > 0 || others.count(name) > 0) continue;
    text += name;
    for (const std::string& value : option->results()) text += " " + value;
    if (option->results().empty()) text += " " + option->get_default_str();
    text += "\n";
  }
  return text;
}

int run_catalog_command(CatalogArguments& arguments, const std::string& settings) {
  ConvertRequest probe;
  CatalogOptions& options = arguments.catalog;
  if (auto e = arguments.job.apply(probe)) return fail(*e);
  if (auto e = read_fail_on(arguments.fail_on, options.fail_share)) return fail(*e);
  if (auto e = read_memory(arguments.item_memory, options.item_memory)) return fail(*e);
  if (!arguments.shard.empty())
    if (auto e = read_shard(arguments.shard, options)) return fail(*e);
  if (!arguments.mannequins.empty() && !arguments.mannequin.file.empty())
    return fail(usage("--mannequin and --mannequins exclude each other", "leave one out"));
  if (auto e = MannequinShelf::check_run(arguments.mannequins)) return fail(*e);
  if (!arguments.showroom.out.empty() && options.shards > 1)
    return fail(usage("--showroom needs the whole catalogue, not a shard of it",
                      "merge the shards, then run vitrine showroom"));

  const auto items = read_items(arguments.manifest, arguments.input.options());
  if (!items) return fail_run(items.error());
  std::set<std::string> different(arguments.mannequins.begin(), arguments.mannequins.end());
  for (const CatalogItem& item : *items) different.insert(item.mannequins.begin(), item.mannequins.end());
  if (different.size() > MannequinShelf::most)
    return fail({Cause::setup, "MANNEQUINS", std::to_string(different.size()) + " different mannequins in one run",
                 "use at most " + std::to_string(MannequinShelf::most) + "; split the manifest", ""});
  const auto registry = arguments.plugins.load();
  if (!registry) return fail_run(registry.error());

  MannequinShelf shelf(arguments.mannequin);
  const bool size_run = !arguments.mannequins.empty();
  const ItemKitchen kitchen{*registry, arguments.job, shelf,
                            size_run ? arguments.mannequins : std::vector<std::string>{arguments.mannequin.file},
                            settings};
  // A program that was built anew is another program, whatever its version says.
  options.identity.engine = std::string("vitrine ") + VITRINE_VERSION + " " + hash_of_file("/proc/self/exe");
  options.identity.plugins = plugins_text(*registry);
  options.identity.settings = [&](const CatalogItem& row) { return kitchen.settings_of(row); };
  options.prepare = [&](const CatalogItem& row) { return kitchen.prepare(row); };
  spdlog::info("{} items{}", items->size(), options.shards > 1 ? ", shard " + arguments.shard : std::string());
  const auto summary = run_catalog(*items, options, [&](const CatalogItem& row, const std::string& folder) {
    return kitchen.convert_item(row, folder);
  });
  if (!summary) return fail_run(summary.error());
  spdlog::info(
      "{} of {} ok ({} unchanged), {} partly, {} refused, {} failed, {} crashed, {} timed out, {} not run; report: {}",
      summary->ok, summary->total, summary->unchanged, summary->partly, summary->refused, summary->failed,
      summary->crashed, summary->timed_out, summary->not_run, summary->report);
  // What is finished can be shown, whatever was refused; an interrupted run, or one shard of several, is not the
  // catalogue.
  if (arguments.showroom.out.empty() || summary->exit_code == static_cast<int>(Cause::temporary))
    return summary->exit_code;
  arguments.showroom.catalogue = options.out_dir;
  const int shown = write_showroom(arguments.showroom);
  return summary->exit_code != 0 ? summary->exit_code : shown;
}

int merge_command(MergeArguments& arguments) {
  double fail_share = 0;
  if (auto e = read_fail_on(arguments.fail_on, fail_share)) return fail(*e);
  const auto summary =
      merge_catalog(arguments.folders, arguments.out.empty() ? arguments.folders.front() : arguments.out, fail_share);
  if (!summary) return fail_run(summary.error());
  spdlog::info("{} of {} ok, {} partly, {} refused, {} failed, {} crashed, {} timed out; report: {}", summary->ok,
               summary->total, summary->partly, summary->refused, summary->failed, summary->crashed, summary->timed_out,
               summary->report);
  if (!summary->missing.empty()) {
    std::string list;
    for (const int shard : summary->missing) list += (list.empty() ? "" : ", ") + std::to_string(shard);
    spdlog::error("vitrine: shards without a report: {} (of {}); {} items are missing", list, summary->shards,
                  summary->without_report);
    spdlog::error("  remedy: run these shards again, then merge again");
  }
  return summary->exit_code;
}

void add_run(CLI::App& command, CLI::App& app, int& exit_code) {
  auto* run =
      command.add_subcommand("run", "Convert every new or changed item of a manifest, each in a worker of its own");
  auto a = std::make_shared<CatalogArguments>();
  run->add_option("manifest", a->manifest, "CSV: sku, garment, neckline, front, back, ... (docs/CATALOG.md)")
      ->required();
  run->add_option("--out", a->catalog.out_dir, "Output folder; one folder per SKU, quarantine and reports")->required();
  run->add_option("--jobs", a->catalog.jobs, "Workers at a time")->check(CLI::Range(1, 256))->capture_default_str();
  run->add_option("--mannequins", a->mannequins, "Size run: each item on all of these, e.g. XS,S,M,L,XL,XXL")
      ->delimiter(',')
      ->group("Mannequin");
  run->add_option("--shard", a->shard, "Only shard i of n, 0/n to n-1/n; then vitrine catalog merge")->group("Run");
  run->add_flag("--force", a->catalog.force, "Make every item anew, not only new and changed ones")->group("Run");
  run->add_flag("--why", a->catalog.why, "Say for each item why it is made or not")->group("Run");
  run->add_flag("--retry-refused", a->catalog.retry_refused, "Also items that were refused and have not changed")
      ->group("Run");
  run->add_flag("--retry-failed", a->catalog.retry_failed, "Also items that crashed, hung or failed twice")
      ->group("Run");
  run->add_flag("--checksum", a->catalog.checksum, "Read all photos and results again instead of trusting file times")
      ->group("Run");
  run->add_option("--fail-on", a->fail_on, "Exit code 1 when items are not ok: any, never, or more than N%")
      ->capture_default_str()
      ->group("Run");
  run->add_option("--progress", a->progress, "auto (a bar on a terminal, else a line every 30 s), json or none")
      ->check(CLI::IsMember({"auto", "json", "none"}))
      ->capture_default_str()
      ->group("Run");
  run->add_option("--item-seconds", a->catalog.item_seconds, "Time an item may take [s]")
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str()
      ->group("Limits");
  run->add_option("--item-cpu", a->catalog.item_cpu_seconds, "Processor time an item may take [s]; 0 = no limit")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str()
      ->group("Limits");
  run->add_option("--item-memory", a->item_memory,
                  "Memory an item may take besides what all share, e.g. 500M; 0 = no limit")
      ->capture_default_str()
      ->group("Limits");
  run->add_option("--showroom", a->showroom.out,
                  "At the end, also write a static site of the catalogue into this folder")
      ->group("Show room");
  add_showroom_options(*run, a->showroom);
  a->job.add_to(*run);
  a->mannequin.add_to(*run);
  a->plugins.add_to(*run);
  a->input.add_to(*run);
  run->callback([a, run, &app, &exit_code] {
    a->catalog.progress = a->progress == "json"                                             ? ProgressKind::json
                          : a->progress == "none" || app.get_option("--quiet")->count() > 0 ? ProgressKind::none
                                                                                            : ProgressKind::automatic;
    exit_code = run_catalog_command(*a, settings_text(*run));
  });
}

void add_merge(CLI::App& command, int& exit_code) {
  auto* merge = command.add_subcommand("merge", "One report of all shards, naming those that are missing");
  auto a = std::make_shared<MergeArguments>();
  merge->add_option("folders", a->folders, "Output folders of the shards; one when they shared it")->required();
  merge->add_option("--out", a->out, "Folder of the report, into which all items are brought; the first when left out");
  merge->add_option("--fail-on", a->fail_on, "Exit code 1 when items are not ok: any, never, or more than N%")
      ->capture_default_str();
  merge->callback([a, &exit_code] { exit_code = merge_command(*a); });
}

}  // namespace

void add_catalog(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("catalog", "A whole catalogue");
  command->require_subcommand(1);
  add_run(*command, app, exit_code);
  add_merge(*command, exit_code);
  add_catalog_input(*command, exit_code);
}

}  // namespace vitrine::cli
