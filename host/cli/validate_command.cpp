// SPDX-License-Identifier: GPL-3.0-or-later
// vitrine plugin validate, checks, lock, and what validate asks of another process.
#include <filesystem>

#include "common.hpp"
#include "plugin_commands.hpp"
#include "vitrine/validate.hpp"

namespace vitrine::cli {
namespace {

struct ValidateArguments {
  ValidateOptions options;
  PluginOptions partners;
  std::vector<std::string> files;
  std::string json;
  bool all = false;
};

int validate(const ValidateArguments& arguments) {
  ValidateOptions options = arguments.options;
  options.partners = arguments.partners.search();
  options.program = "/proc/self/exe";
  if (!options.keep.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(options.keep, failed);
    if (failed)
      return fail(
          {Cause::unwritable, "CANNOT_WRITE", options.keep + ": the folder cannot be made", "name another", ""});
  }
  bool pipeline = options.level >= 4;
  if (!options.only.empty()) {
    pipeline = false;
    for (const CheckInfo& check : plugin_checks())
      pipeline = pipeline || (check.level >= 4 && check.name.starts_with(options.only));
  }
  if (pipeline) {
    // Made once; the child processes share it.
    const auto body = MannequinOptions{}.make_body();
    if (!body) return fail(body.error());
    options.body = *body;
  }
  const auto validation = validate_plugins(arguments.files, options);
  if (!validation) return fail(validation.error());
  const std::string json = validation_json(*validation, options, VITRINE_VERSION);
  if (arguments.json == "-") {
    if (auto e = print(json)) return fail(*e);
  } else {
    if (!arguments.json.empty())
      if (auto e = write_file(arguments.json, json)) return fail(*e);
    if (auto e = print(validation_text(*validation, arguments.all))) return fail(*e);
  }
  return validation->ok() ? 0 : static_cast<int>(Cause::plugin);
}

int list_checks(bool markdown) {
  std::string text;
  int level = 0;
  for (const CheckInfo& check : plugin_checks()) {
    if (check.level != level) {
      level = check.level;
      const std::string title = "Level " + std::to_string(level) + ": " + std::string(level_name(level));
      text += markdown ? (level > 1 ? "\n### " : "### ") + title +
                             "\n\n| Check | What a plugin that passes keeps |\n|---|---|\n"
                       : (level > 1 ? "\n" : "") + title + "\n";
    }
    std::string name(check.name);
    if (markdown)
      text += "| `" + name + "` | " + std::string(check.description) + " |\n";
    else
      text += "  " + name + std::string(name.size() < 24 ? 24 - name.size() : 1, ' ') + std::string(check.description) +
              "\n";
  }
  if (auto e = print(text)) return fail(*e);
  return 0;
}

int write_lock(const PluginOptions& options, const std::string& out) {
  const auto registry = options.load();
  if (!registry) return fail(registry.error());
  for (const RejectedPlugin& rejected : registry->rejected()) return fail(rejected.error);
  if (registry->plugins().empty())
    return fail({Cause::plugin, "NO_PLUGINS", "no plugin was found, so there is nothing to lock",
                 "give --plugin-dir, or install the built-in plugins beside the program", ""});
  const std::string text = lock_text(*registry);
  if (auto e = out == "-" ? print(text) : write_file(out, text)) return fail(*e);
  return 0;
}

int digest(DigestRequest request, const PluginOptions& partners, bool alone) {
  request.partners = partners.search();
  request.partners.built_in = !alone;
  const auto body = MannequinOptions{}.make_body();
  if (!body) return fail(body.error());
  const auto text = conversion_digest(request, *body);
  if (!text) return fail(text.error());
  if (auto e = print(*text + "\n")) return fail(*e);
  return 0;
}

void add_digest(CLI::App& command, int& exit_code) {
  struct Arguments {
    DigestRequest request;
    PluginOptions partners;
    bool alone = false;
  };
  auto a = std::make_shared<Arguments>();
  // Without a group it is in no help text: only validate calls it.
  auto* digest_command = command.add_subcommand("digest", "Hashes for the check determinism.process")->group("");
  digest_command->add_option("file", a->request.file)->required();
  digest_command->add_option("--garment", a->request.garment)->required();
  digest_command->add_option("--neckline", a->request.neckline)->required();
  digest_command->add_option("--front", a->request.front)->required();
  digest_command->add_option("--back", a->request.back)->required();
  digest_command->add_flag("--alone", a->alone);
  a->partners.add_to(*digest_command);
  digest_command->callback([a, &exit_code] { exit_code = digest(a->request, a->partners, a->alone); });
}

}  // namespace

void add_plugin_validate(CLI::App& command, int& exit_code) {
  auto a = std::make_shared<ValidateArguments>();
  auto* run = command.add_subcommand(
      "validate", "Check plugin files, each in a process of its own; exit code 0 when nothing failed, else 69");
  // Not required by the parser: an empty list is a failed validation, and its exit code says so.
  run->add_option("files", a->files, "Plugin files (*.vitrine.so)");
  run->add_option("--level", a->options.level,
                  "Check up to: 1 load, 2 descriptor, 3 template, 4 pipeline, 5 determinism, 6 hardening")
      ->check(CLI::Range(1, max_check_level))
      ->capture_default_str();
  run->add_option("--only", a->options.only, "Report only this check, or those whose names begin so (hardening)");
  run->add_option("--json", a->json,
                  "Also write the report as JSON into this file; - for JSON alone on standard output");
  run->add_flag("--all", a->all, "List passed and skipped checks too");
  run->add_option("--seed", a->options.seed,
                  "Vary corners and colours of the photos that are drawn; 0 = as the template says")
      ->capture_default_str();
  run->add_option("--timeout", a->options.seconds, "Seconds that one check may take")
      ->check(CLI::Range(0.1, 86400.0))
      ->capture_default_str();
  run->add_option("--photo", a->options.photos,
                  "Also convert this front photo of the garment; may be given more than once")
      ->allow_extra_args(false);
  run->add_option("--keep", a->options.keep, "Keep the photos that are drawn in this folder");
  a->partners.add_to(*run);
  run->callback([a, &exit_code] { exit_code = validate(*a); });

  auto markdown = std::make_shared<bool>(false);
  auto* checks = command.add_subcommand("checks", "All checks of validate, by level, each with what it promises");
  checks->add_flag("--markdown", *markdown, "As the tables of docs/VALIDATE.md");
  checks->callback([markdown, &exit_code] { exit_code = list_checks(*markdown); });

  struct Lock {
    PluginOptions options;
    std::string out;
  };
  auto l = std::make_shared<Lock>();
  auto* lock =
      command.add_subcommand("lock", "Write a plugins.lock of all plugins found: SHA-256, id and version of each");
  lock->add_option("--out", l->out, "File to write; - for standard output")->required();
  l->options.add_to(*lock);
  lock->callback([l, &exit_code] { exit_code = write_lock(l->options, l->out); });

  add_digest(command, exit_code);
}

}  // namespace vitrine::cli
