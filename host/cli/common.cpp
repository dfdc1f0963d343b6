// SPDX-License-Identifier: GPL-3.0-or-later
#include "common.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "field_cache.hpp"

namespace vitrine::cli {
namespace {

struct MeasurementField {
  const char* name;
  double Measurements::*field;
};
constexpr MeasurementField measurement_fields[] = {{"height", &Measurements::height},
                                                   {"bust", &Measurements::bust},
                                                   {"under_bust", &Measurements::under_bust},
                                                   {"waist", &Measurements::waist},
                                                   {"hip", &Measurements::hip},
                                                   {"inside_leg", &Measurements::inside_leg},
                                                   {"arm", &Measurements::arm},
                                                   {"neck_base", &Measurements::neck_base}};

std::string lower_extension(const std::string& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

/// Measurements in millimetres from {"sex": "woman", "height": 1720, ...}.
std::optional<Error> read_measurements(const std::string& path, Measurements& m, bool all = false) {
  std::ifstream in(path);
  if (!in)
    return Error{Cause::missing, "MISSING", path + ": the file cannot be read", "check the path and its permissions",
                 "mannequin"};
  const auto broken = [&](const std::string& what) {
    return Error{
        Cause::unusable, "MEASUREMENTS", path + ": " + what,
        "give \"sex\" and any of height, bust, under_bust, waist, hip, inside_leg, arm, neck_base in millimetres",
        "mannequin"};
  };
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object()) return broken("not a JSON object");
  for (const auto& [key, value] : json.items()) {
    if (key == "sex") {
      if (!value.is_string()) return broken("\"sex\" is not a text");
      m.sex = value.get<std::string>();
      continue;
    }
    const auto field = std::find_if(std::begin(measurement_fields), std::end(measurement_fields),
                                    [&](const MeasurementField& f) { return key == f.name; });
    if (field == std::end(measurement_fields)) return broken("unknown measurement \"" + key + "\"");
    if (!value.is_number()) return broken("\"" + key + "\" is not a number");
    m.*(field->field) = value.get<double>() * 1e-3;
  }
  if (all) {
    if (!json.contains("sex")) return broken("\"sex\" is missing");
    for (const MeasurementField& field : measurement_fields)
      if (!json.contains(field.name)) return broken(std::string("\"") + field.name + "\" is missing");
  }
  return std::nullopt;
}

}  // namespace

void PluginOptions::add_to(CLI::App& app) {
  app.add_option("--plugin", files, "Plugin file (*.vitrine.so) to load first")
      ->allow_extra_args(false)  // what follows is the command's own, as a manifest
      ->group("Plugins");
  app.add_option("--plugin-dir", folders, "Folder of plugins to load before the built-in ones")
      ->allow_extra_args(false)
      ->group("Plugins");
  app.add_option("--lock", lock, "Load only the files that this plugins.lock lists (vitrine plugin lock writes one)")
      ->group("Plugins");
}

PluginSearch PluginOptions::search() const {
  PluginSearch search;
  search.files.assign(files.begin(), files.end());
  search.folders.assign(folders.begin(), folders.end());
  search.lock = lock;
  return search;
}

Result<PluginRegistry> PluginOptions::load() const {
  PluginRegistry registry = PluginRegistry::load(search());
  if (auto problem = registry.problem()) return *problem;
  return registry;
}

void MannequinOptions::add_to(CLI::App& app) {
  app.add_option("--mannequin", file,
                 "Preset such as woman-m, watertight OBJ, GLB, PLY or DAE body, or a JSON file of measurements [mm]")
      ->group("Mannequin");
  app.add_option("--cache", cache, "Folder that keeps the mannequin's voxels for the next run")->group("Mannequin");
  app.add_option("--sex", sex, "Built-in body: woman or man")
      ->check(CLI::IsMember({"woman", "man"}))
      ->group("Mannequin");
  millimetres.clear();
  for (const auto& f : measurement_fields) millimetres.emplace_back(f.name, std::nullopt);
  for (auto& [name, value] : millimetres) {
    std::string flag = "--" + name + "-mm";
    std::replace(flag.begin(), flag.end(), '_', '-');
    app.add_option(flag, value, "Body measurement [mm]")->group("Mannequin");
  }
}

Result<std::shared_ptr<const Body>> MannequinOptions::make_body() const {
  auto body = std::make_shared<Body>();
  Measurements m;
  const auto preset = preset_measurements(file);
  const bool measured = file.empty() || preset || lower_extension(file) == ".json";
  const bool flags = !sex.empty() || std::any_of(millimetres.begin(), millimetres.end(),
                                                 [](const auto& v) { return v.second.has_value(); });
  if (!measured && lower_extension(file).empty() && !std::filesystem::exists(file)) return preset.error();
  if (!measured && flags)
    return Error{Cause::usage, "USAGE", file + ": a mesh has its own measurements",
                 "leave out --sex and the --...-mm flags, or --mannequin", "mannequin"};
  if (measured) {
    if (preset)
      m = *preset;
    else if (!file.empty())
      if (auto e = read_measurements(file, m)) return *e;
    if (!sex.empty()) m.sex = sex;
    for (std::size_t i = 0; i < millimetres.size(); ++i)
      if (millimetres[i].second) m.*(measurement_fields[i].field) = *millimetres[i].second * 1e-3;
  }
  auto mannequin = measured ? build_mannequin(m) : import_mannequin(file);
  if (!mannequin) return mannequin.error();
  body->mannequin = *std::move(mannequin);
  for (const std::string& warning : body->mannequin.warnings) spdlog::warn("warning: {}", warning);
  auto field = cached_field(body->mannequin.mesh, {}, cache);
  if (!field) return field.error();
  body->field = *std::move(field);
  return std::shared_ptr<const Body>(std::move(body));
}

void JobOptions::add_to(CLI::App& app) {
  app.add_option("--quality", quality, "draft (about 300 nodes), standard (2,000) or fine (20,000)")
      ->check(CLI::IsMember({"draft", "standard", "fine"}))
      ->default_str("standard; fine with --max-error or --max-time, whose upper limit it is");
  app.add_option("--max-error", max_error_mm,
                 "The coarsest mesh whose estimated mean distance [mm] to ever finer ones is within this");
  app.add_option("--max-time", max_time_s,
                 "The finest mesh that takes no more than this [s] of a processor, reckoned by --work-rate");
  app.add_option("--work-rate", work_rate, "Work units per second of this machine, as --max-time reckons")
      ->capture_default_str();
  app.add_flag("--debug-images", debug_images, "Also write pictures of silhouette, feature points and mesh");
  app.add_option("--format", formats, "Also write the garment as obj or ply; may be given twice")
      ->check(CLI::IsMember({"obj", "ply"}))
      ->delimiter(',')
      ->group("Files");
  app.add_flag("--compress", compress,
               "Also write garment-page.glb and dressed-page.glb for web pages (EXT_meshopt_compression)")
      ->group("Files");
  app.add_option("--texture-size", texture_size, "Largest side of the texture: 512, 1024, 2048 or 4096")
      ->check(CLI::IsMember({512, 1024, 2048, 4096}))
      ->capture_default_str()
      ->group("Files");
  app.add_option("--brightest", brightest, "Ease whiter cloth below this; some shops ask for 243")
      ->check(CLI::Range(64, 255))
      ->capture_default_str()
      ->group("Files");
  app.add_option("--copyright", copyright, "Copyright line kept in the files")->group("Files");
  app.add_option("--views", views, "Also write pictures: front, three-quarter, back, detail")
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(view_names), std::end(view_names))))
      ->delimiter(',')
      ->group("Pictures");
  app.add_option("--turntable", turntable, "Also write a strip of N views around the mannequin, each half the size")
      ->check(CLI::Range(1, 72))
      ->group("Pictures");
  app.add_option("--picture", picture, "Format of --views and --turntable: webp, jpeg or png")
      ->check(CLI::IsMember({"webp", "jpeg", "png"}))
      ->capture_default_str()
      ->group("Pictures");
  app.add_option("--picture-size", picture_size, "Their size in pixels, WIDTHxHEIGHT")
      ->capture_default_str()
      ->group("Pictures");
  app.add_option("--ground", ground, "studio, or alpha: nothing but the subject and its shadow")
      ->check(CLI::IsMember({"studio", "alpha"}))
      ->capture_default_str()
      ->group("Pictures");
}

