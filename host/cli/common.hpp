// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vitrine/host/registry.hpp"
#include "vitrine/pipeline.hpp"

namespace vitrine::cli {

/// Where plugins are looked for, besides the program's own folder.
struct PluginOptions {
  std::vector<std::string> files;
  std::vector<std::string> folders;
  std::string lock;  ///< plugins.lock; empty = none
  void add_to(CLI::App& app);
  /// Error: a plugin that the user named was refused, or two supply the same id.
  Result<PluginRegistry> load() const;
  PluginSearch search() const;
};

/// The mannequin as asked for: a preset, a mesh or measurements file, or single measurements.
struct MannequinOptions {
  std::string file;   ///< or the name of a preset
  std::string cache;  ///< folder that keeps voxels from run to run; empty = none
  std::string sex;
  /// One entry per measurement flag [mm]; unset ones keep the default.
  std::vector<std::pair<std::string, std::optional<double>>> millimetres;
  void add_to(CLI::App& app);
  /// Builds or imports the body and its voxels.
  Result<std::shared_ptr<const Body>> make_body() const;
};

/// What of a conversion is chosen on the command line and the same for a whole catalogue.
struct JobOptions {
  std::string quality;  ///< empty: standard, or fine where max_error or max_time choose the mesh
  std::optional<double> max_error_mm, max_time_s;
  double work_rate = Budget::usual_rate;
  bool debug_images = false;
  std::vector<std::string> formats;
  bool compress = false;
  int texture_size = 2048, brightest = 255;
  std::vector<std::string> views;
  int turntable = 0;
  std::string picture = "webp", picture_size = "800x1000", ground = "studio", copyright;
  void add_to(CLI::App& app);
  /// Error: USAGE (64) when options contradict each other.
  std::optional<Error> apply(ConvertRequest& request) const;
};

/// Adds to `choice` what the registry knows: the garment's template and all necklines; `neckline` is "auto" or an id.
std::optional<Error> choose_garment(const PluginRegistry& registry, const std::string& garment,
                                    const std::string& neckline, GarmentChoice& choice);

/// Measurements from JSON in millimetres, {"sex": "woman", "height": 1720, ...}; all nine are needed. Error: MISSING
/// (66), MEASUREMENTS (65) naming the key.
Result<Measurements> read_all_measurements(const std::string& path);

/// Prints "vitrine: message / remedy" to standard error and returns the exit code.
int fail(const Error& error);
/// What contradicts itself on the command line: USAGE (64).
Error usage(const std::string& message, const std::string& remedy);
/// Error: CANNOT_WRITE (73); standard output is a file like any other and can be full.
std::optional<Error> print(const std::string& text);

void add_convert(CLI::App& app, int& exit_code);
void add_catalog(CLI::App& app, int& exit_code);
void add_features(CLI::App& app, int& exit_code);
void add_mannequin(CLI::App& app, int& exit_code);
void add_measure(CLI::App& app, int& exit_code);
void add_plugin(CLI::App& app, int& exit_code);
void add_showroom(CLI::App& app, int& exit_code);
/// `vitrine plugin new NAME`: a project to start a plugin from.
void add_plugin_new(CLI::App& plugin_command, int& exit_code);

}  // namespace vitrine::cli
