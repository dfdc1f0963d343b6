// SPDX-License-Identifier: GPL-3.0-or-later
// Level 3 beyond the adoption rules: tables that are well-formed, and describe no garment that anybody wears.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "session.hpp"

namespace vitrine::validation {
namespace {

using Findings = std::map<std::string_view, std::vector<std::string>>;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double side_c = cross(b - a, c - a), side_d = cross(b - a, d - a), side_a = cross(d - c, a - c),
               side_b = cross(d - c, b - c);
  const auto on = [](const Vec2& p, const Vec2& q, const Vec2& r) {
    return r.x() >= std::min(p.x(), q.x()) && r.x() <= std::max(p.x(), q.x()) && r.y() >= std::min(p.y(), q.y()) &&
           r.y() <= std::max(p.y(), q.y());
  };
  if (side_c * side_d < 0 && side_a * side_b < 0) return true;
  return (side_c == 0 && on(a, b, c)) || (side_d == 0 && on(a, b, d)) || (side_a == 0 && on(c, d, a)) ||
         (side_b == 0 && on(c, d, b));
}

/// "left", "right" or "" of a body landmark.
std::string_view side_of(std::string_view landmark) {
  if (landmark.ends_with("_left")) return "left";
  if (landmark.ends_with("_right")) return "right";
  return {};
}
/// The landmark without its side: "armpit".
std::string_view place_of(std::string_view landmark) {
  const std::string_view side = side_of(landmark);
  return side.empty() ? landmark : landmark.substr(0, landmark.size() - side.size() - 1);
}

/// An edge that begins or ends at a limb's tip.
bool is_of_limb(const GarmentTemplate& g, std::size_t edge) {
  return std::any_of(g.limbs.begin(), g.limbs.end(), [&](const TemplateLimb& limb) {
    const TemplateEdge& e = g.edges[edge];
    return e.from == limb.tip_a || e.from == limb.tip_b || e.to == limb.tip_a || e.to == limb.tip_b;
  });
}

/// Everything about one garment.
class GarmentChecks {
 public:
  GarmentChecks(const GarmentTemplate& garment, Findings& findings) : g_(garment), findings_(findings) {
    for (const TemplatePose& pose : g_.poses) {
      simple(pose);
      mirror(pose);
      radius(pose);
      size(pose);
      sides(pose);
      neck(pose);
      anchors(pose);
      for (const TemplateSeam& seam : g_.seams) sewn(pose, seam);
    }
    partners();
    for (const TemplateLimb& limb : g_.limbs) chain(limb);
    for (const Fabric& fabric : g_.fabrics) believable(fabric);
  }

 private:
  void find(std::string_view check, const std::string& what) {
    findings_[check].push_back("garment \"" + g_.id + "\": " + what);
  }
  std::string in(const TemplatePose& pose) const { return " in pose \"" + pose.name + "\""; }
  std::string name(int feature) const { return "\"" + g_.features[static_cast<std::size_t>(feature)].name + "\""; }
  std::string name(const TemplateEdge& edge) const { return "\"" + edge.name + "\""; }

  void simple(const TemplatePose& pose) {
    for (const auto& [i, j] : crossing_edges(g_, pose))
      // A sleeve may lie on the body; the outline as it is seen then goes round both.
      if (is_of_limb(g_, i) == is_of_limb(g_, j))
        find("pose.simple", "edges " + name(g_.edges[i]) + " and " + name(g_.edges[j]) + " cross or touch" + in(pose));
  }