std::optional<Error> JobOptions::apply(ConvertRequest& request) const {
  const std::pair<const char*, std::optional<double>> positive[] = {
      {"--max-error", max_error_mm}, {"--max-time", max_time_s}, {"--work-rate", work_rate}};
  for (const auto& [name, value] : positive)
    if (value && !(std::isfinite(*value) && *value > 0))
      return usage(std::string(name) + " is not a number above zero",
                   std::string("give ") + name + " a number above zero, or leave it out");
  request.budget.max_error = max_error_mm.value_or(0) / 1e3;
  request.budget.max_time = max_time_s.value_or(0);
  request.budget.work_rate = work_rate;
  const std::string chosen = !quality.empty() ? quality : request.budget.asked() ? "fine" : "standard";
  request.quality = chosen == "draft" ? Quality::draft : chosen == "fine" ? Quality::fine : Quality::standard;
  request.debug_images = debug_images;
  request.formats.clear();
  for (const std::string& format : formats)
    request.formats.push_back(format == "ply" ? MeshFormat::ply : MeshFormat::obj);
  request.compress = compress;
  request.texture.max_size = texture_size;
  request.texture.top_value = brightest;
  request.copyright = copyright;
  request.version = VITRINE_VERSION;

  PictureRequest& p = request.pictures;
  p.views = views;
  p.turntable = turntable;
  p.format = picture == "png" ? PictureFormat::png : picture == "jpeg" ? PictureFormat::jpeg : PictureFormat::webp;
  p.ground = ground == "alpha" ? Ground::alpha : Ground::studio;
  int width = 0, height = 0, end = 0;
  if (std::sscanf(picture_size.c_str(), "%5dx%5d%n", &width, &height, &end) != 2 ||
      end != static_cast<int>(picture_size.size()) || width < 64 || width > 4096 || height < 64 || height > 4096)
    return usage("--picture-size " + picture_size + " is no size", "give WIDTHxHEIGHT, 64 to 4096 each, as 800x1000");
  p.width = width;
  p.height = height;
  if (p.format == PictureFormat::jpeg && p.ground == Ground::alpha)
    return usage("a JPEG has no alpha channel", "use --picture webp or png with --ground alpha");
  const int longest = p.format == PictureFormat::webp ? 16'383 : 65'500;
  if (turntable * (width / 2) > longest)
    return usage("a strip of " + std::to_string(turntable) + " views is wider than a " + picture + " picture may be",
                 "ask for fewer views, a smaller --picture-size, or --picture png");
  return std::nullopt;
}

