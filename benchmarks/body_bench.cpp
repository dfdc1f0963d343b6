// SPDX-License-Identifier: GPL-3.0-or-later
// vitrine-body-bench: what the mannequin room promises, measured. Run by hand; never part of a test.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <map>
#include <sstream>

#include "body_people.hpp"
#include "body_probe.hpp"

namespace {

using namespace vitrine;
using namespace vitrine::bench;

/// Processor time: the rooms use one thread, and other programs share the machine.
double seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

struct Size {
  const char* name;
  double Measurements::*asked;
  double BodyProbe::*found;
};
const Size sizes[] = {{"height", &Measurements::height, &BodyProbe::height},
                      {"bust", &Measurements::bust, &BodyProbe::bust},
                      {"under_bust", &Measurements::under_bust, &BodyProbe::under_bust},
                      {"waist", &Measurements::waist, &BodyProbe::waist},
                      {"hip", &Measurements::hip, &BodyProbe::hip},
                      {"inside_leg", &Measurements::inside_leg, &BodyProbe::inside_leg},
                      {"arm", &Measurements::arm, &BodyProbe::arm},
                      {"neck_base", &Measurements::neck_base, &BodyProbe::neck_base}};

/// Builds and measures everybody; writes one CSV row each. Gives the number of bodies that miss `bar` [m].
int try_people(const std::vector<Measurements>& people, double bar, bool may_refuse, const std::string& csv) {
  std::ofstream out(csv);
  out << "sex";
  for (const Size& s : sizes) out << ',' << s.name << "_mm";
  for (const Size& s : sizes) out << ',' << s.name << "_off_mm";
  out << ",fullest_hip_off_mm,triangles,smallest_angle,verdict\n";
  std::map<std::string, double> worst;
  std::map<std::string, int> misses;
  int built = 0, refused = 0, failed = 0;
  double least_angle = 180, most_triangles = 0, fewest = 1e9, time = 0;
  for (const Measurements& m : people) {
    const auto start = std::clock();
    const Result<Mannequin> body = build_mannequin(m);
    time += seconds_since(start);
    out << m.sex;
    char number[32];
    const auto put = [&](double mm) {
      std::snprintf(number, sizeof number, ",%.2f", mm);
      out << number;
    };
    for (const Size& s : sizes) put(1e3 * m.*(s.asked));
    if (!body) {
      ++refused;
      const bool fair = may_refuse && body.error().code == "IMPLAUSIBLE_MEASUREMENTS" &&
                        body.error().message.find(" to ") != std::string::npos;
      if (!fair) {
        ++failed;
        ++misses["refused: " + body.error().message];
      }
      out << ",,,,,,,,,,,\"" << body.error().code << ": " << body.error().message << "\"\n";
      continue;
    }
    ++built;
    const BodyProbe p = probe_body(*body);
    std::string verdict;
    const auto blame = [&](const std::string& what) {
      verdict += verdict.empty() ? what : " " + what;
      ++misses[what];
    };
    if (!p.sound)
      blame("unsound");
    else if (p.crosses_itself)
      blame("self-intersecting");
    if (!p.arms_free) blame("merged-arm");
    if (p.smallest_angle < 8) blame("sliver");
    if (p.triangles < 10000 || p.triangles > 20000) blame("triangle-count");
    for (const Size& s : sizes) {
      const double off = p.*(s.found) - m.*(s.asked);
      put(1e3 * off);
      worst[s.name] = std::max(worst[s.name], std::abs(off));
      if (!(std::abs(off) <= bar)) blame(s.name);
    }
    put(1e3 * (p.fullest_hip - m.hip));
    worst["fullest hip"] = std::max(worst["fullest hip"], p.fullest_hip - m.hip);
    out << ',' << p.triangles << ',' << p.smallest_angle << ',' << (verdict.empty() ? "ok" : verdict) << '\n';
    failed += verdict.empty() ? 0 : 1;
    least_angle = std::min(least_angle, p.smallest_angle);
    most_triangles = std::max(most_triangles, static_cast<double>(p.triangles));
    fewest = std::min(fewest, static_cast<double>(p.triangles));
  }
  std::printf("%zu bodies: %d built, %d refused, %d failed (bar %.0f mm), %.3f s each\n", people.size(), built, refused,
              failed, bar * 1e3, time / static_cast<double>(people.size()));
  std::printf("  worst [mm]:");
  for (const auto& [name, off] : worst) std::printf("  %s %.2f", name.c_str(), off * 1e3);
  std::printf("\n  triangles %.0f to %.0f, smallest angle %.1f\n", fewest, most_triangles, least_angle);
  for (const auto& [what, count] : misses) std::printf("  %4d x %s\n", count, what.c_str());
  return failed;
}

int try_fields(const std::string& csv) {
  std::ofstream out(csv);
  out << "body,build_s,field_s,exact_s,within_half_mm,worst_mm,wrong_signs,wrong_beyond_half_mm,deepest_wrong_mm,wrong_"
         "voxel_signs,million_lookups_s,million_"
         "random_lookups_s\n";
  int failed = 0;
  for (const char* sex : {"woman", "man"}) {
    Measurements m = *preset_measurements(std::string(sex) + "-m");
    // The best of five: a neighbour on the same core slows it down.
    double build = 1e9, voxels = 1e9;
    Result<Mannequin> body = build_mannequin(m);
    VoxelOptions options;
    options.spacing = 0.005;
    Result<DistanceField> field = voxelise(body->mesh, options);
    for (int i = 0; i < 5; ++i) {
      auto start = std::clock();
      body = build_mannequin(m);
      build = std::min(build, seconds_since(start));
      start = std::clock();
      field = voxelise(body->mesh, options);
      voxels = std::min(voxels, seconds_since(start));
    }
    const FieldProbe p = probe_field(body->mesh, *field, 100000, 0.01, 7, 0.02);
    std::printf(
        "%s at 5 mm: mesh %.3f s + field %.3f s = %.3f s; exact grid %.2f s (x%.1f); %.2f %% within 0.5 mm, worst %.2f "
        "mm, %zu of %zu signs wrong (%zu further than 0.5 mm, deepest %.2f mm; %zu of the voxels' own); %.1f million "
        "lookups/s (%.1f in random order)\n",
        sex, build, voxels, build + voxels, p.exact_seconds, p.exact_seconds / voxels, 100 * p.within_half_mm,
        1e3 * p.worst, p.wrong_signs, p.points, p.wrong_beyond_half_mm, 1e3 * p.deepest_wrong_sign, p.wrong_voxel_signs,
        1e-6 * p.lookups_per_second, 1e-6 * p.random_lookups_per_second);
    out << sex << ',' << build << ',' << voxels << ',' << p.exact_seconds << ',' << p.within_half_mm << ','
        << 1e3 * p.worst << ',' << p.wrong_signs << ',' << p.wrong_beyond_half_mm << ',' << 1e3 * p.deepest_wrong_sign
        << ',' << p.wrong_voxel_signs << ',' << 1e-6 * p.lookups_per_second << ',' << 1e-6 * p.random_lookups_per_second
        << '\n';
    failed += p.within_half_mm >= 0.99 && p.wrong_signs == 0 && p.wrong_voxel_signs == 0 ? 0 : 1;
  }
  return failed;
}

/// Imports every body that `folder`/measurements.tsv names (columns: asset, then the eight measurements in mm) and
/// prints what was measured less what the table says. Bars: girths 10 mm, lengths 15, neck base 25.
int try_imports(const std::string& folder) {
  std::ifstream in(folder + "/measurements.tsv");
  std::string line;
  if (!in) {
    std::fprintf(stderr, "%s/measurements.tsv: cannot be read\n", folder.c_str());
    return 1;
  }
  struct Column {
    const char* girth;
    double bar;  ///< [mm]
  };
  constexpr Column columns[] = {{"height", 15}, {"bust", 10},       {"under_bust", 10}, {"waist", 10},
                                {"hip", 10},    {"inside_leg", 15}, {"arm", 15},        {"neck_base", 25}};
  int failed = 0;
  while (std::getline(in, line)) {
    std::istringstream row(line);
    std::string file;
    row >> file;
    if (file.empty() || file == "asset" || file.front() == '#') continue;
    const Result<Mannequin> body = import_mannequin(folder + "/" + file);
    if (!body) {
      std::printf("%s: %s\n", file.c_str(), body.error().message.c_str());
      ++failed;
      continue;
    }
    std::printf("%s, off by [mm]:", file.c_str());
    for (const Column& c : columns) {
      double known = 0;
      row >> known;
      const double off = 1e3 * body->girths.at(c.girth) - known;
      std::printf("  %s %+.1f", c.girth, off);
      failed += row && std::abs(off) <= c.bar ? 0 : 1;
    }
    std::printf("\n");
  }
  return failed;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Bodies and voxel fields against their bars", "vitrine-body-bench");
  int people = 500;
  std::uint64_t seed = 1;
  bool corners = false, fields = false;
  std::string folder = "benchmarks/body";
  app.add_option("--people", people, "Bodies drawn from the population; 0 = none")->capture_default_str();
  app.add_option("--seed", seed, "Of the draw")->capture_default_str();
  app.add_flag("--corners", corners, "All 2^8 corners of the stability range and of the accepted one");
  app.add_flag("--field", fields, "The voxel field against exact distances");
  app.add_option("--csv", folder, "Existing folder for people.csv, corners.csv, accepted_corners.csv, field.csv")
      ->capture_default_str();
  std::string sheet, imports;
  app.add_option("--imports", imports, "Folder of other people's bodies with a measurements.tsv");
  app.add_option("--sheet", sheet, "Write a JPEG of five bodies, front, side and back, and nothing else");
  CLI11_PARSE(app, argc, argv);
  if (!sheet.empty()) {
    const auto error = draw_sheet(sheet);
    if (error) std::fprintf(stderr, "%s\n", error->message.c_str());
    return error ? error->exit_code() : 0;
  }
  int failed = 0;
  if (people > 0) failed += try_people(draw_people(people, seed), 2e-3, false, folder + "/people.csv");
  if (corners) {
    for (const bool accepted : {false, true}) {
      std::vector<Measurements> all = corner_people("woman", accepted);
      for (const Measurements& m : corner_people("man", accepted)) all.push_back(m);
      failed += try_people(all, 5e-3, true, folder + (accepted ? "/accepted_corners.csv" : "/corners.csv"));
    }
  }
  if (fields) failed += try_fields(folder + "/field.csv");
  if (!imports.empty()) failed += try_imports(imports);
  return failed == 0 ? 0 : 1;
}
