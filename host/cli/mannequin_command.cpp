// SPDX-License-Identifier: GPL-3.0-or-later
#include <spdlog/spdlog.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "common.hpp"
#include "vitrine/mannequin.hpp"
#include "vitrine/preview.hpp"
#include "vitrine/texture.hpp"

namespace vitrine::cli {
namespace {

struct MannequinArguments {
  std::string measurements, preset, import, out;
};

std::optional<Error> check_arguments(const MannequinArguments& a) {
  const int sources = !a.measurements.empty() + !a.preset.empty() + !a.import.empty();
  if (sources == 1) return std::nullopt;
  return Error{Cause::usage, "USAGE",
               sources == 0 ? "no body is named" : "--measurements, --preset and --import exclude each other",
               "give one of --measurements M.json, --preset woman-m, --import FILE", "mannequin"};
}

/// Where each measurement is taken: the landmark that lies on its level, or at its end.
struct Taken {
  const char* name;
  double Measurements::*asked;
  const char* point;
};
constexpr Taken taken[] = {{"height", &Measurements::height, "crown"},
                           {"bust", &Measurements::bust, "bust_right"},
                           {"under_bust", &Measurements::under_bust, "under_bust"},
                           {"waist", &Measurements::waist, "waist"},
                           {"hip", &Measurements::hip, "hip"},
                           {"inside_leg", &Measurements::inside_leg, "crotch"},
                           {"arm", &Measurements::arm, "wrist_right"},
                           {"neck_base", &Measurements::neck_base, "neck_back"}};

double to_mm(double metres) {
  return std::round(metres * 1e4) / 10;
}

nlohmann::ordered_json place(const Vec3& p) {
  return {to_mm(p.x()), to_mm(p.y()), to_mm(p.z())};
}

/// What was asked for and what the tape reads on the mesh; all in millimetres, +Y up, +Z to the front.
std::string measurements_json(const Mannequin& body, const std::optional<Measurements>& asked) {
  nlohmann::ordered_json j;
  j["format"] = "vitrine-mannequin/1";
  j["source"] = body.source;
  if (asked) j["sex"] = asked->sex;
  j["unit"] = "mm";
  for (const Taken& t : taken) {
    nlohmann::ordered_json& row = j["measurements"][t.name];
    if (asked) row["asked"] = to_mm((*asked).*(t.asked));
    row["measured"] = to_mm(body.girths.at(t.name));
    row["level"] = to_mm(body.landmarks.at(t.point).y());
    row["point"] = place(body.landmarks.at(t.point));
  }
  for (const char* girth : {"biceps", "wrist", "thigh"}) j["other_girths"][girth] = to_mm(body.girths.at(girth));
  for (const auto& [name, at] : body.landmarks) j["landmarks"][name] = place(at);
  j["warnings"] = body.warnings;
  return j.dump(2) + "\n";
}

std::optional<Error> write_body(const Mannequin& body, const std::optional<Measurements>& asked,
                                const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed || !std::filesystem::is_directory(folder, failed))
    return Error{Cause::unwritable, "CANNOT_WRITE", folder + ": the output folder cannot be made",
                 "name a folder that you may write to with --out", "mannequin"};
  const RenderMesh mesh = assemble_mannequin(body.mesh);
  const auto glb = encode_glb(std::span(&mesh, 1));
  if (!glb) return glb.error();
  const auto picture = render_preview(std::span(&mesh, 1), {.turns_deg = {0, 90, 180}});
  if (!picture) return picture.error();
  const auto png = encode_png(*picture);
  if (!png) return png.error();
  if (auto e = write_file(folder + "/mannequin.glb", *glb)) return e;
  if (auto e = write_file(folder + "/preview.png", *png)) return e;
  // Last, so that it means that the others are there.
  return write_file(folder + "/measurements.json", measurements_json(body, asked));
}

int run_mannequin(const MannequinArguments& a) {
  if (auto e = check_arguments(a)) return fail(*e);
  std::optional<Measurements> asked;
  if (!a.preset.empty()) {
    const auto preset = preset_measurements(a.preset);
    if (!preset) return fail(preset.error());
    asked = *preset;
  } else if (!a.measurements.empty()) {
    const auto read = read_all_measurements(a.measurements);
    if (!read) return fail(read.error());
    asked = *read;
  }
  const auto body = asked ? build_mannequin(*asked) : import_mannequin(a.import);
  if (!body) return fail(body.error());
  for (const std::string& warning : body->warnings) spdlog::warn("warning: {}", warning);
  for (const Taken& t : taken)
    spdlog::info("{:<11}{:7.0f} mm{}", t.name, body->girths.at(t.name) * 1e3,
                 asked ? fmt::format("   asked {:.0f}", (*asked).*(t.asked) * 1e3) : "");
  if (auto e = write_body(*body, asked, a.out)) return fail(*e);
  return 0;
}

}  // namespace

void add_mannequin(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("mannequin", "A body from eight measurements, or somebody's mesh measured");
  auto a = std::make_shared<MannequinArguments>();
  command->add_option("--measurements", a->measurements,
                      "JSON: sex, and height, bust, under_bust, waist, hip, inside_leg, arm, neck_base in mm");
  command->add_option("--preset", a->preset, "woman- or man- with xs, s, m, l, xl, xxl; for instance woman-m");
  command->add_option("--import", a->import, "A watertight OBJ, GLB, PLY or DAE body: found upright, measured");
  command->add_option("--out", a->out, "Folder for mannequin.glb, preview.png, measurements.json")->required();
  command->callback([a, &exit_code] { exit_code = run_mannequin(*a); });
}

}  // namespace vitrine::cli