  void mirror(const TemplatePose& pose) {
    for (std::size_t i = 0; i < g_.features.size(); ++i) {
      const int partner = g_.features[i].mirror;
      if (partner <= static_cast<int>(i)) continue;  // each pair once
      const Vec2 &a = pose.uv[i], &b = pose.uv[static_cast<std::size_t>(partner)];
      const Vec2 &a0 = g_.poses[0].uv[i], &b0 = g_.poses[0].uv[static_cast<std::size_t>(partner)];
      const std::string pair = name(static_cast<int>(i)) + " and its mirror " + name(partner);
      if (std::abs(a.y() - b.y()) > 0.1)
        find("pose.mirror",
             pair + " lie " + number(std::abs(a.y() - b.y())) + " of the box apart in height" + in(pose));
      if ((a.x() - b.x()) * (a0.x() - b0.x()) <= 0) find("pose.mirror", pair + " have changed sides" + in(pose));
    }
  }

  void radius(const TemplatePose& pose) {
    for (std::size_t i = 0; i < pose.uv.size(); ++i) {
      double nearest = 1e9;
      for (std::size_t j = 0; j < pose.uv.size(); ++j)
        if (j != i) nearest = std::min(nearest, (pose.uv[i] - pose.uv[j]).norm());
      const double reach = pose.radius[i] * std::sqrt(2.0);  // in box sides: the diagonal of the unit box
      if (reach > 3 * nearest)
        find("pose.radius", "the search circle of " + name(static_cast<int>(i)) + " reaches " +
                                number(reach / nearest) + " times as far as the nearest other feature" + in(pose));
    }
  }

  void size(const TemplatePose& pose) {
    Vec2 low = pose.uv[0], high = pose.uv[0];
    for (const Vec2& p : pose.uv) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const Vec2 span = high - low;
    // A hem hangs below its ends, a sleeve bends out beyond its cuff: the features need not touch the box.
    if (span.minCoeff() < 0.6)
      find("pose.size", "features span " + number(span.x()) + " x " + number(span.y()) + " of the box" + in(pose));
  }

  void sides(const TemplatePose& pose) {
    for (std::size_t i = 0; i < g_.features.size(); ++i)
      for (std::size_t j = 0; j < g_.features.size(); ++j) {
        const std::string &a = g_.features[i].landmark, &b = g_.features[j].landmark;
        if (side_of(a) != "left" || side_of(b) != "right" || place_of(a) != place_of(b)) continue;
        // Crossed feet of wide legs happen; the left thing on the right does not.
        if (pose.uv[i].x() >= pose.uv[j].x() && g_.features[i].mirror == static_cast<int>(j))
          find("landmark.side", name(static_cast<int>(i)) + " hangs on " + a + " and does not lie left of " +
                                    name(static_cast<int>(j)) + " on " + b + in(pose));
      }
  }

  void neck(const TemplatePose& pose) {
    const int edge = g_.neck_edge();
    if (edge < 0) return;
    const Vec2 &from = pose.uv[g_.edges[edge].from], &to = pose.uv[g_.edges[edge].to];
    if (to.x() - from.x() < 0.05 || std::abs(to.y() - from.y()) > 0.2 * (to.x() - from.x()))
      find("neck.edge", "neck edge " + name(g_.edges[edge]) + " does not run from left to right" + in(pose));
    else if (std::max(from.y(), to.y()) > 0.25)
      find("neck.edge", "neck edge " + name(g_.edges[edge]) + " does not lie at the top" + in(pose));
  }

  void anchors(const TemplatePose& pose) {
    // A crotch may bear the weight where a rise is short; but something has to hold the top.
    const auto height = [&](int anchor) { return pose.uv[static_cast<std::size_t>(anchor)].y(); };
    const auto top =
        std::min_element(g_.anchors.begin(), g_.anchors.end(), [&](int a, int b) { return height(a) < height(b); });
    if (top != g_.anchors.end() && height(*top) > 0.5)
      find("anchor.top", "even the highest anchor, " + name(*top) + ", lies in the lower half" + in(pose));
  }