std::optional<Error> choose_garment(const PluginRegistry& registry, const std::string& garment,
                                    const std::string& neckline, GarmentChoice& choice) {
  const auto unknown = [&](const char* code, const char* kind, const std::string& id, const auto& known,
                           std::string choices) {
    for (const auto& k : known) choices += (choices.empty() ? "" : ", ") + k.id;
    std::string message = std::string("no plugin supplies the ") + kind + " \"" + id + "\"";
    if (!registry.rejected().empty())
      message +=
          " (" + std::to_string(registry.rejected().size()) + " plugin files were refused: see vitrine plugin list)";
    return Error{Cause::plugin, code, message,
                 choices.empty() ? "no plugin was found: give --plugin-dir" : "choose one of: " + choices, ""};
  };
  const GarmentTemplate* found = registry.find_garment(garment);
  if (!found) return unknown("UNKNOWN_GARMENT", "garment", garment, registry.garments(), "");
  if (neckline != "auto" && !registry.find_neckline(neckline))
    return unknown("UNKNOWN_NECKLINE", "neckline", neckline, registry.necklines(), "auto");
  choice.garment = *found;
  choice.neckline = neckline;
  choice.necklines = registry.necklines();
  choice.others.assign(registry.garments().begin(), registry.garments().end());
  return std::nullopt;
}

Result<Measurements> read_all_measurements(const std::string& path) {
  Measurements m;
  if (auto e = read_measurements(path, m, true)) return *e;
  return m;
}

Error usage(const std::string& message, const std::string& remedy) {
  return Error{Cause::usage, "USAGE", message, remedy, ""};
}

std::optional<Error> print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return std::nullopt;
  return Error{Cause::unwritable, "CANNOT_WRITE", "standard output cannot be written", "check the disk or the pipe",
               ""};
}

int fail(const Error& error) {
  spdlog::error("vitrine: {}{}", error.stage.empty() ? "" : error.stage + ": ", error.message);
  if (!error.code.empty()) spdlog::error("  reason: {}", error.code);
  if (!error.remedy.empty()) spdlog::error("  remedy: {}", error.remedy);
  return error.exit_code();
}

}  // namespace vitrine::cli
