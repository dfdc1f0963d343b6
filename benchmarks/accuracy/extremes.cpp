// SPDX-License-Identifier: GPL-3.0-or-later
#include "extremes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>

#include "../body_people.hpp"

namespace vitrine::bench {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().code + ": " + result.error().message);
  return *std::move(result);
}

template <class... Numbers>
std::string text(const char* format, Numbers... numbers) {
  char buffer[120];
  std::snprintf(buffer, sizeof buffer, format, numbers...);
  return buffer;
}

PluginRegistry load_plugins() {
  PluginSearch search;
  search.folders = {std::string(VITRINE_BINARY_DIR) + "/lib/vitrine-1/plugins"};
  search.built_in = false;
  return PluginRegistry::load(search);
}

std::shared_ptr<const Body> build_woman() {
  auto body = std::make_shared<Body>();
  body->mannequin = must(build_mannequin(must(preset_measurements("woman-m"))));
  body->field = must(voxelise(body->mannequin.mesh));
  return body;
}

}  // namespace

Extremes::Extremes(std::string folder, std::string meshes)
    : folder_(std::move(folder)),
      mesh_folder_(std::move(meshes)),
      registry_(load_plugins()),
      woman_(build_woman()),
      vest_(see_garment(draw_garment(support::GarmentKind::vest, folder_), registry_, woman_)),
      sleeves_(see_garment(draw_garment(support::GarmentKind::long_sleeve, folder_), registry_, woman_)),
      trousers_(see_garment(draw_garment(support::GarmentKind::trousers, folder_), registry_, woman_)) {}

void Extremes::each_case(const Take& take) const {
  constants(take);
  sheets(take);
  meshes(take);
  mannequins(take);
  photos(take);
}

void Extremes::constants(const Take& take) const {
  const auto raw = [this](double k, double m, double bend_times = 1) {
    Dressing d;
    d.fabric = vest_.garment.fabrics.front();
    d.fabric.bend *= bend_times;
    d.sewing.spring_k = k;
    d.sewing.node_mass = m;
    return dress_garment(vest_, *woman_, d);
  };
  for (int k = -2; k <= 7; ++k)
    for (const int m : {-6, -5, -4, -3, -2, 0})
      take("k and m", text("k=1e%d m=1e%d", k, m),
           [=] { return outcome_of(raw(std::pow(10.0, k), std::pow(10.0, m))); });
  for (const auto& [name, k, m] : {std::tuple{"k negative", -1.0, 1e-4}, std::tuple{"m negative", 1e3, -1e-4},
                                   std::tuple{"k no number", nan, 1e-4}, std::tuple{"m no number", 1e3, nan},
                                   std::tuple{"k infinite", infinity, 1e-4}, std::tuple{"m infinite", 1e3, infinity}})
    take("k and m", name, [=, k = k, m = m] { return outcome_of(raw(k, m)); });
  for (const int power : {-10, 3, 12})
    take("scaling law", text("k and m and bend times 2^%d", power), [=] {
      const auto one = raw(1e3, 1e-4),
                 other = raw(std::ldexp(1e3, power), std::ldexp(1e-4, power), std::ldexp(1.0, power));
      Outcome o = outcome_of(other);
      if (!one || !other) return o;
      bool same = one->positions.size() == other->positions.size();
      for (std::size_t p = 0; same && p < one->positions.size(); ++p)
        same = one->positions[p].size() == other->positions[p].size() &&
               std::memcmp(one->positions[p].data(), other->positions[p].data(),
                           one->positions[p].size() * sizeof(Vec3)) == 0;
      if (!same) o.status = "DIFFERS";
      o.note = same ? "the same bytes as with k and m themselves" : "another shape than with k and m themselves";
      return o;
    });
}

void Extremes::sheets(const Take& take) const {
  const auto with = [&](const std::string& group, const std::string& name,
                        const std::function<void(Dressing&)>& change) {
    take(group, name, [this, change] {
      Dressing d;
      d.fabric = vest_.garment.fabrics.front();
      change(d);
      return outcome_of(dress_garment(vest_, *woman_, d));
    });
  };
  for (const double v : {0.0, 1e-3, 1.0, 30.0, 1e5, 1e7, 1e9, 1e300, -1.0, nan, infinity})
    with("sheet stiffness", text("stretch %g N/m", v), [v](Dressing& d) { d.fabric.stretch = v; });
  for (const double v : {0.0, 1e7, -1.0})
    with("sheet stiffness", text("shear %g N/m", v), [v](Dressing& d) { d.fabric.shear = v; });
  for (const double v : {0.0, 1e-9, 1e-4, 1e-2, 1.0, 1e3, -1.0, nan})
    with("bending", text("bend %g N m", v), [v](Dressing& d) { d.fabric.bend = v; });
  for (const double v : {0.0, 1e-6, 0.02, 2.0, 20.0, 1e3, 1e6, -1.0, nan})
    with("mass", text("%g kg/m^2", v), [v](Dressing& d) { d.fabric.mass = v; });
  for (const double v : {0.0, 0.01, 1.0, 100.0, -1.0, infinity})
    with("friction", text("mu %g", v), [v](Dressing& d) { d.fabric.friction = v; });
  for (const double v : {0.0, 1e-3, 98.1, 981.0, 9810.0, -9.81, nan})
    with("gravity", text("%g m/s^2", v), [v](Dressing& d) { d.sewing.gravity = v; });
  for (const double v : {1.0, 1e-6, 1e-16, 0.0, -1.0, nan})
    with("residual", text("stop at %g", v), [v](Dressing& d) { d.sewing.residual = v; });
  for (const double v : {0.0, 1e-4, 0.02, 0.1, 1.0, -0.01})
    with("skin offset", text("%g m", v), [v](Dressing& d) { d.sewing.offset = v; });
  for (const int v : {0, 1, 100, -1})
    with("budget", text("%d steps a level", v), [v](Dressing& d) { d.sewing.max_iterations = v; });
}