  void sewn(const TemplatePose& pose, const TemplateSeam& seam) {
    const TemplateEdge &a = g_.edges[seam.edge_a], &b = g_.edges[seam.edge_b];
    const Vec2 &p = pose.uv[a.from], &q = pose.uv[a.to], &r = pose.uv[b.from], &s = pose.uv[b.to];
    // A box has no proportions of its own; edges that are too different in all that garments have are.
    double least = 1e9;
    for (const double tall : {0.5, 1.0, 2.0}) {
      const auto length = [&](const Vec2& d) { return std::max(1e-9, Vec2(d.x(), tall * d.y()).norm()); };
      const double one = length(q - p), other = length(s - r);
      least = std::min(least, std::max(one, other) / std::min(one, other));
    }
    if (least > 3)
      find("seam.length", "seam of " + name(a) + " and " + name(b) + ": one is " + number(least) +
                              " times as long as the other" + in(pose));
    const double straight = (p - r).norm() + (q - s).norm(), crossed = (p - s).norm() + (q - r).norm();
    const double declared = seam.reversed ? crossed : straight, other = seam.reversed ? straight : crossed;
    if (declared > other + 1e-9)
      find("seam.direction", "seam of " + name(a) + " and " + name(b) + " is twisted" + in(pose) +
                                 ": reversed should be " + (seam.reversed ? "0" : "1"));
  }

  void partners() {
    for (std::size_t i = 0; i < g_.features.size(); ++i) {
      const int partner = g_.features[i].mirror;
      if (partner <= static_cast<int>(i)) continue;
      const std::string &a = g_.features[i].landmark, &b = g_.features[static_cast<std::size_t>(partner)].landmark;
      const bool both = a.empty() == b.empty() && place_of(a) == place_of(b) &&
                        (side_of(a).empty() ? side_of(b).empty() : side_of(a) != side_of(b) && !side_of(b).empty());
      if (!both)
        find("landmark.mirror", name(static_cast<int>(i)) + " lies on " + (a.empty() ? "no landmark" : a) +
                                    ", its mirror " + name(partner) + " on " + (b.empty() ? "no landmark" : b));
    }
  }

  /// Steps from the trunk along an arm or a leg, or -1.
  static int step_along(std::string_view place, bool arm) {
    constexpr std::string_view arms[] = {"neck", "shoulder", "armpit", "biceps", "elbow", "wrist"};
    constexpr std::string_view legs[] = {"waist", "hip", "crotch", "thigh", "knee", "ankle"};
    const std::span<const std::string_view> row = arm ? std::span<const std::string_view>(arms) : legs;
    const auto found = std::find(row.begin(), row.end(), place);
    return found == row.end() ? -1 : static_cast<int>(found - row.begin());
  }

  void chain(const TemplateLimb& limb) {
    const std::string limb_name = "limb \"" + limb.name + "\"";
    std::string_view side;
    bool one_side = true;
    const auto see = [&](std::string_view landmark) {
      const std::string_view own = side_of(landmark);
      if (own.empty()) return;
      one_side = one_side && (side.empty() || side == own);
      side = own;
    };
    for (const std::string& landmark : limb.chain) see(landmark);
    // The two ends of a root may lie on both sides of a crotch, but a sided tip belongs to its own limb.
    for (const int tip : {limb.tip_a, limb.tip_b}) see(g_.features[static_cast<std::size_t>(tip)].landmark);
    if (!one_side) find("limb.chain", limb_name + " is of both sides");
    bool ascends = false;
    for (const bool arm : {true, false}) {
      int last = -1;
      bool good = true;
      for (const std::string& landmark : limb.chain) {
        const int step = step_along(place_of(landmark), arm);
        good = good && step > last;
        last = step;
      }
      ascends = ascends || good;
    }
    if (!ascends) find("limb.chain", limb_name + " does not follow an arm or a leg outwards");
  }

