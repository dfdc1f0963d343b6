// SPDX-License-Identifier: GPL-3.0-or-later
#include "relax.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coarse_space.hpp"
#include "lanes.hpp"
#include "motion.hpp"
#include "residual.hpp"
#include "springs.hpp"

namespace vitrine::sewing {
namespace {

// FIRE's own constants, Bitzek et al. 2006, save for the longest step: a unit step is stable because the fictitious
// mass is the stiffness, and what is measured of the stiffest motion may allow a little more.
constexpr double dt_most = 1.6, dt_least = 0.02, dt_start = 0.3;
constexpr double alpha_start = 0.1, alpha_fade = 0.99, faster = 1.1, slower = 0.5;
constexpr int patience = 5;
// FIRE turns the velocity towards the force. Where a slow slide goes on under small forces, that turn would amount to
// many steps at once, too long for the stiffest motions: one node at an armhole then shakes and halts the whole cloth.
constexpr double turn_most = 0.05;  // [dt]
// FIRE halts everything when the motion goes uphill. A fold that swings aside under small forces would then start anew
// at every tremble somewhere else; averaging velocities over neighbours so often takes the tremble and leaves the
// swing.
constexpr int calming_rounds = 8;

constexpr double stiffest_margin = 2.5;  // dt^2 times the stiffest eigenvalue; 4 is the limit of stability
constexpr int measure_every = 100, first_rounds = 6, later_rounds = 3;  // of power iteration
constexpr double probe = 1e-7;                                          // [m]
constexpr int lattice_every = 25, hold_for = 50;                        // steps
constexpr int floor_patience = 2000;                                    // steps without halving the residual

void put(Packed& v, int n, const Vec3& value) {
  for (int a = 0; a < 3; ++a) v[4 * n + a] = value[a];
}

class Fire {
 public:
  Fire(Cloth& cloth, Contact* contact, const RelaxOptions& options, Layers* layers)
      : c_(cloth),
        contact_(contact),
        layers_(layers),
        o_(options),
        springs_(cloth),
        coarse_(cloth),
        nodes_(packed_nodes(cloth.size)) {
    pack(cloth.x, x_);
    v_.assign(x_.size(), 0.0);
    f_ = a_ = v_;
    held_.assign(nodes_, 0);
    for (int n = 0; n < c_.size; ++n) held_[n] = c_.pinned[n];
    touched_at_.assign(nodes_, -hold_for);
    path_.assign(nodes_, 0.0);
    share_.assign(nodes_, 1.0);
    for (const auto* ends : {&c_.edge_a, &c_.edge_b})
      for (const int n : *ends) share_[n] += 1;
    for (double& s : share_) s = 1 / s;
    if (contact_) wake(*contact_);
    if (layers_) layers_->look(x_);
    update_masses();
    // An energy rise smaller than the weight lifted by a tenth of a millimetre is rounding, not an explosion.
    energy_grain_ = 1e-4 * c_.scale;
    double springs = 0;
    for (std::size_t e = 0; e < c_.edge_k.size(); ++e) springs += c_.edge_k[e] * c_.edge_rest[e];
    floor_ = std::numeric_limits<double>::epsilon() * springs / c_.scale;
  }

  RelaxOutcome run() {
    RelaxOutcome out = steps();
    unpack(x_, c_.x);
    return out;
  }

 private:
  RelaxOutcome steps() {
    RelaxOutcome out;
    bool exact = true;
    for (int it = 0;; ++it) {
      const bool look = it % o_.check_every == 0;
      exact = exact || look;
      // From the second step on, when the nodes at the body are known.
      if (it % measure_every == 1) limit_step(it == 1 ? first_rounds : later_rounds);
      const double energy = forces(exact);
      const double residual = net_forces() / c_.scale;
      out.iterations = it;
      out.energy = energy;
      out.residual = residual;
      if (!std::isfinite(residual) || !std::isfinite(energy)) {
        out.finite = false;
        return out;
      }
      raised_ = false;
      const bool there = exact && residual <= o_.residual;
      if (look || there) {
        raised_ = contact_ && refresh_contact(*contact_);
        if (layers_ && (there || it >= next_layers_)) {
          // Rarer and rarer: pairs that change hands for ever would keep the cloth from coming to rest.
          layers_->look(x_);
          next_layers_ = it + std::max(o_.check_every, it / 4);
          raised_ = true;
        }
        if (there && (!raised_ || still_there())) {
          out.converged = true;
          return out;
        }
        if (look && o_.stop) {
          unpack(x_, c_.x);
          if (o_.stop(it, residual)) {
            out.stopped = true;
            return out;
          }
        }
        if (raised_ || it % 100 == 0) {
          update_masses();
          ceiling_known_ = false;
        }
      }
      if (it >= o_.max_iterations || at_rounding_floor(it, residual)) return out;
      if (ceiling_known_ || !raised_) watch(energy);
      release(it);
      advance();
      exact = residual <= 1.2 * o_.residual;
    }
  }

