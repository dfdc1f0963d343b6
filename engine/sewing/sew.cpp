// SPDX-License-Identifier: GPL-3.0-or-later
#include "sew.hpp"

#include <algorithm>

#include "relax.hpp"

namespace vitrine::sewing {
namespace {

// The pull starts gentle, so that panels travel as a whole before their borders stretch, and doubles until they meet.
constexpr int stages = 8, stage_iterations = 600;
constexpr int stall = 30;             // iterations without a tenth of the gap gained
constexpr double first_strain = 0.1;  // the force limit of the first stage, as a strain of the cloth at the seam
constexpr double growth = 2.2;        // far past what cloth bears: a seam that stays open is not a matter of strength,
                                      // and one that closes at such a strain is found overstretched afterwards

}  // namespace

std::vector<SeamSpring> springs_for(const Pattern& pattern, const Nodes& nodes, const std::vector<char>& weld, double k,
                                    double cap) {
  std::vector<SeamSpring> out;
  for (std::size_t s = 0; s < pattern.pairs.size(); ++s) {
    const NodePair& q = pattern.pairs[s];
    SeamSpring z;
    z.a = static_cast<int>(nodes[q.panel_a][q.node_a]);
    z.b = static_cast<int>(nodes[q.panel_b][q.node_b]);
    z.k = k;
    z.cap = cap;
    if (!weld[s] && z.a != z.b) out.push_back(z);
  }
  return out;
}

std::vector<double> gaps(const Pattern& pattern, const Positions& positions) {
  std::vector<double> out;
  for (const NodePair& q : pattern.pairs)
    out.push_back((positions[q.panel_a][q.node_a] - positions[q.panel_b][q.node_b]).norm());
  return out;
}

Closing close_seams(Cloth& cloth, Contact& contact, const Pattern& pattern, const Nodes& nodes,
                    const std::vector<char>& weld, double sheet_k, double edge_length, double meet) {
  Closing out;
  const double gravity = cloth.gravity;
  cloth.gravity = 0;
  auto widest = [&] {
    double most = 0;
    for (const SeamSpring& s : cloth.seams) most = std::max(most, (cloth.at(s.a) - cloth.at(s.b)).norm());
    return most;
  };
  out.k = sheet_k;
  out.cap = first_strain * sheet_k * edge_length;
  for (int stage = 0; stage < stages; ++stage) {
    cloth.seams = springs_for(pattern, nodes, weld, out.k, out.cap);
    if (cloth.seams.empty()) break;
    strengthen(contact, out.cap);  // a seam must not be drawn through a limb
    RelaxOptions o;
    o.residual = 0;
    o.max_iterations = stage_iterations;
    o.step_limit = std::min(0.02, edge_length);
    o.check_every = 10;
    double best = widest();
    int gained = 0;
    o.stop = [&](int it, double) {
      const double now = widest();
      if (now < 0.9 * best) best = now, gained = it;
      // A pull that is used up makes way for a stronger one.
      return now < meet || it > gained + stall;
    };
    const RelaxOutcome r = relax(cloth, &contact, o);
    out.iterations += r.iterations;
    out.finite = out.finite && r.finite;
    if (widest() < meet || !r.finite) break;
    out.k *= growth;
    out.cap *= growth;
  }
  cloth.gravity = gravity;
  cloth.seams.clear();
  const std::vector<double> gap = gaps(pattern, scatter(cloth, nodes));
  for (std::size_t s = 0; s < gap.size(); ++s) {
    out.met.push_back(weld[s] || gap[s] < meet);
    if (weld[s]) continue;
    if (out.met.back()) {
      out.gap_met = std::max(out.gap_met, gap[s]);
    } else {
      out.gap_open = std::max(out.gap_open, gap[s]);
      ++out.open;
    }
  }
  return out;
}

}  // namespace vitrine::sewing
