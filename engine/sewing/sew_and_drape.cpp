// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>

#include "audit.hpp"
#include "checks.hpp"
#include "contact.hpp"
#include "effects.hpp"
#include "estimate.hpp"
#include "layers.hpp"
#include "prolong.hpp"
#include "relax.hpp"
#include "residual.hpp"
#include "sew.hpp"
#include "verdict.hpp"
#include "vitrine/sewing.hpp"

namespace vitrine {
namespace {

using namespace sewing;

constexpr double gap_bar = 0.001;  // [m] partners must be at least this close before they are welded
constexpr double near_by = 0.03;   // [m] partners that start closer than this are sewn first
constexpr int sewing_rounds = 4;
// A finer mesh is there to be made: estimates are up to 1.5 times too small for one item in ten.
constexpr double safety = 1.25;
constexpr double close_to_rest = 1e-2;  // [-] residual from which on a garment is worth showing

// Work is counted in node steps: one step of one node of cloth. What else a level costs, in the same unit.
constexpr double step_cost = 1, layers_cost = 1.5;
constexpr double level_cost = 200;  // per node: springs, contact, lattices and welding
constexpr double likely_steps = 1500,
                 finishing_steps = 300;  // of a level, and from the coarse residual to close_to_rest

Vec3 middle(const Cloth& c) {
  Vec3 sum = Vec3::Zero();
  for (int n = 0; n < c.size; ++n) sum += c.at(n);
  return sum / c.size;
}

double height(const Pattern& p) {
  double most = 0;
  for (const PanelMesh& m : p.meshes) {
    double lo = m.nodes.front().y(), hi = lo;
    for (const Vec2& q : m.nodes) lo = std::min(lo, q.y()), hi = std::max(hi, q.y());
    most = std::max(most, hi - lo);
  }
  return most;
}

/// One mesh level as it is worked on.
struct Stage {
  int level = 0;
  const Pattern* pattern = nullptr;
  Positions x, before;  ///< now, and as the level before left it
  std::vector<char> weld;
  Closing closing;
  Nodes nodes;
  Cloth cloth;
  Contact contact;
  double residual = 0;    ///< [-] where the relaxation ended
  bool finished = false;  ///< brought to the final residual, and what was skipped was looked at
};

/// Walks the levels; one member function per step of the story.
class Tailor {
 public:
  Tailor(const PatternLevels& levels, const Fabric& fabric, double column, const DistanceField& body,
         const SewingOptions& options)
      : levels_(levels), fabric_(fabric), body_(body), o_(options), column_(column) {
    sheet_ = {fabric.stretch, fabric.shear, fabric.bend};
    if (column_ > 0 && o_.max_weight_strain > 0 && !(o_.spring_k > 0)) {
      // Beyond this stiffness the cloth hardly stretches under its weight, but the work grows with sqrt(k).
      const double cap = column_ / o_.max_weight_strain;
      if (sheet_.stretch > cap || sheet_.shear > cap) out_.stiffness_cap = cap;
      sheet_.stretch = std::min(sheet_.stretch, cap);
      sheet_.shear = std::min(sheet_.shear, cap);
    }
    k_ = std::max(sheet_.stretch, sheet_.shear);
  }

  Result<Drape> run(const Pattern& first, const Positions& placed) {
    now_.pattern = &first;
    now_.x = placed;
    now_.weld.assign(first.pairs.size(), 0);
    for (;;) {
      if (!fallen_ && (!sew() || !drape())) return broken();  // what falls keeps its shape on the finer meshes
      if (!fallen_ && !last() && !given_up() && (good_enough() || !time_for_another())) {
        if (!finish()) return broken();
        // The last steps may have brought to light that it was not.
        if (!given_up() && (!(o_.max_error > 0) || good_enough() || !time_for_another())) break;
      }
      if (given_up()) {
        take_up_the_one_before();
        if (!finish()) return broken();
        break;
      }
      if (last()) break;
      if (fallen_ && budgeted()) break;
      if (auto e = carry_to_finer()) return *e;
    }
    return report();
  }

 private:
  const Pattern& pattern() const { return *now_.pattern; }
  bool last() const { return now_.level + 1 == levels_.count(); }
  bool budgeted() const { return o_.max_error > 0 || o_.max_work > 0; }

  Cloth cloth_of(const Nodes& nodes, int count) const {
    Cloth cloth = build_cloth(pattern(), nodes, count, now_.x, sheet_, fabric_.mass, o_.gravity, o_.bending);
    // The paper's own constants belong to one mesh, the last; coarser ones are the same cloth as a sheet.
    if (last()) set_raw_constants(cloth, o_.spring_k, o_.node_mass);
    return cloth;
  }