  /// Rounding leaves forces behind; where no progress is made among them, more steps will not help.
  bool at_rounding_floor(int it, double residual) {
    if (residual < 0.5 * least_) least_ = residual, least_at_ = it;
    return residual < 1e3 * floor_ && it - least_at_ > floor_patience;
  }

  /// Whether the cloth is at rest with the contacts as they are now.
  bool still_there() {
    forces(true);
    return net_forces() / c_.scale <= o_.residual;
  }

  /// Nodes at the body leave the lattices at once, and come back some time after they left it: those that touch now and
  /// then would change the lattices' masses at every step.
  void release(int it) {
    if (contact_)
      for (const int n : contact_->touched) {
        touched_at_[n] = it;
        if (!held_[n]) held_[n] = 1, lattice_old_ = true;
      }
    if (it % lattice_every == 0) {
      for (int n = 0; n < c_.size; ++n) held_[n] = c_.pinned[n] || it - touched_at_[n] < hold_for;
      lattice_old_ = true;
    }
    if (lattice_old_) coarse_.update(held_, mass_);
    lattice_old_ = false;
  }

  /// Acceleration by nodes and lattices.
  void accelerate(const Packed& force, Packed& out) {
    scale_by_node(force.data(), per_mass_.data(), nodes_, out.data());
    coarse_.apply(force, held_, out);
  }

  /// Power iteration on the stiffest motion, with the forces' own differences; goes on from where the last one ended.
  void limit_step(int rounds) {
    if (stiffest_.empty()) {
      stiffest_.assign(x_.size(), 0.0);
      std::uint32_t seed = 1;
      for (int n = 0; n < c_.size; ++n)
        for (int a = 0; a < 3; ++a) {
          seed = seed * 1664525u + 1013904223u;
          if (!c_.pinned[n]) stiffest_[4 * n + a] = static_cast<double>(seed >> 8) / (1 << 24) - 0.5;
        }
    }
    Packed there(x_.size()), here(x_.size()), change(x_.size());
    forces_at(x_, here);
    for (int round = 0; round < rounds; ++round) {
      double most = 0;
      for (const double m : stiffest_) most = std::max(most, std::abs(m));
      if (!(most > 0)) return;
      for (std::size_t i = 0; i < x_.size(); ++i) {
        stiffest_[i] *= probe / most;
        there[i] = x_[i] + stiffest_[i];
      }
      forces_at(there, change);
      for (std::size_t i = 0; i < x_.size(); ++i) change[i] = here[i] - change[i];
      const double before = squares_by_mass(stiffest_.data(), mass_.data(), nodes_);
      accelerate(change, stiffest_);
      const double after = squares_by_mass(stiffest_.data(), mass_.data(), nodes_);
      dt_long_ = std::min(dt_most, std::sqrt(stiffest_margin / std::sqrt(after / before)));
    }
    dt_cap_ = std::min(dt_cap_, dt_long_);
  }

  void forces_at(const Packed& x, Packed& out) {
    springs_.forces(x, out);
    if (layers_) layers_->forces(x, out);
    if (contact_) contact_forces(*contact_, x, path_, out, false);
  }

  void update_masses() {
    mass_ = node_stiffness(c_);
    if (contact_) add_contact_stiffness(*contact_, x_, mass_);
    if (layers_) layers_->add_stiffness(mass_);
    mass_.resize(nodes_, 0.0);
    per_mass_.assign(nodes_, 0.0);
    for (int n = 0; n < c_.size; ++n) per_mass_[n] = c_.pinned[n] ? 0 : 1 / mass_[n];
  }

  double forces(bool exact) {
    double energy = springs_.forces(x_, f_);
    if (layers_) energy += layers_->forces(x_, f_);
    if (contact_) energy += contact_forces(*contact_, x_, path_, f_, exact);
    return energy;
  }

  /// Sums the stop test and the products FIRE steers by, both with the force that friction leaves over. Leaves that
  /// force in f_, and the whole one of the nodes at the body in `whole_`.
  double net_forces() {
    for (int n = 0; n < c_.size; ++n)
      if (c_.pinned[n]) put(f_, n, Vec3::Zero());
    if (contact_) {
      whole_.clear();
      for (const int n : contact_->touched) {
        whole_.push_back(at(f_, n));
        if (o_.friction > 0 && !c_.pinned[n]) put(f_, n, outside_cone(at(f_, n), at(contact_->normal, n), o_.friction));
      }
    }
    const Sums s = sums_of(f_.data(), v_.data(), mass_.data(), nodes_);
    power_ = s.power;
    vv_ = s.vv;
    return s.force;
  }

  /// Energy may fall, or turn into the fictitious motion's; when it rises above where the motion began, the step was
  /// too long.
  void watch(double energy) {
    if (!ceiling_known_) {
      // What is in motion now may turn back into energy.
      ceiling_ = energy + 0.5 * vv_;
      lowest_ = energy;
      ceiling_known_ = true;
      return;
    }
    lowest_ = std::min(lowest_, energy);
    // A tenth of what was gained: growing steps and clamped steps shift the sum a little; an explosion doubles it.
    if (energy > ceiling_ + 0.1 * (ceiling_ - lowest_) + energy_grain_) {
      dt_cap_ = std::max(dt_least, 0.5 * dt_cap_);
      halt();
      ceiling_known_ = false;
      calm_ = 0;
    } else if (++calm_ % 20 == 0) {
      dt_cap_ = std::min(dt_long_, 1.2 * dt_cap_);
    }
  }

