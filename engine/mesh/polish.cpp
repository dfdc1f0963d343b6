// SPDX-License-Identifier: GPL-3.0-or-later
#include "polish.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vitrine::mesh_room {
namespace {

constexpr double kGoodRatio = 1.63, kFlatRatio = 1.36;  ///< [-] the rules' 1.6 and 1.3 with a margin
constexpr double kGoodSine = 0.62;                      ///< [-] of the smallest angle: 38 degrees
constexpr double kSharpSine = 0.42;                     ///< 25 degrees: below it nothing is given up for others' sake
constexpr double kMiddlingWeight = 1, kFlatWeight = 3, kSmallWeight = 8, kSharpWeight = 80;
constexpr double kLeastGap = 0.4;    ///< [-] of a node from the wall, in target edges
constexpr double kTurnedOver = 1e9;  ///< more than all other faults together: no move is worth it
constexpr double kUneven = 0.02;     ///< [-] weight of edges off their target length
constexpr int kRounds = 5, kHalvings = 2;
constexpr double kFirstStep = 0.1, kStepDecay = 0.7;  ///< [-] in target edges, and from round to round
const std::array<Vec2, 6> kDirections = [] {
  const double s = 0.5 * std::numbers::sqrt3;
  return std::array<Vec2, 6>{Vec2(1, 0), Vec2(0.5, s), Vec2(-0.5, s), Vec2(-1, 0), Vec2(-0.5, -s), Vec2(0.5, -s)};
}();

/// What is wrong with a triangle; 0 when its edge ratio and smallest angle are good.
double fault(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - b, w = a - c;
  const double twice_area = u.x() * v.y() - u.y() * v.x();
  double p = u.squaredNorm(), q = v.squaredNorm(), r = w.squaredNorm();
  if (p > q) std::swap(p, q);
  if (q > r) std::swap(q, r);
  if (p > q) std::swap(p, q);
  if (twice_area <= 0) return kTurnedOver;
  // Most triangles are near enough to equilateral to need no roots: no edge below 0.82 of the longest is a ratio of
  // 1.64 at least.
  if (p > 0.82 * 0.82 * r) return 0;
  const double longest = std::sqrt(r), middle = std::sqrt(q), ratio = (std::sqrt(p) + middle) / longest;
  const double sine = twice_area / (middle * longest);  // of the smallest angle
  return kMiddlingWeight * std::max(0.0, kGoodRatio - ratio) + kFlatWeight * std::max(0.0, kFlatRatio - ratio) +
         kSmallWeight * std::max(0.0, kGoodSine - sine) + kSharpWeight * std::max(0.0, kSharpSine - sine);
}

double faults_at(const Sheet& sheet, std::uint32_t i, const Vec2& p, double enough) {
  double sum = 0;
  const double size = sheet.size(i);
  sheet.star(i, [&](std::uint32_t b, std::uint32_t c) {
    if (sum >= enough) return;
    sum += fault(p, sheet.at(b), sheet.at(c));
    const double target = 0.5 * (size + sheet.size(b));
    const double off = (p - sheet.at(b)).squaredNorm() / (target * target) - 1;
    sum += kUneven * off * off;
    if (sheet.interior(b) || sheet.interior(c)) return;
    // A long wall segment's triangle is sharp wherever its node is: without this the node would be given up.
    const Vec2 wall = sheet.at(c) - sheet.at(b), d = p - sheet.at(b);
    const double gap = (wall.x() * d.y() - wall.y() * d.x()) / (wall.norm() * size);
    sum += kSharpWeight * std::max(0.0, kLeastGap - gap);
  });
  return sum;
}

bool improve(Sheet& sheet, std::uint32_t i, double step) {
  const Vec2 from = sheet.at(i);
  Vec2 best = from;
  double least = faults_at(sheet, i, from, 1e300);
  for (int k = 0; k < kHalvings; ++k, step *= 0.5) {
    const Vec2 centre = best;
    for (const Vec2& d : kDirections) {
      const Vec2 p = centre + step * sheet.size(i) * d;
      const double now = faults_at(sheet, i, p, least);
      if (now < least - 1e-6) {
        least = now;
        best = p;
      }
    }
  }
  sheet.move(i, best);
  return best != from;
}

}  // namespace

void polish(Sheet& sheet, const std::vector<std::uint32_t>& ring) {
  const std::vector<std::int32_t> cells = sheet.cells_of(ring);
  std::vector<char> bad(sheet.node_slots(), 0);
  double step = kFirstStep;
  for (int round = 0; round < kRounds; ++round, step *= kStepDecay) {
    std::fill(bad.begin(), bad.end(), 0);
    for (const std::int32_t c : cells) {
      const Triangle& t = sheet.cells()[c].node;
      if (fault(sheet.at(t[0]), sheet.at(t[1]), sheet.at(t[2])) > 0)
        for (const std::uint32_t i : t) bad[i] = 1;
    }
    bool moved = false;
    for (const std::uint32_t i : ring)
      if (bad[i]) moved |= improve(sheet, i, step);
    if (!moved) return;
    sheet.legalise(cells);
  }
}

}  // namespace vitrine::mesh_room
