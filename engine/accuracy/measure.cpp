// SPDX-License-Identifier: GPL-3.0-or-later
#include <poll.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "child.hpp"
#include "made.hpp"
#include "rows.hpp"

namespace vitrine {
namespace {

using namespace accuracy;

std::string text(const char* format, double a, double b = 0) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

std::optional<double> apart_mm(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::optional<double>(1000 * std::abs(*a - *b)) : std::nullopt;
}

/// The two references of an item. The second goes through other levels: it meets the body with other folds, and is as
/// right as the first.
Settings reference_settings(const MeasureOptions& options, bool second) {
  Settings settings = settings_of(Quality::fine);
  settings.level_nodes =
      levels_up_to(second ? std::vector<int>{500, 3500, 12'000} : settings.level_nodes, options.reference_nodes);
  settings.residual = options.reference_residual;
  settings.max_iterations = options.reference_iterations;
  return settings;
}

/// What of a drape's skipped effects can be turned on, by how the drape's list calls it.
struct Switch {
  const char* effect;
  void (*turn_on)(Settings&);
};
constexpr Switch switches[] = {
    {"contact between nodes", [](Settings& s) { s.contact_between_nodes = true; }},
    {"contact of front and back", [](Settings& s) { s.front_back = FrontBack::always; }},
    {"stiffness above", [](Settings& s) { s.uncapped_at_rest = true; }},
};

/// One item, from its first run to its last row.
class Study {
 public:
  Study(const MeasuredItem& item, const MeasureOptions& options, const std::vector<Setting>& settings,
        const Bodies& bodies)
      : item_(item), o_(options), settings_(settings), bodies_(bodies) {}

  Measurement run() {
    for (const Setting& setting : settings_) {
      Made made;
      if (item_.refusal)
        made.status = item_.refusal->code, made.message = item_.refusal->message;
      else
        made = make_with(setting);
      out_.runs.push_back(row_of(setting, made));
      const RunRow& row = out_.runs.back();
      say(setting.name + ": " + row.status + text(", %.0f nodes, %.0f ms", row.nodes, row.cpu_ms) +
          (made.message.empty() ? "" : " (" + made.message + ")"));
      made_.push_back(std::move(made));
      if (setting.name == "standard") {
        standard_ = made_.back();
        // What is refused at standard is refused before the settings matter: two rows say so.
        if (!standard_.draped()) break;
      }
    }
    if (standard_.draped()) {
      compare_with_references();
      if (o_.max_error > 0) ask_for_an_error();
      if (o_.effects) turn_effects_on();
    }
    return std::move(out_);
  }

 private:
  void say(const std::string& what) const {
    if (o_.say) o_.say(item_.name + ": " + what);
  }

  Made make_with(const Setting& setting) const {
    ConvertRequest request = item_.request;
    if (setting.voxel > 0) {
      const auto body = bodies_.find(setting.voxel);
      if (body == bodies_.end()) {
        Made none;
        none.status = "NO_VOXELS";
        return none;
      }
      request.body = body->second;
    }
    return make(request, setting.settings, true);
  }

  RunRow row_of(const Setting& setting, const Made& made) const {
    RunRow row;
    row.item = item_.name;
    row.source = item_.source;
    row.garment = item_.request.garment.id;
    row.setting = setting.name;
    row.knob = setting.knob;
    row.value = setting.value;
    row.status = made.status;
    row.nodes = made.nodes;
    row.residual = made.residual;
    row.cpu_ms = made.cpu_ms;
    row.sewing_ms = made.sewing_ms;
    row.peak_mb = made.peak_mb;
    if (!made.draped()) return row;
    row.iou = made.iou;
    row.landmark_mm = made.landmark_mm;
    row.seam_gap_mm = made.seam_gap_mm;
    row.penetration_mm = made.penetration_mm;
    row.estimate_mm = made.estimate_mm;
    return row;
  }

  Made reference(bool second) {
    const Settings settings = reference_settings(o_, second);
    // What standard made of the item depends on all that a reference depends on: photos, options, plugins, fabric,
    // mannequin and the program.
    std::string key = "1 ";
    for (const int n : settings.level_nodes) key += std::to_string(n) + " ";
    key += text("%.17g %.0f ", settings.residual, settings.max_iterations);
    const auto& x = standard_.surface.vertices;
    key.append(reinterpret_cast<const char*>(x.data()), x.size() * sizeof(Vec3));
    const std::string file = o_.out_dir + "/references/" + hash_of(key) + ".bin";
    if (std::ifstream in(file, std::ios::binary); in) {
      const Bytes bytes{std::istreambuf_iterator<char>(in), {}};
      if (auto kept = from_bytes(bytes)) return *std::move(kept);
    }
    Made made = make(item_.request, settings, false);
    // A folder that cannot be written to costs the next run time, and this one nothing: its results will say so.
    if (made.draped()) write_file(file, to_bytes(made));
    return made;
  }

  /// What is balanced no better than fine is no reference for it; its row shows the residual.
  bool is_reference(const Made& made) const {
    const double fine = settings_of(Quality::fine).residual;
    return made.comparable() && made.residual <= std::max(fine, 1.05 * o_.reference_residual);
  }

  void compare_with_references() {
    reference_ = reference(false);
    const Made& a = reference_;
    say("reference: " + a.status + text(", residual %.1e, %.0f s", a.residual, a.sewing_ms / 1000));
    const Made b = reference(true);
    say("from another start: " + b.status + text(", residual %.1e, %.0f s", b.residual, b.sewing_ms / 1000));
    ReferenceRow row;
    row.item = item_.name;
    row.nodes = a.nodes;
    row.residual_a = a.residual;
    row.residual_b = b.residual;
    row.status_a = a.status;
    row.status_b = b.status;
    row.cpu_ms = a.cpu_ms + b.cpu_ms;
    if (is_reference(a) && is_reference(b)) {
      const SurfaceDistance d = surface_distance(a.surface, b.surface);
      row.spread_mean_mm = d.mean_mm;
      row.spread_p95_mm = d.p95_mm;
      row.spread_max_mm = d.max_mm;
      row.spread_hem_mm = apart_mm(a.hem, b.hem);
      row.spread_waist_mm = apart_mm(a.waist, b.waist);
      row.spread_chest_mm = apart_mm(a.chest, b.chest);
    }
    out_.references.push_back(row);
    if (!is_reference(a)) return;
    for (std::size_t i = 0; i < made_.size(); ++i) {
      const Made& made = made_[i];
      RunRow& run = out_.runs[i];
      run.spread_mm = row.spread_mean_mm;
      if (!made.comparable()) continue;
      const SurfaceDistance d = surface_distance(made.surface, a.surface);
      run.mean_mm = d.mean_mm;
      run.p95_mm = d.p95_mm;
      run.max_mm = d.max_mm;
      run.hem_mm = apart_mm(made.hem, a.hem);
      run.waist_mm = apart_mm(made.waist, a.waist);
      run.chest_mm = apart_mm(made.chest, a.chest);
    }
    for (const RunRow& run : out_.runs)
      if (run.knob.empty() && run.mean_mm)
        say(run.setting +
            text(": %.2f mm from the reference, spread %.2f mm", *run.mean_mm, run.spread_mm.value_or(0)));
  }

  void ask_for_an_error() {
    ConvertRequest request = item_.request;
    request.budget.max_error = o_.max_error;
    const Made made = make(request, settings_of(Quality::fine), true);
    BudgetRow row;
    row.item = item_.name;
    row.status = made.status;
    row.asked_mm = 1000 * o_.max_error;
    row.estimated_mm = made.estimate_mm;
    row.cpu_ms = made.cpu_ms;
    row.sewing_ms = made.sewing_ms;
    for (const RunRow& run : out_.runs)
      if (run.setting == "fine") row.fine_cpu_ms = run.cpu_ms, row.fine_sewing_ms = run.sewing_ms;
    row.met = "unknown";
    if (made.comparable() && is_reference(reference_)) {
      row.true_mm = surface_distance(made.surface, reference_.surface).mean_mm;
      row.met = *row.true_mm <= row.asked_mm ? "yes" : "no";
      say(text("asked %.1f mm: %.2f mm from the reference", row.asked_mm, *row.true_mm));
    }
    out_.budgets.push_back(std::move(row));
  }

  void turn_effects_on() {
    for (const std::string& skipped : standard_.skipped) {
      const auto colon = skipped.find(": ");
      EffectRow row{item_.name,
                    skipped.substr(0, colon),
                    colon == std::string::npos ? std::string() : skipped.substr(colon + 2),
                    {},
                    {},
                    {}};
      for (const Switch& effect : switches) {
        if (!row.effect.starts_with(effect.effect)) continue;
        row.effect = effect.effect;
        if (row.effect == "stiffness above") row.effect = "stiffness above its cap";
        Settings settings = settings_of(Quality::standard);
        effect.turn_on(settings);
        const Made made = make(item_.request, settings, false);
        if (!made.comparable() || !standard_.comparable()) continue;
        const SurfaceDistance d = surface_distance(made.surface, standard_.surface);
        row.change_mean_mm = d.mean_mm;
        row.change_max_mm = d.max_mm;
        row.extra_ms = made.sewing_ms - standard_.sewing_ms;
        say(row.effect + text(" turned on: %.2f mm, %.0f ms more", d.mean_mm, *row.extra_ms));
      }
      out_.effects.push_back(std::move(row));
    }
  }

  const MeasuredItem& item_;
  const MeasureOptions& o_;
  const std::vector<Setting>& settings_;
  const Bodies& bodies_;
  Made standard_, reference_;
  std::vector<Made> made_;  ///< one for each of out_.runs
  Measurement out_;
};

/// The mannequin with other voxels, those of the last item's mannequin alone are kept.
class VoxelShelf {
 public:
  explicit VoxelShelf(const std::vector<Setting>& settings) : settings_(settings) {}

  const Bodies& of(const std::shared_ptr<const Body>& body) {
    if (body == last_ || !body) return bodies_;
    last_ = body;
    bodies_.clear();
    for (const Setting& setting : settings_) {
      if (!(setting.voxel > 0) || bodies_.count(setting.voxel) > 0) continue;
      VoxelOptions options;
      options.spacing = setting.voxel;
      auto field = voxelise(body->mannequin.mesh, options);
      if (!field) continue;  // the study finds none, and its row says so
      bodies_[setting.voxel] = std::make_shared<Body>(Body{body->mannequin, *std::move(field)});
    }
    return bodies_;
  }

 private:
  const std::vector<Setting>& settings_;
  std::shared_ptr<const Body> last_;
  Bodies bodies_;
};

}  // namespace

Result<Measurement> measure(const std::vector<MeasuredItem>& items, const MeasureOptions& options) {
  std::error_code failed;
  std::filesystem::create_directories(options.out_dir + "/references", failed);
  if (failed || !std::filesystem::is_directory(options.out_dir + "/references", failed))
    return Error{Cause::unwritable, "CANNOT_WRITE", options.out_dir + ": the output folder cannot be made",
                 "name a folder that you may write to with --out", "measure"};
  const std::vector<Setting> settings = settings_to_measure(options.grid);
  VoxelShelf shelf(settings);
  std::vector<Child> children(items.size());
  std::vector<Measurement> done(items.size());
  const auto gather = [&] {
    Measurement all;
    for (const Measurement& part : done) append(all, part);
    return all;
  };
  std::size_t next = 0, running = 0, ended = 0;
  while (ended < items.size()) {
    for (; next < items.size() && running < static_cast<std::size_t>(options.jobs); ++next, ++running) {
      const MeasuredItem& item = items[next];
      const Bodies& bodies = shelf.of(item.request.body);
      auto child = start([&] { return to_bytes(Study(item, options, settings, bodies).run()); });
      if (!child)
        return Error{Cause::temporary, "FORK", "no further process could be started", "run again with fewer --jobs",
                     "measure"};
      children[next] = *std::move(child);
    }
    std::vector<pollfd> wait;
    std::vector<std::size_t> who;
    for (std::size_t i = 0; i < next; ++i)
      if (children[i].pipe >= 0) wait.push_back({children[i].pipe, POLLIN, 0}), who.push_back(i);
    if (poll(wait.data(), wait.size(), -1) < 0) continue;  // a signal that does not end this process
    for (std::size_t k = 0; k < wait.size(); ++k) {
      if (wait[k].revents == 0 || !listen(children[who[k]])) continue;
      Child& child = children[who[k]];
      const MeasuredItem& item = items[who[k]];
      auto part = child.fine ? measurement_from(child.sent) : std::nullopt;
      if (!part) {
        RunRow row;
        row.item = item.name;
        row.source = item.source;
        row.garment = item.request.garment.id;
        row.status = "CRASHED";
        part.emplace();
        part->runs.push_back(std::move(row));
      }
      done[who[k]] = *std::move(part);
      child = {};
      --running;
      ++ended;
      if (options.say) options.say(std::to_string(ended) + " of " + std::to_string(items.size()) + " items measured");
      // So far as it has come: who stops a long run has this.
      if (auto e = write_measurement(gather(), options)) return *e;
    }
  }
  return gather();
}

}  // namespace vitrine
