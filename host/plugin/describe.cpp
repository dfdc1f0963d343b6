// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/host/describe.hpp"

#include <cstdarg>
#include <cstdio>

#include "print.hpp"

namespace vitrine {

void print(std::string& out, const char* format, ...) {
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  if (length > 0) {
    const std::size_t old = out.size();
    out.resize(old + static_cast<std::size_t>(length) + 1);
    std::vsnprintf(out.data() + old, static_cast<std::size_t>(length) + 1, format, again);
    out.pop_back();
  }
  va_end(again);
}

namespace {

const char* name_of(Turn turn) {
  switch (turn) {
    case Turn::concave:
      return "concave";
    case Turn::convex:
      return "convex";
    case Turn::any:
      break;
  }
  return "any";
}

const char* name_of(EdgeKind kind) {
  switch (kind) {
    case EdgeKind::seam:
      return "seam";
    case EdgeKind::neck:
      return "neck";
    case EdgeKind::open:
      break;
  }
  return "open";
}

const char* name_of(Side side) {
  return side == Side::front ? "front" : "back";
}

}  // namespace

std::string describe(const GarmentTemplate& g) {
  std::string out;
  print(out, "%s (%s)\n  plugin %s %s\n", g.title.c_str(), g.id.c_str(), g.plugin.c_str(), g.version.c_str());
  const auto feature = [&](int i) { return g.features[static_cast<std::size_t>(i)].name.c_str(); };

  out += "\nFeatures, clockwise in the picture\n";
  print(out, "  %-18s %-15s %-18s %s\n", "name", "body landmark", "mirror", "turn");
  for (const TemplateFeature& f : g.features)
    print(out, "  %-18s %-15s %-18s %s\n", f.name.c_str(), f.landmark.empty() ? "-" : f.landmark.c_str(),
          f.mirror < 0 ? "-" : feature(f.mirror), name_of(f.turn));

  out += "\nEdges, front and back\n";
  for (const TemplateEdge& e : g.edges)
    print(out, "  %-20s %-5s %s to %s\n", e.name.c_str(), name_of(e.kind), feature(e.from), feature(e.to));

  out += "\nSeams\n";
  for (const TemplateSeam& s : g.seams)
    print(out, "  %s %s with %s %s%s\n", name_of(s.side_a), g.edges[static_cast<std::size_t>(s.edge_a)].name.c_str(),
          name_of(s.side_b), g.edges[static_cast<std::size_t>(s.edge_b)].name.c_str(), s.reversed ? ", reversed" : "");

  for (const TemplateLimb& l : g.limbs) {
    print(out, "\nLimb %s: from %s-%s to %s-%s, along", l.name.c_str(), feature(l.root_a), feature(l.root_b),
          feature(l.tip_a), feature(l.tip_b));
    for (const std::string& landmark : l.chain) print(out, " %s", landmark.c_str());
    out += '\n';
  }

  for (const TemplatePose& pose : g.poses) {
    print(out, "\nPose %s\n  %-18s %6s %6s %7s\n", pose.name.c_str(), "feature", "u", "v", "radius");
    for (std::size_t i = 0; i < g.features.size(); ++i)
      print(out, "  %-18s %6.3f %6.3f %7.3f\n", g.features[i].name.c_str(), pose.uv[i].x(), pose.uv[i].y(),
            pose.radius[i]);
  }

  const ScaleRule& r = g.scale;
  print(out, "\nSize: twice the width %s-%s is %.2f x the body's %s girth; length from %s down to %s\n",
        feature(r.feature_a), feature(r.feature_b), r.ease, r.girth.c_str(), feature(r.top), feature(r.bottom));
  out += "Hangs at:";
  for (const int i : g.anchors) print(out, " %s", feature(i));

  out += "\n\nFabrics, the first is the default\n";
  print(out, "  %-14s %10s %10s %10s %10s %9s\n", "name", "stretch", "shear", "bend", "mass", "friction");
  print(out, "  %-14s %10s %10s %10s %10s %9s\n", "", "N/m", "N/m", "N m", "kg/m2", "-");
  for (const Fabric& f : g.fabrics)
    print(out, "  %-14s %10g %10g %10g %10g %9g\n", f.name.c_str(), f.stretch, f.shear, f.bend, f.mass, f.friction);
  return out;
}

std::string describe(const NecklineTemplate& n) {
  std::string out;
  print(out, "%s (%s)\n  plugin %s %s\n", n.title.c_str(), n.id.c_str(), n.plugin.c_str(), n.version.c_str());
  print(out, "  chosen when foreground / background in the neck area is at least %g and below %g\n", n.ratio_min,
        n.ratio_max);
  print(out, "  depth %g of the neck's width where the photo shows no neckline\n", n.default_depth);
  out += "\n  Profile: s along the neck edge, depth towards the hem\n";
  for (const Vec2& p : n.profile) print(out, "  %6.3f %6.3f\n", p.x(), p.y());
  return out;
}

}  // namespace vitrine
