// SPDX-License-Identifier: GPL-3.0-or-later
#include "rooms.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "budget.hpp"

namespace vitrine {
namespace {

constexpr double residual_per_error = 1.5;   // [1/m] 1.5e-3 for each millimetre that --max-error allows,
constexpr double loosest_residual = 4.5e-3;  // and no more: at 1e-2 folds of flared skirts are left half-way
constexpr double above_floor = 0.05;         // [m] of a hem that follows the body's height, not a given length

double polygon_area(const std::vector<Vec2>& p) {
  double twice = 0;
  for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++) twice += p[j].x() * p[i].y() - p[i].x() * p[j].y();
  return std::abs(twice) / 2;
}

/// Longest edge [m] that still goes round the garment's limbs: a tube of fewer than about ten edges is a prism that its
/// limb does not fit through.
double longest_edge(const GarmentTemplate& garment, const Panel& panel) {
  const auto width = [&](int a, int b) {
    return (panel.outline[panel.corner[a]] - panel.outline[panel.corner[b]]).norm();
  };
  double longest = 1;
  for (const TemplateLimb& limb : garment.limbs)
    longest = std::min(longest, (width(limb.root_a, limb.root_b) + width(limb.tip_a, limb.tip_b)) / 2 / 5);
  return longest;
}

/// A back picture made of the mirrored front, mirrored once more into the front frame: the front itself, whose inside
/// is then the back's own cloth.
void fill_inside(Image& labels) {
  std::replace(labels.data.begin(), labels.data.end(), static_cast<std::uint8_t>(label_inside),
               static_cast<std::uint8_t>(label_outside));
}

}  // namespace

Settings settings_of(Quality quality) {
  // One way for all: every quality goes along it as far as it goes, so that a finer one is the coarser one refined, and
  // a request for an error may end anywhere on it. Steps of 1.8 in nodes cost no more than steps of 3: a level that
  // starts closer to rest needs fewer steps.
  static constexpr std::array levels{300, 1000, 2000, 3500, 6500, 11'500, 20'000};
  Settings settings;
  std::size_t count = levels.size();
  if (quality == Quality::draft) count = 1, settings.residual = 1e-2;
  if (quality == Quality::standard) count = 3;
  settings.level_nodes.assign(levels.begin(), levels.begin() + static_cast<long>(count));
  return settings;
}

Rooms::Step Rooms::check_request() {
  const auto& chosen = request_.fabric;
  const auto& fabrics = request_.garment.fabrics;
  const auto found = std::find_if(fabrics.begin(), fabrics.end(), [&](const Fabric& f) { return f.name == chosen; });
  if (chosen.empty() && !fabrics.empty()) {
    item_.fabric = fabrics.front();
  } else if (found != fabrics.end()) {
    item_.fabric = *found;
  } else {
    std::string names;
    for (const Fabric& f : fabrics) names += (names.empty() ? "" : ", ") + f.name;
    return Error{Cause::usage, "UNKNOWN_FABRIC",
                 "garment \"" + request_.garment.id + "\" has no fabric \"" + chosen + "\"", "choose one of: " + names,
                 ""};
  }
  return std::nullopt;
}

Rooms::Step Rooms::load_photos() {
  if (auto e = load_view(front_, item_.front)) return e;
  if (!request_.mirror_back) return load_view(back_, item_.back);
  item_.back.photo = item_.front.photo;
  fill_inside(item_.back.photo.mask);
  item_.warnings.push_back("MIRRORED_BACK");
  return std::nullopt;
}

Rooms::Step Rooms::find_silhouettes() {
  if (auto e = outline_view(front_, item_.front)) return e;
  if (!request_.mirror_back) return outline_view(back_, item_.back);
  item_.back.silhouette = item_.front.silhouette;
  fill_inside(item_.back.silhouette.labels);
  return std::nullopt;
}

Rooms::Step Rooms::find_feature_points() {
  if (auto e = name_points(front_, item_.front)) return e;
  return name_points(back_, item_.back);
}

PanelOptions Rooms::panel_options(double edge_length) const {
  PanelOptions options;
  options.edge_length = edge_length;
  options.chest = request_.chest;
  options.length = request_.length;
  const Mannequin& mannequin = request_.body->mannequin;
  options.girths = mannequin.girths;
  double hang = 0;
  int anchors = 0;
  for (const int feature : request_.garment.anchors) {
    const auto landmark = mannequin.landmarks.find(request_.garment.features[feature].landmark);
    if (landmark == mannequin.landmarks.end()) continue;  // the fit room refuses, and names it
    hang += landmark->second.y();
    ++anchors;
  }
  if (anchors > 0) options.room = hang / anchors - above_floor;
  for (const char* level : {"waist", "hip"}) {
    const auto landmark = mannequin.landmarks.find(level);
    const auto girth = mannequin.girths.find(level);
    if (anchors > 0 && landmark != mannequin.landmarks.end() && girth != mannequin.girths.end())
      options.levels.push_back({hang / anchors - landmark->second.y(), girth->second});
  }
  return options;
}