  void halt() {
    std::fill(v_.begin(), v_.end(), 0.0);
    vv_ = 0;
    dt_ = std::max(dt_least, slower * dt_);
    alpha_ = alpha_start;
    uphill_free_ = 0;
  }

  /// Takes the tremble from the motion. Nodes at the body keep theirs, which friction calms; what still goes uphill is
  /// halted.
  void calm() {
    for (int round = 0; round < calming_rounds; ++round) {
      calmer_ = v_;
      add_neighbours(c_.edge_a.data(), c_.edge_b.data(), c_.edge_a.size(), v_.data(), calmer_.data());
      for (int n = 0; n < c_.size; ++n)
        if (!held_[n]) store(&v_[4 * n], share_[n] * load(&calmer_[4 * n]));
    }
    const Sums s = sums_of(f_.data(), v_.data(), mass_.data(), nodes_);
    if (!(s.power > 0)) return halt();
    vv_ = s.vv;
    dt_ = std::max(dt_least, slower * dt_);
    uphill_free_ = 0;
  }

  void advance() {
    if (power_ < 0) {
      calm();
    } else if (++uphill_free_ > patience) {
      dt_ = std::min(dt_cap_, dt_ * faster);
      alpha_ *= alpha_fade;
    }
    dt_ = std::min(dt_, dt_cap_);
    accelerate(f_, a_);
    const double aa = squares_by_mass(a_.data(), mass_.data(), nodes_);
    const double mix = std::min(turn_most * dt_, aa > 0 ? alpha_ * std::sqrt(vv_ / aa) : 0.0);
    steer(1 - alpha_, mix + dt_, a_.data(), a_.size(), v_.data());
    if (contact_ && o_.friction > 0)
      for (std::size_t i = 0; i < contact_->touched.size(); ++i) rub(contact_->touched[i], whole_[i]);
    const double longest = move(dt_, v_.data(), nodes_, x_.data(), path_.data());
    if (longest > o_.step_limit) hold_back();
    if (contact_) contact_->travelled += std::min(longest, o_.step_limit);
  }

  /// Nothing jumps: takes back what a step was too long.
  void hold_back() {
    for (int n = 0; n < c_.size; ++n) {
      const Vec3 v = at(v_, n);
      const double length = dt_ * v.norm();
      if (length <= o_.step_limit) continue;
      const double share = o_.step_limit / length;
      put(x_, n, at(x_, n) - (1 - share) * dt_ * v);
      put(v_, n, share * v);
    }
  }

  /// Coulomb: friction takes from the sliding velocity at most what mu N gives in one step. The node is driven by its
  /// whole force, not by what friction leaves of it at rest.
  void rub(int node, const Vec3& whole) {
    const Vec3 push = at(contact_->normal, node);
    const double load = push.norm(), per_mass = per_mass_[node];
    const Vec3 n = push / load, velocity = at(v_, node) + dt_ * per_mass * (whole - at(f_, node));
    const double along = velocity.dot(n);
    const Vec3 slide = velocity - along * n;
    const double speed = slide.norm(), brake = o_.friction * load * dt_ * per_mass;
    put(v_, node, along * n + (speed > brake ? Vec3(slide * (1 - brake / speed)) : Vec3(Vec3::Zero())));
  }

  Cloth& c_;
  Contact* contact_;
  Layers* layers_;
  const RelaxOptions& o_;
  Springs springs_;
  CoarseSpace coarse_;
  std::size_t nodes_;
  Packed x_, v_, f_, a_, calmer_, stiffest_;
  std::vector<double> mass_, per_mass_, path_;
  std::vector<double> share_;  ///< [-] of each in the average of a node and its neighbours
  std::vector<char> held_;     // pinned, or lately at the body
  std::vector<int> touched_at_;
  std::vector<Vec3> whole_;
  double dt_ = dt_start, dt_cap_ = dt_most, dt_long_ = dt_most, alpha_ = alpha_start;
  double power_ = 0, vv_ = 0;
  double ceiling_ = 0, lowest_ = 0, energy_grain_ = 0;
  bool raised_ = false;  ///< contact changed in this step: the energy in hand is not what the next step sees
  bool ceiling_known_ = false, lattice_old_ = true;
  int uphill_free_ = 0, calm_ = 0, next_layers_ = 1;
  double floor_ = 0, least_ = std::numeric_limits<double>::infinity();
  int least_at_ = 0;
};

}  // namespace

RelaxOutcome relax(Cloth& cloth, Contact* contact, const RelaxOptions& options, Layers* layers) {
  return Fire(cloth, contact, options, layers).run();
}

}  // namespace vitrine::sewing