  void believable(const Fabric& f) {
    // From chiffon and fine knits to coating and leather; a decade of room on both sides of what FAST and Kawabata
    // sheets list for clothes.
    const struct {
      const char* what;
      double value, least, most;
      const char* unit;
    } rows[] = {{"mass", f.mass, 0.02, 1.5, "kg/m2"},
                {"stretch", f.stretch, 10, 1e5, "N/m"},
                {"shear", f.shear, 1, 5e4, "N/m"},
                {"bend", f.bend, 1e-7, 1e-2, "N m"},
                {"friction", f.friction, 0.02, 1.5, "-"}};
    for (const auto& row : rows)
      if (row.value < row.least || row.value > row.most)
        find("fabric.believable", "fabric \"" + f.name + "\": " + row.what + " is " + number(row.value) + " " +
                                      row.unit + ", clothes have " + number(row.least) + " to " + number(row.most));
    if (f.shear > f.stretch) find("fabric.believable", "fabric \"" + f.name + "\" is stiffer in shear than in tension");
  }

  const GarmentTemplate& g_;
  Findings& findings_;
};

void check_neckline(const NecklineTemplate& n, Findings& findings) {
  const auto find = [&](const std::string& what) {
    findings["neckline.form"].push_back("neckline \"" + n.id + "\": " + what);
  };
  bool rising = false;
  for (std::size_t i = 1; i < n.profile.size(); ++i) {
    const double step = n.profile[i].y() - n.profile[i - 1].y();
    if (step > 0 && rising) {
      find("its profile goes down again at point " + std::to_string(i));
      break;
    }
    rising = rising || step < 0;
  }
  if (n.default_depth < 0.02 || n.default_depth > 2) find("its depth is " + number(n.default_depth) + " of its width");
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> crossing_edges(const GarmentTemplate& g, const TemplatePose& pose) {
  std::vector<std::pair<std::size_t, std::size_t>> crossings;
  const std::size_t n = g.edges.size();
  // Neighbours share a corner; they may not fold back onto each other.
  const auto fold = [](const Vec2& corner, const Vec2& one, const Vec2& other) {
    return std::abs(cross(one - corner, other - corner)) < 1e-9 && (one - corner).dot(other - corner) > 0;
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      const Vec2 &p = pose.uv[g.edges[i].from], &q = pose.uv[g.edges[i].to], &r = pose.uv[g.edges[j].from],
                 &s = pose.uv[g.edges[j].to];
      const bool next = j == i + 1, last = i == 0 && j == n - 1;
      if (next ? fold(q, p, s) : last ? fold(p, q, r) : segments_meet(p, q, r, s)) crossings.emplace_back(i, j);
    }
  return crossings;
}

void check_templates(const Session& session, const AdoptedPlugin& plugin) {
  session.begin("pose.simple");
  Findings findings;
  for (const GarmentTemplate& garment : plugin.garments) GarmentChecks(garment, findings);
  for (const NecklineTemplate& neckline : plugin.necklines) check_neckline(neckline, findings);
  const bool limbs = std::any_of(plugin.garments.begin(), plugin.garments.end(),
                                 [](const GarmentTemplate& g) { return !g.limbs.empty(); });
  const bool necks = std::any_of(plugin.garments.begin(), plugin.garments.end(),
                                 [](const GarmentTemplate& g) { return g.neck_edge() >= 0; });
  for (const char* check :
       {"pose.simple", "pose.mirror", "pose.radius", "pose.size", "landmark.side", "landmark.mirror", "seam.length",
        "seam.direction", "limb.chain", "anchor.top", "neck.edge", "neckline.form", "fabric.believable"}) {
    const std::string_view name = check;
    if (name == "neckline.form" ? plugin.necklines.empty() : plugin.garments.empty())
      session.skip(name, name == "neckline.form" ? "it brings no neckline" : "it brings no garment");
    else if (name == "limb.chain" && !limbs)
      session.skip(name, "its garments have no limbs");
    else if (name == "neck.edge" && !necks)
      session.skip(name, "its garments have no neck edge");
    else
      session.conclude(name, findings[name]);
  }
}

}  // namespace vitrine::validation
