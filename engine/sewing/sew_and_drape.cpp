// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "audit.hpp"
#include "checks.hpp"
#include "contact.hpp"
#include "effects.hpp"
#include "layers.hpp"
#include "prolong.hpp"
#include "relax.hpp"
#include "residual.hpp"
#include "sew.hpp"
#include "vitrine/sewing.hpp"

namespace vitrine {
namespace {

using namespace sewing;

constexpr double gap_bar = 0.001;  // [m] partners must be at least this close before they are welded
constexpr double near_by = 0.03;   // [m] partners that start closer than this are sewn first
constexpr int sewing_rounds = 4;
constexpr double strain_bar = 0.8;  // [-] jersey and rib bear nearly double their width; beyond, cloth would tear
constexpr double penetration_bar = 0.0005;  // [m]

std::string text(const char* format, double a, double b = 0) {
  char buffer[200];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

double mean_edge(const Pattern& p) {
  double sum = 0;
  std::size_t count = 0;
  for (const PanelMesh& m : p.meshes)
    for (const Triangle& t : m.triangles)
      for (int e = 0; e < 3; ++e, ++count) sum += (m.nodes[t[e]] - m.nodes[t[(e + 1) % 3]]).norm();
  return std::max(sum / static_cast<double>(count), 1e-4);
}

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

/// Walks the levels; one member function per step of the story.
class Tailor {
 public:
  Tailor(std::span<const Pattern> levels, const Fabric& fabric, const DistanceField& body, const SewingOptions& options)
      : levels_(levels), fabric_(fabric), body_(body), o_(options) {
    column_ = column_weight(levels.back(), fabric, o_.gravity);
    sheet_ = {fabric.stretch, fabric.shear, fabric.bend};
    if (column_ > 0 && o_.max_weight_strain > 0 && !(o_.spring_k > 0)) {
      // Beyond this stiffness the shape no longer moves by a millimetre, but the work grows with sqrt(k).
      const double cap = column_ / o_.max_weight_strain;
      if (sheet_.stretch > cap || sheet_.shear > cap) out_.stiffness_cap = cap;
      sheet_.stretch = std::min(sheet_.stretch, cap);
      sheet_.shear = std::min(sheet_.shear, cap);
    }
    k_ = std::max(sheet_.stretch, sheet_.shear);
  }

  Result<Drape> run(const Positions& placed) {
    x_ = placed;
    weld_.assign(pattern().pairs.size(), 0);
    for (level_ = 0; level_ < static_cast<int>(levels_.size()); ++level_) {
      if (level_ > 0) carry_to_finer();
      if (fallen_) continue;  // keep the falling garment's shape on the finer mesh
      if (!sew() || !drape()) return broken();
    }
    return report();
  }

 private:
  const Pattern& pattern() const { return levels_[level_]; }

  Cloth cloth_of(const Nodes& nodes, int count) const {
    Cloth cloth = build_cloth(pattern(), nodes, count, x_, sheet_, fabric_.mass, o_.gravity, o_.bending);
    // The paper's own constants belong to one mesh, the last; coarser ones are the same cloth as a sheet.
    if (level_ + 1 == static_cast<int>(levels_.size())) set_raw_constants(cloth, o_.spring_k, o_.node_mass);
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
    const std::vector<double> start = gaps(p, x_);
    for (int round = 0; round < sewing_rounds; ++round) {
      std::vector<char> left_alone = weld_;
      if (round == 0)
        for (std::size_t s = 0; s < start.size(); ++s) left_alone[s] = weld_[s] || start[s] > near_by;
      if (std::find(left_alone.begin(), left_alone.end(), 0) == left_alone.end()) continue;
      int count = 0;
      const Nodes nodes = number_nodes(p, weld_, count);
      Cloth cloth = cloth_of(nodes, count);
      push_out(cloth, body_, o_.offset);
      Contact contact = contact_for(cloth, dx);
      closing_ = close_seams(cloth, contact, p, nodes, left_alone, k_, dx, gap_bar);
      gap_met_ = std::max(gap_met_, closing_.gap_met);
      sewing_iterations_ += closing_.iterations;
      x_ = scatter(cloth, nodes);
      if (!closing_.finite) return false;
      bool sewed = false;
      for (std::size_t s = 0; s < weld_.size(); ++s) {
        if (weld_[s] || left_alone[s] || !closing_.met[s]) continue;
        weld_[s] = 1;
        sewed = true;
      }
      if (round > 0 && (closing_.open == 0 || !sewed)) break;
    }
    return true;
  }

  void carry_to_finer() {
    std::vector<int> open;
    for (std::size_t s = 0; s < weld_.size(); ++s)
      if (!weld_[s]) open.push_back(levels_[level_ - 1].pairs[s].seam);
    const Pattern& coarse = levels_[level_ - 1];
    for (std::size_t p = 0; p < 2; ++p) x_[p] = prolong(coarse.meshes[p], x_[p], pattern().meshes[p]);
    // A seam that has closed everywhere is sewn from the start: its partners differ only by the roundness of the
    // outlines between coarse nodes.
    weld_.clear();
    for (const NodePair& q : pattern().pairs)
      weld_.push_back(std::find(open.begin(), open.end(), q.seam) == open.end());
  }

  bool drape() {
    const bool last = level_ + 1 == static_cast<int>(levels_.size());
    const double dx = mean_edge(pattern());
    int count = 0;
    nodes_ = number_nodes(pattern(), weld_, count);
    Cloth cloth = cloth_of(nodes_, count);
    cloth.seams = springs_for(pattern(), nodes_, weld_, closing_.k, closing_.cap);
    const Positions before = scatter(cloth, nodes_);
    push_out(cloth, body_, o_.offset);
    contact_ = contact_for(cloth, dx);

    RelaxOptions r;
    r.residual = last ? o_.residual : std::max(o_.residual, o_.coarse_residual);
    r.max_iterations = o_.max_iterations;
    r.friction = o_.friction ? fabric_.friction : 0;
    r.step_limit = std::min(0.02, dx);
    const double start = middle(cloth).y(), drop = std::max(0.3, 0.6 * height(pattern()));
    r.stop = [&](int it, double residual) {
      if (o_.progress && it % 100 == 0) o_.progress(level_, it, residual);
      fallen_ = start - middle(cloth).y() > drop;
      return fallen_;
    };
    RelaxOutcome done = relax(cloth, &contact_, r);
    x_ = scatter(cloth, nodes_);
    const auto relax_again = [&](Layers* layers) {
      const int before_this = done.iterations;
      done = relax(cloth, &contact_, r, layers);
      done.iterations += before_this;
      x_ = scatter(cloth, nodes_);
    };
    // What was skipped because the scene did not seem to need it is looked at now, and turned on where it mattered.
    if (last && done.finite && !fallen_ &&
        (o_.contact_between_nodes || measure_penetration(pattern(), x_, body_) > penetration_bar)) {
      // Tight cloth is stretched, and its long edges cut through limbs that its nodes clear.
      middles_ = true;
      contact_ = contact_for(cloth, dx);
      relax_again(nullptr);
    }
    if (last && done.finite && !fallen_ && o_.front_back != FrontBack::never) {
      crossed_before_ = detect_self_contact(pattern(), nodes_, x_);
      if (crossed_before_.crossed > 0 || o_.front_back == FrontBack::always) {
        layers_.emplace(pattern(), nodes_, 0.3 * k_);
        relax_again(&*layers_);
      }
    }
    out_.energy = done.energy;

    LevelFigures f;
    f.nodes = cloth.size;
    f.iterations = done.iterations + sewing_iterations_;
    sewing_iterations_ = 0;
    f.residual = done.residual;
    if (level_ > 0) {
      double sum = 0, most = 0;
      std::size_t number = 0;
      for (std::size_t p = 0; p < 2; ++p)
        for (std::size_t i = 0; i < x_[p].size(); ++i, ++number) {
          const double moved = (x_[p][i] - before[p][i]).norm();
          sum += moved;
          most = std::max(most, moved);
        }
      f.change_mean_mm = 1000 * sum / static_cast<double>(number);
      f.change_max_mm = 1000 * most;
    }
    out_.levels.push_back(f);
    return done.finite;
  }

  Result<Drape> report() {
    level_ = static_cast<int>(levels_.size()) - 1;
    int count = 0;
    nodes_ = number_nodes(pattern(), weld_, count);
    Cloth cloth = cloth_of(nodes_, count);
    cloth.seams = springs_for(pattern(), nodes_, weld_, closing_.k, closing_.cap);
    x_ = scatter(cloth, nodes_);
    if (fallen_) contact_ = contact_for(cloth, mean_edge(pattern()));
    const double mu = o_.friction ? fabric_.friction : 0;
    out_.residual = residual_of(cloth, &contact_, mu, layers_ ? &*layers_ : nullptr);
    const Strains strain = measure_strain(pattern(), x_);
    out_.strain_p99 = strain.p99;
    out_.stretch_p99 = strain.stretch_p99;
    out_.strain_max = strain.most;
    out_.penetration_mm_max = 1000 * measure_penetration(pattern(), x_, body_);
    out_.seam_gap_mm_max = 1000 * std::max(gap_met_, closing_.open > 0 ? closing_.gap_open : 0.0);
    out_.welded = nodes_;
    out_.positions = x_;
    const SelfContact self = detect_self_contact(pattern(), nodes_, x_);
    out_.self_touching = self.close;
    out_.self_crossed = self.crossed;
    out_.self_crossed_mm_max = 1000 * self.depth;
    out_.error_estimate_mm = estimate_error();
    judge();
    SceneNotes notes;
    notes.bend = sheet_.bend;
    notes.friction = fabric_.friction;
    notes.voxels_in_reach = share_in_reach();
    notes.between_nodes = static_cast<int>(contact_.samples.size()) - cloth.size;
    notes.cut_in = middles_;
    notes.crossed = crossed_before_;
    notes.left = self;
    list_effects(o_, notes, out_);
    return std::move(out_);
  }

  /// What the next halvings of the edges would still move, from what the last one moved: the changes of a method of
  /// first order in the edge length are a geometric row. Contact with friction is of no higher order.
  std::optional<double> estimate_error() const {
    if (out_.levels.size() < 2) return std::nullopt;
    const LevelFigures &last = out_.levels.back(), &before = out_.levels[out_.levels.size() - 2];
    const double ratio = std::sqrt(static_cast<double>(last.nodes) / before.nodes);
    if (!(ratio > 1.05)) return std::nullopt;
    return last.change_mean_mm / (ratio - 1);
  }

  /// Share of the field's voxels in the garment's box.
  double share_in_reach() const {
    Vec3 lo = x_[0][0], hi = lo;
    for (const auto& panel : x_)
      for (const Vec3& p : panel) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
    double share = 1;
    for (int a = 0; a < 3; ++a) {
      const double length = body_.spacing * (body_.size[a] - 1);
      const double from = std::clamp(lo[a] - body_.origin[a], 0.0, length),
                   to = std::clamp(hi[a] - body_.origin[a], 0.0, length);
      share *= (to - from) / length;
    }
    return share;
  }

  /// The gravest finding names the status.
  void judge() {
    if (fallen_) {
      out_.status = "NOT_SUPPORTED";
      out_.detail = "Nothing holds the garment: it slid off the body and kept falling.";
    } else if (closing_.open > 0) {
      out_.status = "SEAM_OPEN";
      out_.detail =
          text("%.0f sewn pairs did not meet; the widest gap is %.1f mm.", closing_.open, 1000 * closing_.gap_open);
    } else if (out_.penetration_mm_max > 1000 * penetration_bar) {
      out_.status = "INSIDE_BODY";
      out_.detail = text("The cloth lies up to %.1f mm inside the body.", out_.penetration_mm_max);
    } else if (out_.stretch_p99 > strain_bar) {
      out_.status = "OVERSTRETCHED";
      out_.detail = text(
          "One edge in a hundred is stretched by more than %.0f %%: the garment is too small for this body or its "
          "fabric "
          "too soft.",
          100 * out_.stretch_p99);
    } else if (!(out_.residual <= 1.05 * o_.residual)) {
      out_.status = "NOT_CONVERGED";
      out_.detail = text("The forces are balanced to r = %.2g of the weight, not to %.2g.", out_.residual, o_.residual);
    } else {
      out_.status = "OK";
    }
  }

  Error broken() const {
    return {Cause::internal, "NOT_FINITE",
            "the relaxation left the range of numbers on level " + std::to_string(level_) + ".",
            "Report the garment and fabric that did this; another edge length may avoid it.", "sewing"};
  }

  std::span<const Pattern> levels_;
  const Fabric fabric_;  ///< as a sheet
  const DistanceField& body_;
  const SewingOptions& o_;
  SheetStiffness sheet_;
  double column_ = 0, k_ = 0, gap_met_ = 0;
  Positions x_;
  Nodes nodes_;
  std::vector<char> weld_;
  Closing closing_;
  Contact contact_;
  int level_ = 0, sewing_iterations_ = 0;
  bool fallen_ = false;
  bool middles_ = false;  ///< contact between the nodes was found to matter
  SelfContact crossed_before_;
  std::optional<Layers> layers_;  ///< front and back were found to cross
  Drape out_;
};

}  // namespace

Result<Drape> sew_and_drape(std::span<const Pattern> levels, const std::vector<std::vector<Vec3>>& placed,
                            const Fabric& fabric, const DistanceField& body, const SewingOptions& options) {
  if (auto e = sewing::check_input(levels, placed, fabric, body, options)) return *e;
  return Tailor(levels, sewing::as_sheet(levels.back(), fabric, options), body, options).run(placed);
}

}  // namespace vitrine