  Contact contact_for(const Cloth& cloth, double dx) const {
    // A node's ordinary load: the column of cloth that hangs below it.
    return make_contact(cloth, body_, o_.offset, 2 * column_ * dx, k_, middles_ ? Middles::all : Middles::where_needed);
  }

  /// Draws the partners that are not sewn yet together and sews those that meet, in rounds: first the pairs that start
  /// next to each other (a sleeve laid around its arm closes before the trunk pulls on it), then all; a round that
  /// sewed some is followed by another, as a seam closes from its sewn end. What stays open on a coarse mesh, whose
  /// straight edges make every tube narrower, gets another chance on the finer ones.
  bool sew() {
    const Pattern& p = pattern();
    const double dx = mean_edge(p);
    steps_ = 0;
    out_.work += level_cost * nodes_of(p);
    work_before_ = out_.work;
    const std::vector<double> start = gaps(p, now_.x);
    for (int round = 0; round < sewing_rounds; ++round) {
      std::vector<char> left_alone = now_.weld;
      if (round == 0)
        for (std::size_t s = 0; s < start.size(); ++s) left_alone[s] = now_.weld[s] || start[s] > near_by;
      if (std::find(left_alone.begin(), left_alone.end(), 0) == left_alone.end()) continue;
      int count = 0;
      const Nodes nodes = number_nodes(p, now_.weld, count);
      Cloth cloth = cloth_of(nodes, count);
      push_out(cloth, body_, o_.offset);
      Contact contact = contact_for(cloth, dx);
      now_.closing = close_seams(cloth, contact, p, nodes, left_alone, k_, dx, gap_bar);
      gap_met_ = std::max(gap_met_, now_.closing.gap_met);
      steps_ += now_.closing.iterations;
      out_.work += step_cost * now_.closing.iterations * cloth.size;
      now_.x = scatter(cloth, nodes);
      if (!now_.closing.finite) return false;
      bool sewed = false;
      for (std::size_t s = 0; s < now_.weld.size(); ++s) {
        if (now_.weld[s] || left_alone[s] || !now_.closing.met[s]) continue;
        now_.weld[s] = 1;
        sewed = true;
      }
      if (round > 0 && (now_.closing.open == 0 || !sewed)) break;
    }
    return true;
  }

  std::optional<Error> carry_to_finer() {
    std::vector<int> open;
    for (std::size_t s = 0; s < now_.weld.size(); ++s)
      if (!now_.weld[s]) open.push_back(pattern().pairs[s].seam);
    if (o_.max_work > 0) kept_ = now_;
    const Pattern& coarse = pattern();
    const Result<const Pattern*> finer = levels_.at(now_.level + 1);
    if (!finer) return finer.error();
    if (auto e = check_level(**finer, now_.level + 1)) return e;
    ++now_.level;
    now_.pattern = *finer;
    now_.finished = false;
    layers_.reset();
    for (std::size_t p = 0; p < 2; ++p) now_.x[p] = prolong(coarse.meshes[p], now_.x[p], pattern().meshes[p]);
    // A seam that has closed everywhere is sewn from the start: its partners differ only by the roundness of the
    // outlines between coarse nodes.
    now_.weld.clear();
    for (const NodePair& q : pattern().pairs)
      now_.weld.push_back(std::find(open.begin(), open.end(), q.seam) == open.end());
    return std::nullopt;
  }

  /// Makes the level's cloth of where its nodes are, and its contact.
  void take_cloth() {
    int count = 0;
    now_.nodes = number_nodes(pattern(), now_.weld, count);
    now_.cloth = cloth_of(now_.nodes, count);
    now_.cloth.seams = springs_for(pattern(), now_.nodes, now_.weld, now_.closing.k, now_.closing.cap);
    if (!now_.finished) now_.before = scatter(now_.cloth, now_.nodes);
    push_out(now_.cloth, body_, o_.offset);
    now_.contact = contact_for(now_.cloth, mean_edge(pattern()));
  }

  /// The cloth of this level to its residual: the final one on the last level, else the coarse one.
  bool drape() {
    take_cloth();
    if (last()) return relax_to(o_.residual) && (given_up() || finish());
    return relax_to(std::max(o_.residual, o_.coarse_residual)) && record();
  }