Rooms::Step Rooms::cut_panels() {
  // A first cut at a middling edge length only to learn the cloth's area.
  if (auto e = keep(make_panels(item_.front.features, item_.back.features, request_.garment, panel_options(0.03)),
                    item_.panels))
    return e;
  const double area = cloth_area_ = polygon_area(item_.panels.front.outline) + polygon_area(item_.panels.back.outline);
  const double longest =
      std::min(longest_edge(request_.garment, item_.panels.front), longest_edge(request_.garment, item_.panels.back));
  for (const int nodes : settings_.level_nodes) {
    // A hexagonal lattice of spacing h spends h^2 sqrt(3)/2 of area on each node.
    const double edge_length = std::min(longest, std::sqrt(area / (nodes * std::sqrt(3.0) / 2)));
    if (!levels_.empty() && edge_length > 0.95 * levels_.back().edge_length) continue;  // no finer than the one before
    Panels panels;
    if (auto e =
            keep(make_panels(item_.front.features, item_.back.features, request_.garment, panel_options(edge_length)),
                 panels))
      return e;
    Pattern pattern;
    pattern.panels = {panels.front, panels.back};
    pattern.pairs = panels.pairs;
    pattern.edge_length = edge_length;
    pattern.metres_per_pixel = panels.metres_per_pixel_front;
    levels_.push_back(std::move(pattern));
    cuts_.push_back(std::move(panels));
  }
  item_.panels = cuts_.back();
  for (const auto& list : {item_.front.warnings(), item_.back.warnings(), item_.panels.warnings})
    for (const auto& warning : list)
      if (std::find(item_.warnings.begin(), item_.warnings.end(), warning) == item_.warnings.end())
        item_.warnings.push_back(warning);
  return std::nullopt;
}

std::optional<Error> Rooms::mesh(Pattern& level) const {
  MeshOptions options;
  options.edge_length = level.edge_length;
  for (const Panel& panel : level.panels) {
    PanelMesh mesh;
    if (auto e = keep(mesh_panel(panel.outline, options), mesh)) return e;
    level.meshes.push_back(std::move(mesh));
  }
  return std::nullopt;
}

Rooms::Step Rooms::mesh_levels() {
  for (Pattern& level : levels_) {
    if (auto e = mesh(level)) return e;
    if (request_.budget.asked()) break;
  }
  item_.pattern = request_.budget.asked() ? levels_.front() : levels_.back();
  return std::nullopt;
}

Rooms::Step Rooms::place() {
  return keep(place_panels(request_.garment, levels_.front(), request_.body->mannequin, request_.body->field), placed_);
}

Rooms::Step Rooms::sew() {
  SewingOptions options;
  options.residual = settings_.residual;
  options.max_iterations = settings_.max_iterations;
  options.max_weight_strain = settings_.max_weight_strain;
  options.bending = settings_.bending;
  options.friction = settings_.friction;
  options.front_back = settings_.front_back;
  options.contact_between_nodes = settings_.contact_between_nodes;
  options.uncapped_at_rest = settings_.uncapped_at_rest;
  options.spring_k = request_.spring_k;
  options.node_mass = request_.node_mass;
  if (request_.progress)
    options.progress = [&](int level, int, double) {
      request_.progress("sewing", static_cast<double>(level) / static_cast<double>(levels_.size()));
    };
  const double rooms = work_of_rooms(request_, item_);
  const Budget& budget = request_.budget;
  options.max_error = budget.max_error;
  // Cloth that may be off by millimetres need not be balanced as well as a close look asks.
  if (budget.max_error > 0)
    options.residual = std::max(options.residual, std::min(residual_per_error * budget.max_error, loosest_residual));
  // What the other rooms take is not there to be sewn with; a single step is the least there is.
  if (budget.max_time > 0) options.max_work = std::max(1.0, budget.max_time * budget.work_rate - rooms);
  PatternLevels levels;
  for (std::size_t l = 0; l < levels_.size(); ++l)
    levels.nodes.push_back(
        static_cast<int>(cloth_area_ / (levels_[l].edge_length * levels_[l].edge_length * std::sqrt(3.0) / 2)));
  levels.at = [&](int level) -> Result<const Pattern*> {
    if (levels_[level].meshes.empty())
      if (auto e = mesh(levels_[level])) return *e;
    return &levels_[level];
  };
  if (auto e = keep(sew_and_drape(levels, placed_, item_.fabric, request_.body->field, options), item_.drape)) return e;
  if (budget.asked()) {
    item_.pattern = levels_[item_.drape.level];
    item_.panels = cuts_[item_.drape.level];
    item_.budget = judge_budget(request_, item_.drape, rooms, item_.warnings);
  }
  if (item_.drape.stretch_p99 > 0.35) item_.warnings.push_back("TIGHT_FIT");
  double lowest = 0;
  for (const auto& panel : item_.drape.positions)
    for (const Vec3& p : panel) lowest = std::min(lowest, p.y());
  if (lowest < -0.005)
    item_.warnings.push_back("BELOW_FLOOR: the garment hangs " + std::to_string(std::lround(-1000 * lowest)) +
                             " mm below the mannequin's soles; check --length-cm");
  // Cloth that came close to rest is worth showing; anything worse is marked by the exit code, and still written.
  if (item_.drape.status == "NOT_CONVERGED" && item_.drape.residual <= 1e-2)
    item_.warnings.push_back("RESIDUAL_ABOVE_TARGET");
  return std::nullopt;
}

Rooms::Step Rooms::judge_drape() {
  // Last of all, with every file made: a drape that failed is an error that the exit code has to show.
  const Drape& drape = item_.drape;
  const bool close_enough = drape.status == "NOT_CONVERGED" && drape.residual <= 1e-2;
  if (drape.status != "OK" && !close_enough)
    return Error{
        Cause::unusable, drape.status, request_.front + ": " + drape.detail,
        "the files are written and marked; check the feature points with --debug-images, the size with --chest-cm "
        "or --length-cm, or choose another fabric or mannequin",
        "sewing"};
  return std::nullopt;
}

}  // namespace vitrine