void Extremes::meshes(const Take& take) const {
  const std::vector<std::vector<int>> levels = {
      {60},    {150}, {300},      {300, 2000}, {300, 2000, 6500, 20000}, {300, 2000, 6500, 20000, 40000},
      {20000}, {4},   {1'000'000}};
  for (const auto& nodes : levels) {
    const std::string way = nodes.size() == 1 ? "at once" : text("over %d levels", static_cast<int>(nodes.size()));
    take("mesh size", text("%d nodes %s", nodes.back(), way.c_str()), [this, nodes] {
      Dressing d;
      d.level_nodes = nodes;
      d.sewing.residual = nodes.back() > 300 ? 1e-3 : 1e-2;
      return outcome_of(dress_garment(vest_, *woman_, d));
    });
  }
  for (const double spacing : {0.002, 0.003, 0.006, 0.012, 0.025, 0.05, 0.2, 1e-5, 0.0, -0.006, nan})
    take("voxel size", text("%g mm", 1000 * spacing), [this, spacing] {
      VoxelOptions options;
      options.spacing = spacing;
      const auto field = voxelise(woman_->mannequin.mesh, options);
      if (!field) return outcome_of(field.error());
      Body body{woman_->mannequin, *field};
      Outcome o = outcome_of(dress_garment(vest_, body, {}));
      return o;
    });
}

void Extremes::mannequins(const Take& take) const {
  const auto dressed = [this](const Result<Mannequin>& mannequin, const SeenGarment& item) {
    if (!mannequin) return outcome_of(mannequin.error());
    Body body{*mannequin, {}};
    const auto field = voxelise(body.mannequin.mesh);
    if (!field) return outcome_of(field.error());
    body.field = *field;
    return outcome_of(dress_garment(item, body, {}));
  };
  const std::pair<const char*, const SeenGarment*> items[] = {
      {"vest", &vest_}, {"long sleeve", &sleeves_}, {"trousers", &trousers_}};
  for (const auto& [what, item] : items) {
    for (const char* who : {"woman-xs", "woman-xxl", "man-xs", "man-xxl"})
      take("mannequin", std::string(who) + " " + what,
           [=, item = item] { return dressed(build_mannequin(must(preset_measurements(who))), *item); });
    if (!mesh_folder_.empty() && std::filesystem::is_directory(mesh_folder_)) {
      std::vector<std::string> files;
      for (const auto& entry : std::filesystem::directory_iterator(mesh_folder_))
        if (entry.path().extension() == ".obj") files.push_back(entry.path().string());
      std::sort(files.begin(), files.end());
      for (const std::string& file : files)
        take("mannequin", std::filesystem::path(file).stem().string() + " " + what,
             [=, item = item] { return dressed(import_mannequin(file), *item); });
    }
  }
  // Every accepted corner is built by vitrine-body-bench; a corner in 37 of both sexes is dressed here.
  for (const char* sex : {"woman", "man"}) {
    const auto corners = corner_people(sex, true);
    for (std::size_t i = 0; i < corners.size(); i += 37)
      take("mannequin", text("%s corner %d of %d vest", sex, static_cast<int>(i), static_cast<int>(corners.size())),
           [=, this] { return dressed(build_mannequin(corners[i]), vest_); });
  }
  const auto changed = [&](const char* name, const std::function<void(Measurements&)>& change) {
    Measurements m;
    change(m);
    take("mannequin", name, [=, this] { return dressed(build_mannequin(m), vest_); });
  };
  changed("height 0.1 m", [](Measurements& m) { m.height = 0.1; });
  changed("height 20 m", [](Measurements& m) { m.height = 20; });
  changed("height no number", [](Measurements& m) { m.height = nan; });
  changed("waist negative", [](Measurements& m) { m.waist = -0.7; });
  changed("waist wider than the hips by half", [](Measurements& m) { m.waist = 1.5 * m.hip; });
  changed("legs as long as the body", [](Measurements& m) { m.inside_leg = m.height; });
  take("mannequin", "no body at all", [this] {
    return outcome_of(dress_garment(vest_, Body{woman_->mannequin, {}}, {}));
  });
}

}  // namespace vitrine::bench