  /// To the final residual; and what was skipped because the scene did not seem to need it is looked at, and turned on
  /// where it mattered.
  bool finish() {
    if (now_.finished || fallen_) return record();
    now_.finished = true;
    if (!last() && now_.residual > o_.residual && !relax_to(o_.residual)) return false;
    if (!fallen_ && o_.uncapped_at_rest && out_.stiffness_cap > 0) {
      sheet_ = {fabric_.stretch, fabric_.shear, fabric_.bend};
      k_ = std::max(sheet_.stretch, sheet_.shear);
      take_cloth();
      if (!relax_to(o_.residual)) return false;
    }
    if (!fallen_ && (o_.contact_between_nodes || measure_penetration(pattern(), now_.x, body_) > penetration_bar)) {
      // Tight cloth is stretched, and its long edges cut through limbs that its nodes clear.
      middles_ = true;
      now_.contact = contact_for(now_.cloth, mean_edge(pattern()));
      if (!relax_to(o_.residual)) return false;
    }
    if (!fallen_ && o_.front_back != FrontBack::never) {
      crossed_before_ = detect_self_contact(pattern(), now_.nodes, now_.x);
      if (crossed_before_.crossed > 0 || o_.front_back == FrontBack::always) {
        layers_.emplace(pattern(), now_.nodes, 0.3 * k_);
        if (!relax_to(o_.residual)) return false;
      }
    }
    return record();
  }

  /// One relaxation of the level's cloth. A limit of work ends it early: before the cloth is close to rest only where
  /// there is a level before to go back to, and early enough to finish that one.
  bool relax_to(double residual) {
    RelaxOptions r;
    r.residual = residual;
    r.max_iterations = o_.max_iterations;
    r.friction = o_.friction ? fabric_.friction : 0;
    r.step_limit = std::min(0.02, mean_edge(pattern()));
    const double start = middle(now_.cloth).y(), drop = std::max(0.3, 0.6 * height(pattern()));
    const double cost = (layers_ ? layers_cost : step_cost) * now_.cloth.size;
    bool over = false;
    r.stop = [&](int it, double at) {
      if (o_.progress && it % 100 == 0) o_.progress(now_.level, it, at);
      fallen_ = start - middle(now_.cloth).y() > drop;
      const bool close = at <= close_to_rest;
      const double reserve = kept_ && !close ? finishing_steps * step_cost * kept_->cloth.size : 0;
      over = o_.max_work > 0 && out_.work + cost * (it + r.check_every) + reserve > o_.max_work && (close || kept_);
      return fallen_ || over;
    };
    const RelaxOutcome done = relax(now_.cloth, &now_.contact, r, layers_ ? &*layers_ : nullptr);
    out_.work += cost * done.iterations;
    out_.out_of_work = out_.out_of_work || over;
    steps_ += done.iterations;
    now_.x = scatter(now_.cloth, now_.nodes);
    now_.residual = done.residual;
    out_.energy = done.energy;
    return done.finite;
  }

  /// Fills in the level's line of the report, or fills it in anew.
  bool record() {
    if (static_cast<int>(out_.levels.size()) == now_.level) out_.levels.emplace_back();
    LevelFigures& f = out_.levels.back();
    f.nodes = now_.cloth.size;
    f.edge_mm = 1000 * mean_edge(pattern());
    f.iterations = steps_;
    f.residual = now_.residual;
    f.work = out_.work - work_before_;
    f.gap_mm = 1000 * mean_gap(pattern(), now_.x, body_, o_.offset);
    f.loose_turn = loose_turn(pattern(), now_.x, body_, o_.offset);
    if (now_.level > 0) {
      double sum = 0, most = 0;
      std::size_t number = 0;
      for (std::size_t p = 0; p < 2; ++p)
        for (std::size_t i = 0; i < now_.x[p].size(); ++i, ++number) {
          const double moved = (now_.x[p][i] - now_.before[p][i]).norm();
          sum += moved;
          most = std::max(most, moved);
        }
      f.change_mean_mm = 1000 * sum / static_cast<double>(number);
      f.change_max_mm = 1000 * most;
      f.change_surface_mm = 1000 * surface_change(pattern(), now_.before, now_.x);
    }
    f.error_estimate_mm = estimate_error(f);
    return true;
  }

  bool good_enough() const {
    return o_.max_error > 0 && safety * out_.levels.back().error_estimate_mm <= 1e3 * o_.max_error;
  }

  /// Whether the work that is left may bring the next level to rest; that takes about as many steps on every mesh.
  bool time_for_another() {
    if (!(o_.max_work > 0)) return true;
    const double next = levels_.nodes[now_.level + 1];
    ran_out_ = out_.out_of_work || out_.work + next * (level_cost + step_cost * likely_steps) > o_.max_work;
    return !ran_out_;
  }

  /// The work ran out on a level that had not come close to rest.
  bool given_up() const { return out_.out_of_work && kept_ && now_.residual > close_to_rest; }

  void take_up_the_one_before() {
    now_ = *std::move(kept_);
    kept_.reset();
    layers_.reset();
    out_.levels.resize(now_.level + 1);
    steps_ = out_.levels.back().iterations;
    work_before_ = out_.work - out_.levels.back().work;
    ran_out_ = true;
  }

