// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>

#include "cloth.hpp"
#include "contact.hpp"
#include "layers.hpp"

namespace vitrine::sewing {

struct RelaxOptions {
  double residual = 1e-3;       ///< [-] stop
  int max_iterations = 60'000;  ///< budget
  double friction = 0;          ///< [-] Coulomb
  double step_limit = 0.02;     ///< [m] per iteration and node: nothing jumps through a limb
  int check_every = 25;         ///< iterations between looks at the stop test
  /// Called at each check with iteration and residual; true stops (seams closed, garment falling).
  std::function<bool(int, double)> stop;
};

struct RelaxOutcome {
  bool converged = false, stopped = false, finite = true;
  int iterations = 0;
  double residual = 0;
  double energy = 0;
};

/// Relaxes to rest: FIRE (Bitzek et al. 2006) with fictitious masses equal to the local stiffness, so that a unit step
/// is stable for any k and m; Coulomb friction as an impulse on the velocity. Stops on the force residual outside the
/// friction cone, never on velocity. A motion that goes uphill loses its tremble first and is halted only when that
/// does not help. Lattices (coarse_space.hpp) move large pieces of the free cloth at once, so the
/// steps needed hardly grow with the mesh. On x86-64 four numbers at a time where the machine can: the same bytes.
/// `layers` may be null: then front and back pass through each other where no body parts them.
RelaxOutcome relax(Cloth& cloth, Contact* contact, const RelaxOptions& options, Layers* layers = nullptr);

}  // namespace vitrine::sewing
