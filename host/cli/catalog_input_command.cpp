// SPDX-License-Identifier: GPL-3.0-or-later
// vitrine catalog plan and feed: what a catalogue would become, and what platforms are told of what it became.
#include <spdlog/spdlog.h>

#include <fstream>
#include <iostream>

#include "catalog_input.hpp"
#include "common.hpp"
#include "vitrine/catalog_feed.hpp"

namespace vitrine::cli {
namespace {

struct PlanArguments {
  std::string path, manifest;
  InputFlags input;
  bool json = false, print_rules = false;
};

struct FeedArguments {
  std::string out_dir, platform = "items", format, file, input_path;
  InputFlags input;
  FeedOptions options;
};

int run_plan(const PlanArguments& a) {
  if (a.print_rules) {
    std::cout << default_rules();
    return 0;
  }
  if (a.path.empty()) return fail({Cause::usage, "USAGE", "no input is given", "name a manifest, feed or folder", ""});
  InputOptions options = a.input.options();
  options.details = true;
  const auto input = read_input(a.path, options);
  if (!input) return fail(input.error());
  std::cout << (a.json ? plan_json(*input) + "\n" : plan_table(*input)) << std::flush;
  if (a.manifest.empty()) return 0;
  if (!input->pictures_found)
    return fail({Cause::usage, "IMAGE_ROOT", a.path + ": the feed names its pictures by address",
                 "give the folder where they lie as --image-root", "catalog"});
  if (auto error = write_manifest(input->items, a.manifest)) return fail(*error);
  return 0;
}

std::optional<Error> write(const std::string& path, const std::string& text) {
  if (path.empty() || path == "-") {
    std::cout << text << std::flush;
    return {};
  }
  return write_file(path, text);
}

int run_feed(const FeedArguments& a) {
  FeedOptions options = a.options;
  options.platform = a.platform == "google"    ? FeedPlatform::google
                     : a.platform == "shopify" ? FeedPlatform::shopify
                                               : FeedPlatform::items;
  const std::string own = a.platform == "google" ? "tsv" : a.platform == "shopify" ? "csv" : "json";
  const std::string format = a.format.empty() ? own : a.format;
  if (format != own && !(a.platform == "google" && format == "xml"))
    return fail({Cause::usage, "USAGE", "a feed for " + a.platform + " is not written as " + format,
                 a.platform == "google" ? "choose tsv or xml" : "leave --format out", ""});
  options.format = format == "xml" ? FeedFormat::xml : format == "tsv" ? FeedFormat::tsv : FeedFormat::json;
  std::optional<CatalogInput> input;
  if (!a.input_path.empty()) {
    InputOptions reading = a.input.options();
    reading.details = true;
    auto read = read_input(a.input_path, reading);
    if (!read) return fail(read.error());
    input = std::move(*read);
    options.input = &*input;
  }
  const auto feed = make_feed(a.out_dir, options);
  if (!feed) return fail(feed.error());
  for (const std::string& warning : feed->warnings) spdlog::warn("{}", warning);
  if (auto error = write(a.file, feed->text)) return fail(*error);
  spdlog::info("{} garments in the feed, {} left out", feed->items, feed->left_out.size());
  int exit_code = 0;
  for (const Error& error : feed->left_out) exit_code = fail(error);
  return exit_code;
}

}  // namespace

void InputFlags::add_to(CLI::App& app) {
  const char* const group = "Input";
  app.add_option("--rules", rules, "JSON: which picture is front or back, which product is which garment")
      ->group(group);
  app.add_option("--image-root", image_root,
                 "Folder with the feed's pictures; nothing outside is read, nothing is downloaded")
      ->group(group);
  app.add_option("--input-kind", kind, "auto, or what the input is")
      ->check(CLI::IsMember({"auto", "manifest", "folder", "shopify", "google", "woocommerce"}))
      ->capture_default_str()
      ->group(group);
}

InputOptions InputFlags::options() const {
  InputOptions options;
  options.kind = input_kind_of(kind).value_or(InputKind::automatic);
  options.rules = rules;
  options.image_root = image_root;
  return options;
}

void add_catalog_input(CLI::App& catalog, int& exit_code) {
  auto* plan = catalog.add_subcommand("plan", "Show what a run would convert and why; converts nothing");
  auto p = std::make_shared<PlanArguments>();
  plan->add_option("input", p->path, "Manifest (CSV, JSON), shop feed (CSV, TSV, XML) or folder of photos");
  p->input.add_to(*plan);
  plan->add_flag("--json", p->json, "As JSON, with every picture");
  plan->add_option("--write-manifest", p->manifest, "Also write the items as a manifest, .csv or .json");
  plan->add_flag("--print-rules", p->print_rules, "Print the built-in rules, to begin one's own with");
  plan->callback([p, &exit_code] { exit_code = run_plan(*p); });

  auto* feed = catalog.add_subcommand("feed", "Tell a platform of the models in an output folder");
  auto f = std::make_shared<FeedArguments>();
  feed->add_option("folder", f->out_dir, "What vitrine catalog run wrote with --out")->required();
  feed->add_option("--platform", f->platform, "google, shopify or items (items.json)")
      ->check(CLI::IsMember({"google", "shopify", "items"}))
      ->required();
  feed->add_option("--base-url", f->options.base_url, "Where the folder is published");
  feed->add_option("--format", f->format, "google: tsv (default) or xml")
      ->check(CLI::IsMember({"tsv", "xml", "csv", "json"}));
  feed->add_option("--model", f->options.model, "Which model is linked")
      ->check(CLI::IsMember({"garment", "dressed"}))
      ->capture_default_str();
  feed->add_option("--input", f->input_path, "What was converted: titles, sizes and the shop's own ids come from it");
  f->input.add_to(*feed);
  feed->add_option("--out", f->file, "File to write; standard output if left out");
  feed->callback([f, &exit_code] { exit_code = run_feed(*f); });
}

}  // namespace vitrine::cli