  Result<Drape> report() {
    int count = 0;
    now_.nodes = number_nodes(pattern(), now_.weld, count);
    Cloth cloth = cloth_of(now_.nodes, count);
    cloth.seams = springs_for(pattern(), now_.nodes, now_.weld, now_.closing.k, now_.closing.cap);
    now_.x = scatter(cloth, now_.nodes);
    out_.out_of_work = out_.out_of_work || ran_out_;
    if (fallen_) now_.contact = contact_for(cloth, mean_edge(pattern()));
    const double mu = o_.friction ? fabric_.friction : 0;
    out_.residual = residual_of(cloth, &now_.contact, mu, layers_ ? &*layers_ : nullptr);
    const Strains strain = measure_strain(pattern(), now_.x);
    out_.strain_p99 = strain.p99;
    out_.stretch_p99 = strain.stretch_p99;
    out_.strain_max = strain.most;
    out_.penetration_mm_max = 1000 * measure_penetration(pattern(), now_.x, body_);
    out_.seam_gap_mm_max = 1000 * std::max(gap_met_, now_.closing.open > 0 ? now_.closing.gap_open : 0.0);
    out_.welded = now_.nodes;
    out_.positions = now_.x;
    out_.level = now_.level;
    const SelfContact self = detect_self_contact(pattern(), now_.nodes, now_.x);
    out_.self_touching = self.close;
    out_.self_crossed = self.crossed;
    out_.self_crossed_mm_max = 1000 * self.depth;
    if (!fallen_) out_.error_estimate_mm = out_.levels.back().error_estimate_mm;
    judge({fallen_, now_.closing.open, now_.closing.gap_open, o_.residual}, out_);
    SceneNotes notes;
    notes.bend = sheet_.bend;
    notes.friction = fabric_.friction;
    notes.voxels_in_reach = share_in_reach(now_.x, body_);
    notes.between_nodes = static_cast<int>(now_.contact.samples.size()) - cloth.size;
    notes.cut_in = middles_;
    notes.crossed = crossed_before_;
    notes.left = self;
    list_effects(o_, notes, out_);
    return std::move(out_);
  }

  Error broken() const {
    return {Cause::internal, "NOT_FINITE",
            "the relaxation left the range of numbers on level " + std::to_string(now_.level) + ".",
            "Report the garment and fabric that did this; another edge length may avoid it.", "sewing"};
  }

  const PatternLevels& levels_;
  const Fabric fabric_;  ///< as a sheet
  const DistanceField& body_;
  const SewingOptions& o_;
  SheetStiffness sheet_;
  double column_ = 0, k_ = 0, gap_met_ = 0;
  Stage now_;
  std::optional<Stage> kept_;  ///< the level before, while a budget of work may bring us back to it
  int steps_ = 0;              ///< of this level
  double work_before_ = 0;     ///< [node steps] of the levels before
  bool fallen_ = false, ran_out_ = false;
  bool middles_ = false;  ///< contact between the nodes was found to matter
  SelfContact crossed_before_;
  std::optional<Layers> layers_;  ///< front and back were found to cross
  Drape out_;
};

}  // namespace

Result<Drape> sew_and_drape(const PatternLevels& levels, const std::vector<std::vector<Vec3>>& placed,
                            const Fabric& fabric, const DistanceField& body, const SewingOptions& options) {
  if (auto e = sewing::check_count(levels)) return *e;
  const Result<const Pattern*> first = levels.at(0);
  if (!first) return first.error();
  // The paper's own constants are those of the last mesh, which is then needed from the start.
  const bool raw = options.spring_k > 0 || options.node_mass > 0;
  const Result<const Pattern*> measure = levels.at(raw ? levels.count() - 1 : 0);
  if (!measure) return measure.error();
  if (auto e = sewing::check_input(**first, **measure, placed, fabric, body, options)) return *e;
  const Fabric sheet = sewing::as_sheet(**measure, fabric, options);
  const double column = sewing::column_weight(**measure, sheet, options.gravity);
  return Tailor(levels, sheet, column, body, options).run(**first, placed);
}

Result<Drape> sew_and_drape(std::span<const Pattern> levels, const std::vector<std::vector<Vec3>>& placed,
                            const Fabric& fabric, const DistanceField& body, const SewingOptions& options) {
  PatternLevels given;
  for (const Pattern& p : levels) given.nodes.push_back(static_cast<int>(sewing::nodes_of(p)));
  given.at = [&](int level) -> Result<const Pattern*> { return &levels[level]; };
  for (std::size_t l = 1; l < levels.size() && l < 16; ++l)
    if (auto e = sewing::check_level(levels[l], static_cast<int>(l))) return *e;
  return sew_and_drape(given, placed, fabric, body, options);
}

}  // namespace vitrine
