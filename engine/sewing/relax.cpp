// SPDX-License-Identifier: GPL-3.0-or-later
#include "relax.hpp"

#include <algorithm>
#include <cmath>

namespace vitrine::sewing {
namespace {

// FIRE's own constants, Bitzek et al. 2006; a unit time step is stable because the fictitious mass is the stiffness.
constexpr double dt_most = 1.0, dt_least = 0.02, dt_start = 0.3;
constexpr double alpha_start = 0.1, alpha_fade = 0.99, faster = 1.1, slower = 0.5;
constexpr int patience = 5;

/// The part of a node's force that friction cannot hold. `push` is the body's push on the node.
Vec3 outside_cone(const Vec3& force, const Vec3& push, double mu) {
  const double load = push.norm();
  if (!(load > 0) || mu == 0) return force;
  const Vec3 n = push / load;
  const double along = force.dot(n);
  const Vec3 tangent = force - along * n;
  const double t = tangent.norm(), held = mu * load;
  return along * n + (t > held ? Vec3(tangent * ((t - held) / t)) : Vec3(Vec3::Zero()));
}

Vec3 at(const std::vector<double>& v, int n) {
  return {v[3 * n], v[3 * n + 1], v[3 * n + 2]};
}

class Fire {
 public:
  Fire(Cloth& cloth, Contact* contact, const RelaxOptions& options)
      : c_(cloth), contact_(contact), o_(options), v_(cloth.x.size(), 0.0), f_(cloth.x.size(), 0.0) {
    update_masses();
    // An energy rise smaller than the weight lifted by a tenth of a millimetre is rounding, not an explosion.
    energy_grain_ = 1e-4 * c_.scale;
  }

  RelaxOutcome run() {
    RelaxOutcome out;
    bool fresh = true;
    for (int it = 0;; ++it) {
      const double energy = forces(fresh);
      fresh = false;
      out.iterations = it;
      out.energy = energy;
      const double residual = net_forces();
      const bool look = it % o_.check_every == 0;
      if (!std::isfinite(residual) || !std::isfinite(energy)) {
        out.finite = false;
        return out;
      }
      out.residual = residual / c_.scale;
      if (look || out.residual <= o_.residual) {
        const bool raised = contact_ && refresh_contact(*contact_, c_.x);
        if (!raised && out.residual <= o_.residual) {
          out.converged = true;
          return out;
        }
        if (look && o_.stop && o_.stop(it, out.residual)) {
          out.stopped = true;
          return out;
        }
        if (raised || it % 100 == 0) {
          update_masses();
          ceiling_known_ = false;
        }
      }
      if (it >= o_.max_iterations) return out;
      watch(energy);
      advance();
    }
  }

 private:
  void update_masses() {
    mass_ = node_stiffness(c_);
    if (contact_) add_contact_stiffness(*contact_, c_.x, mass_);
  }

  double forces(bool fresh) {
    std::fill(f_.begin(), f_.end(), 0.0);
    double energy = internal_forces(c_, c_.x, f_);
    if (contact_) energy += contact_forces(*contact_, c_.x, f_, fresh);
    return energy;
  }

