// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vitrine/pipeline.hpp"

namespace vitrine {

/// The garment at rest as one surface [m]: sewn nodes are one vertex, triangles face away from the body.
TriMesh garment_surface(const Pattern& pattern, const Drape& drape);

/// How far two surfaces lie apart, from samples that are uniform over the area of each to the nearest place of the
/// other, both ways together.
struct SurfaceDistance {
  double mean_mm = 0, p95_mm = 0, max_mm = 0;
};
/// `samples` on each side, the same ones at every call. Both need an area. Cloth that slides along itself counts
/// nothing; hem and girths tell that.
SurfaceDistance surface_distance(const TriMesh& a, const TriMesh& b, int samples = 20'000);

/// What a tape around the garment reads at `height` [m]: perimeter of the convex hull of its section there, of the ring
/// that goes round (x, z) alone, so that sleeves do not count. None where no closed ring does.
std::optional<double> girth_at(const TriMesh& garment, double height, const Vec2& x_z);

/// Height [m] of the lowest hem: of the surface's borders the one that lies lowest on the mean, and its mean height.
/// None for a closed surface.
std::optional<double> hem_height(const TriMesh& garment);

/// One way of making an item.
struct Setting {
  std::string name;         ///< "standard", or "nodes=4000"
  std::string knob, value;  ///< empty for the three qualities
  Settings settings;
  double voxel = 0;  ///< [m] edge of the mannequin's voxels; 0 = as they are
};
enum class Grid { none, shortened, full };
/// Those of `coarser` that leave a step of a quarter in the edge length to `nodes`, then `nodes`.
std::vector<int> levels_up_to(const std::vector<int>& coarser, int nodes);
/// The qualities, and standard with one knob at a time turned.
std::vector<Setting> settings_to_measure(Grid grid);

/// One row of runs.csv. What could not be measured is not there: no reference, no ring around the body, no files.
struct RunRow {
  std::string item, source, garment, setting, knob, value;
  int nodes = 0;
  double residual = 0;
  std::string status;  ///< of the drape, or the code of the room that refused
  double cpu_ms = 0, sewing_ms = 0, peak_mb = 0;
  std::optional<double> mean_mm, p95_mm, max_mm, hem_mm, waist_mm, chest_mm;
  std::optional<double> iou, landmark_mm;
  std::optional<double> seam_gap_mm, penetration_mm, estimate_mm, spread_mm;
};

/// What turning on one effect that standard skipped would have changed.
struct EffectRow {
  std::string item, effect, reason;
  std::optional<double> change_mean_mm, change_max_mm, extra_ms;  ///< none: the engine has no such effect
};

/// An item to be measured: what converts it, or why it cannot be.
struct MeasuredItem {
  std::string name, source;
  ConvertRequest request;
  std::optional<Error> refusal;
};

struct MeasureOptions {
  std::string out_dir;
  Grid grid = Grid::none;
  bool effects = true;
  int reference_nodes = 40'000;
  double reference_residual = 1e-6;
  int reference_iterations = 20'000;  ///< per level; a budget of work
  double max_error = 0;               ///< [m] also made with this asked for; 0 = not
  int jobs = 1;                       ///< items at a time
  std::string version;                ///< of the program, for the summary
  std::function<void(const std::string&)> say;
};

/// The best that the program can do for an item, twice: from two starts.
struct ReferenceRow {
  std::string item;
  int nodes = 0;
  double residual_a = 0, residual_b = 0;
  std::string status_a, status_b;
  double cpu_ms = 0;  ///< of both
  std::optional<double> spread_mean_mm, spread_p95_mm, spread_max_mm, spread_hem_mm, spread_waist_mm, spread_chest_mm;
};

/// What --max-error came to: the fine levels with a budget, ended by the item's own estimate.
struct BudgetRow {
  std::string item, status;
  double asked_mm = 0;
  std::optional<double> estimated_mm, true_mm;
  double cpu_ms = 0, fine_cpu_ms = 0, sewing_ms = 0, fine_sewing_ms = 0;
  std::string met;  ///< "yes", "no", or "unknown" without a reference
};

/// All that was found.
struct Measurement {
  std::vector<RunRow> runs;
  std::vector<EffectRow> effects;
  std::vector<ReferenceRow> references;
  std::vector<BudgetRow> budgets;
};

/// Makes every item in every setting and compares with its reference, each run in a forked process of its own, whose
/// memory and processor time are its own. References are kept in out_dir/references under what standard made of the
/// item, so that a run that was stopped goes on. Call before any thread is started. Error: CANNOT_WRITE (73), FORK
/// (75).
Result<Measurement> measure(const std::vector<MeasuredItem>& items, const MeasureOptions& options);

/// Settings whose cost no other undercuts at the same or a smaller error: indices in the order of their cost.
std::vector<std::size_t> pareto_front(const std::vector<double>& cost, const std::vector<double>& error);

std::string runs_csv(const std::vector<RunRow>& runs);
std::string effects_csv(const std::vector<EffectRow>& effects);
std::string references_csv(const std::vector<ReferenceRow>& references);
std::string budgets_csv(const std::vector<BudgetRow>& budgets);

/// Means over the items of one setting; of items that have a reference and came out.
struct SettingMeans {
  std::string setting, knob, value;
  int items = 0, refused = 0;
  double nodes = 0, cpu_ms = 0, sewing_ms = 0, peak_mb = 0;
  double mean_mm = 0, p95_mm = 0, max_mm = 0, hem_mm = 0, waist_mm = 0, chest_mm = 0, iou = 0, landmark_mm = 0;
  double worst_mean_mm = 0;  ///< of the items' mean distances
  int with_reference = 0, with_hem = 0, with_waist = 0, with_chest = 0, with_iou = 0;
};
std::vector<SettingMeans> means_by_setting(const std::vector<RunRow>& runs);

/// Writes runs.csv, effects.csv, references.csv, budget.csv when an error was asked for, pareto.svg, pareto.png,
/// knobs.svg, summary.json and measure.md.
std::optional<Error> write_measurement(const Measurement& measurement, const MeasureOptions& options);

}  // namespace vitrine
