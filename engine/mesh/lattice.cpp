// SPDX-License-Identifier: GPL-3.0-or-later
#include "lattice.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace vitrine::mesh_room {
namespace {

constexpr int kAngles = 16;  ///< every 3.75 degrees of the 60 after which a lattice repeats
constexpr int kShifts = 12;  ///< along each side of the lattice's rhombus

using Turn = Vec2;  ///< (cosine, sine)

Turn times(const Turn& a, const Turn& b) {
  return {a.x() * b.x() - a.y() * b.y(), a.x() * b.y() + a.y() * b.x()};
}
Turn half(const Turn& t) {
  return {std::sqrt(0.5 * (1 + t.x())), std::sqrt(0.5 * (1 - t.x()))};
}
const Turn kSixth{0.5, 0.5 * std::numbers::sqrt3};

/// (cosine, sine) of a phase in full turns to 1e-6, from arithmetic alone: the maths library's last digit differs
/// between processors, and must not decide between two lattices.
Turn turn_of(double phase) {
  const double t = phase - std::floor(phase + 0.5);  // -0.5 .. 0.5
  // Taylor's series of a quarter of the angle, then doubled twice.
  const double x = 0.5 * std::numbers::pi * t, q = x * x;
  const double sine = x * (1 - q / 6 * (1 - q / 20 * (1 - q / 42)));
  const double cosine = 1 - q / 2 * (1 - q / 12 * (1 - q / 30 * (1 - q / 56)));
  const Turn twice = times({cosine, sine}, {cosine, sine});
  return times(twice, twice);
}

/// How well sites coincide with the boundary's nodes, for the best shift: the sum over the three families of rows of
/// the wave that is 1 on the rows and least between them.
double coherence(const Boundary& boundary, const Vec2& middle, Lattice& lattice) {
  const double waves_per_metre = 2 / (std::numbers::sqrt3 * lattice.step);
  std::array<Vec2, 3> wave;
  Turn across = times(lattice.axis, {0, 1});
  for (Vec2& w : wave) {
    w = waves_per_metre * across;
    across = times(across, kSixth);
  }
  std::array<Turn, 3> sum{Turn::Zero(), Turn::Zero(), Turn::Zero()};
  for (const Vec2& p : boundary.nodes())
    for (int k = 0; k < 3; ++k) sum[k] += turn_of(wave[k].dot(p - middle));
  const Vec2 u = lattice.step / kShifts * lattice.axis, v = lattice.step / kShifts * times(lattice.axis, kSixth);
  double best = -1e300;
  for (int i = 0; i < kShifts; ++i)
    for (int j = 0; j < kShifts; ++j) {
      const Vec2 shift = i * u + j * v;
      double value = 0;
      for (int k = 0; k < 3; ++k) value += sum[k].dot(turn_of(wave[k].dot(shift)));
      if (value > best + 1e-6) {
        best = value;
        lattice.origin = middle + shift;
      }
    }
  return best;
}

}  // namespace

Lattice fit_lattice(const Boundary& boundary, double step) {
  const Vec2 middle = 0.5 * (boundary.low() + boundary.high());
  const Turn turn = half(half(half(half(kSixth))));
  Lattice best, lattice;
  double best_value = -1e300;
  lattice.step = step;
  for (int a = 0; a < kAngles; ++a, lattice.axis = times(lattice.axis, turn)) {
    const double value = coherence(boundary, middle, lattice);
    if (value > best_value + 1e-6) {
      best_value = value;
      best = lattice;
    }
  }
  return best;
}

}  // namespace vitrine::mesh_room