  /// Sums the stop test and the products FIRE steers by, both with the force that friction leaves over.
  double net_forces() {
    double sum = 0;
    power_ = ff_ = vv_ = 0;
    const bool rough = contact_ && o_.friction > 0;
    for (int n = 0; n < c_.size; ++n) {
      double* f = &f_[3 * n];
      if (c_.pinned[n]) {
        f[0] = f[1] = f[2] = 0;
        continue;
      }
      const double* v = &v_[3 * n];
      double g[3] = {f[0], f[1], f[2]};
      if (rough) {
        const double* p = &contact_->normal[3 * n];
        if (p[0] != 0 || p[1] != 0 || p[2] != 0) {
          const Vec3 left = outside_cone(Vec3(f[0], f[1], f[2]), Vec3(p[0], p[1], p[2]), o_.friction);
          for (int a = 0; a < 3; ++a) g[a] = left[a];
        }
      }
      const double square = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
      sum += std::sqrt(square);
      power_ += g[0] * v[0] + g[1] * v[1] + g[2] * v[2];
      ff_ += square / mass_[n];
      vv_ += mass_[n] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    return sum;
  }

  /// Energy may fall, or turn into the fictitious motion's; when the sum rises, the step was too long.
  void watch(double energy) {
    // What symplectic Euler keeps exactly for a spring; plain energy would swing by half with stiff springs.
    const double total = energy + 0.5 * vv_ + 0.5 * dt_ * power_;
    if (!ceiling_known_) {
      ceiling_ = total;
      lowest_ = energy;
      ceiling_known_ = true;
      return;
    }
    lowest_ = std::min(lowest_, energy);
    // A tenth of what was gained: growing steps and clamped steps shift the sum a little; an explosion doubles it.
    if (total > ceiling_ + 0.1 * (ceiling_ - lowest_) + energy_grain_) {
      dt_cap_ = std::max(dt_least, 0.5 * dt_cap_);
      halt();
      ceiling_known_ = false;
      calm_ = 0;
    } else if (++calm_ % 20 == 0) {
      dt_cap_ = std::min(dt_most, 1.2 * dt_cap_);
    }
  }

  void halt() {
    std::fill(v_.begin(), v_.end(), 0.0);
    vv_ = 0;
    dt_ = std::max(dt_least, slower * dt_);
    alpha_ = alpha_start;
    uphill_free_ = 0;
  }

  void advance() {
    if (power_ < 0) {
      halt();
    } else if (++uphill_free_ > patience) {
      dt_ = std::min(dt_cap_, dt_ * faster);
      alpha_ *= alpha_fade;
    }
    dt_ = std::min(dt_, dt_cap_);
    const double mix = ff_ > 0 ? alpha_ * std::sqrt(vv_ / ff_) : 0.0;
    const bool rough = contact_ && o_.friction > 0;
    for (int n = 0; n < c_.size; ++n) {
      if (c_.pinned[n]) continue;
      double* v = &v_[3 * n];
      const double* f = &f_[3 * n];
      const double per_mass = 1 / mass_[n];
      Vec3 push = Vec3::Zero();
      if (rough) push = at(contact_->normal, n);
      const bool touching = rough && push.squaredNorm() > 0;
      Vec3 steer(f[0], f[1], f[2]);
      if (touching) steer = outside_cone(steer, push, o_.friction);
      for (int a = 0; a < 3; ++a) v[a] = (1 - alpha_) * v[a] + mix * per_mass * steer[a] + dt_ * per_mass * f[a];
      if (touching) rub(v, push, per_mass);
      double step[3], length = 0;
      for (int a = 0; a < 3; ++a) step[a] = dt_ * v[a], length += step[a] * step[a];
      length = std::sqrt(length);
      if (length > o_.step_limit) {
        const double shrink = o_.step_limit / length;
        for (int a = 0; a < 3; ++a) step[a] *= shrink, v[a] *= shrink;
        length = o_.step_limit;
      }
      for (int a = 0; a < 3; ++a) c_.x[3 * n + a] += step[a];
      if (contact_) contact_->path[n] += length;
    }
  }

  /// Coulomb: friction takes from the sliding velocity at most what mu N gives in one step.
  void rub(double* v, const Vec3& push, double per_mass) const {
    const double load = push.norm();
    const Vec3 n = push / load, velocity(v[0], v[1], v[2]);
    const double along = velocity.dot(n);
    const Vec3 slide = velocity - along * n;
    const double speed = slide.norm(), brake = o_.friction * load * dt_ * per_mass;
    const Vec3 left = along * n + (speed > brake ? Vec3(slide * (1 - brake / speed)) : Vec3(Vec3::Zero()));
    for (int a = 0; a < 3; ++a) v[a] = left[a];
  }

  Cloth& c_;
  Contact* contact_;
  const RelaxOptions& o_;
  std::vector<double> v_, f_, mass_;
  double dt_ = dt_start, dt_cap_ = dt_most, alpha_ = alpha_start;
  double power_ = 0, ff_ = 0, vv_ = 0;
  double ceiling_ = 0, lowest_ = 0, energy_grain_ = 0;
  bool ceiling_known_ = false;
  int uphill_free_ = 0, calm_ = 0;
};

}  // namespace

RelaxOutcome relax(Cloth& cloth, Contact* contact, const RelaxOptions& options) {
  return Fire(cloth, contact, options).run();
}

double residual_of(const Cloth& c, Contact* contact, double friction) {
  std::vector<double> force(c.x.size(), 0.0);
  internal_forces(c, c.x, force);
  if (contact) contact_forces(*contact, c.x, force, true);
  double sum = 0;
  for (int n = 0; n < c.size; ++n) {
    if (c.pinned[n]) continue;
    const Vec3 push = contact ? at(contact->normal, n) : Vec3(Vec3::Zero());
    sum += outside_cone(at(force, n), push, friction).norm();
  }
  return sum / c.scale;
}

}  // namespace vitrine::sewing
