// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "print.hpp"
#include "vitrine/host/describe.hpp"

namespace vitrine {

namespace {

constexpr double panel_width = 640, panel_height = 740, margin_x = 110, margin_top = 92, margin_bottom = 84;
constexpr double header = 84, legend_height = 48, seam_row = 22;
constexpr std::size_t columns = 3;
constexpr const char* ink = "#23262b";
constexpr const char* cloth = "#f3ece2";

const char* colour_of(EdgeKind kind) {
  switch (kind) {
    case EdgeKind::seam:
      return "#b3392f";
    case EdgeKind::neck:
      return "#2f6db3";
    case EdgeKind::open:
      break;
  }
  return "#4d8c57";
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

void text(std::string& out, const Vec2& at, const char* anchor, double size, const char* colour,
          const std::string& what) {
  // A halo of paper keeps names readable where they cross a line.
  print(out,
        "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" font-size=\"%.0f\" stroke=\"#ffffff\" stroke-width=\"3\" "
        "stroke-linejoin=\"round\">",
        at.x(), at.y(), anchor, size);
  out += what + "</text>\n";
  print(out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" font-size=\"%.0f\" fill=\"%s\">", at.x(), at.y(), anchor,
        size, colour);
  out += what + "</text>\n";
}

/// Finds room for names: the place near a point that covers least of what is already there.
class Labels {
 public:
  Labels(const Vec2& low, const Vec2& high) : low_(low), high_(high) {}
  void block(const Vec2& centre, double half_width, double half_height) {
    taken_.push_back({centre - Vec2(half_width, half_height), centre + Vec2(half_width, half_height)});
  }
  /// Centre of the text; `outward` is the side on which it should rather stand.
  Vec2 place(const Vec2& point, const Vec2& outward, const std::string& what, double size) {
    const Vec2 half(0.31 * size * static_cast<double>(what.size()) + 2, 0.6 * size);
    Vec2 best = point;
    double least = 1e300;
    for (const double distance : {13.0, 24.0, 38.0, 54.0})
      for (int k = 0; k < 16; ++k) {
        const Vec2 direction(std::cos(k * 0.39269908169872414), std::sin(k * 0.39269908169872414));
        const Vec2 centre = point + Vec2(direction.x() * (distance + half.x()), direction.y() * (distance + half.y()));
        // Worth of a place: no overlap first, then inside the frame, then near, then on the outer side.
        double cost = 6 * distance - 40 * direction.dot(outward);
        for (const Box& box : taken_) cost += 12 * overlap({centre - half, centre + half}, box);
        cost += 200 * ((low_ - (centre - half)).cwiseMax(0).sum() + ((centre + half) - high_).cwiseMax(0).sum());
        if (cost < least) least = cost, best = centre;
      }
    taken_.push_back({best - half, best + half});
    return best;
  }

 private:
  struct Box {
    Vec2 low, high;
  };
  static double overlap(const Box& a, const Box& b) {
    const Vec2 size = a.high.cwiseMin(b.high) - a.low.cwiseMax(b.low);
    return size.x() > 0 && size.y() > 0 ? size.x() * size.y() : 0;
  }
  Vec2 low_, high_;
  std::vector<Box> taken_;
};

/// One pose of a garment, in a frame of its own.
class PoseDrawing {
 public:
  PoseDrawing(const GarmentTemplate& garment, const TemplatePose& pose, const Vec2& corner)
      : garment_(garment),
        pose_(pose),
        labels_(corner + Vec2(6, 36), corner + Vec2(panel_width - 6, panel_height - 4)) {
    // The box of the silhouette has no aspect of its own in a template; this one suits a garment on its board.
    box_ = {panel_width - 2 * margin_x, panel_height - margin_top - margin_bottom};
    origin_ = corner + Vec2(margin_x, margin_top);
    title_ = corner + Vec2(panel_width / 2, 22);
    for (const Vec2& uv : pose.uv) centre_ += at(uv) / static_cast<double>(pose.uv.size());
  }

  void draw(std::string& out) {
    print(out,
          "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" stroke=\"#cfcfcf\" "
          "stroke-dasharray=\"3 5\"/>\n",
          origin_.x(), origin_.y(), box_.x(), box_.y());
    text(out, title_, "middle", 17, ink, "pose " + pose_.name);
    outline(out);
    search_circles(out);
    for (const TemplateLimb& limb : garment_.limbs) draw_limb(out, limb);
    edges(out);
    features(out);
  }

 private:
  Vec2 at(const Vec2& uv) const { return origin_ + uv.cwiseProduct(box_); }
  Vec2 place(int feature) const { return at(pose_.uv[static_cast<std::size_t>(feature)]); }

  void outline(std::string& out) const {
    out += "<path d=\"";
    for (const TemplateEdge& edge : garment_.edges) {
      const Vec2 p = place(edge.from);
      print(out, "%s%.1f %.1f ", &edge == &garment_.edges.front() ? "M" : "L", p.x(), p.y());
    }
    print(out, "Z\" fill=\"%s\" fill-opacity=\"0.85\"/>\n", cloth);
  }

  void draw_limb(std::string& out, const TemplateLimb& limb) const {
    const Vec2 root = (place(limb.root_a) + place(limb.root_b)) / 2, tip = (place(limb.tip_a) + place(limb.tip_b)) / 2;
    for (const auto& [a, b] : {std::pair{place(limb.root_a), place(limb.root_b)}, std::pair{root, tip}})
      print(out,
            "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#8a6fb0\" stroke-width=\"2\" "
            "stroke-dasharray=\"9 6\"/>\n",
            a.x(), a.y(), b.x(), b.y());
    print(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"#8a6fb0\"/>\n", tip.x(), tip.y());
  }

  void edges(std::string& out) {
    for (const TemplateEdge& edge : garment_.edges) {
      const Vec2 a = place(edge.from), b = place(edge.to);
      print(out,
            "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"4\" "
            "stroke-linecap=\"round\"/>\n",
            a.x(), a.y(), b.x(), b.y(), colour_of(edge.kind));
      labels_.block(a, 7, 7);
    }
    for (std::size_t e = 0; e < garment_.edges.size(); ++e) {
      const TemplateEdge& edge = garment_.edges[e];
      if (edge.kind != EdgeKind::seam) continue;
      // Off the middle, so that the numbers of a sleeve's two seams and a side seam do not meet.
      const Vec2 p = place(edge.from) + (e % 2 == 0 ? 0.42 : 0.55) * (place(edge.to) - place(edge.from));
      print(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"10\" fill=\"#ffffff\" stroke=\"%s\" stroke-width=\"1.5\"/>\n",
            p.x(), p.y(), colour_of(edge.kind));
      print(out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\" font-size=\"11\" fill=\"%s\">%s</text>\n", p.x(),
            p.y() + 4, colour_of(edge.kind), seam_number(static_cast<int>(e)).c_str());
      labels_.block(p, 11, 11);
    }
    for (const TemplateEdge& edge : garment_.edges) {
      if (edge.kind == EdgeKind::seam) continue;
      const Vec2 a = place(edge.from), b = place(edge.to);
      Vec2 inward(-(b - a).y(), (b - a).x());
      inward /= std::max(inward.norm(), 1e-9);
      const Vec2 p = labels_.place((a + b) / 2, inward, edge.name, 12);
      text(out, p + Vec2(0, 4), "middle", 12, colour_of(edge.kind), edge.name);
    }
  }

  /// The seams in which an edge takes part, counted from 1.
  std::string seam_number(int edge) const {
    std::string numbers;
    for (std::size_t s = 0; s < garment_.seams.size(); ++s)
      if (garment_.seams[s].edge_a == edge || garment_.seams[s].edge_b == edge)
        numbers += (numbers.empty() ? "" : "/") + std::to_string(s + 1);
    return numbers;
  }

  void search_circles(std::string& out) const {
    for (std::size_t i = 0; i < garment_.features.size(); ++i) {
      const Vec2 p = at(pose_.uv[i]);
      print(out,
            "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"#e0a030\" fill-opacity=\"0.08\" stroke=\"#e0a030\" "
            "stroke-opacity=\"0.6\"/>\n",
            p.x(), p.y(), pose_.radius[i] * box_.norm());
    }
  }

  void features(std::string& out) {
    for (std::size_t i = 0; i < garment_.features.size(); ++i) {
      const Vec2 p = at(pose_.uv[i]);
      const Vec2 outward = (p - centre_) / std::max((p - centre_).norm(), 1e-9);
      const Vec2 label = labels_.place(p, outward, garment_.features[i].name, 13);
      if ((label - p).cwiseAbs().y() > 34)
        print(out, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#8a8f98\"/>\n", p.x(), p.y(),
              label.x(), label.y());
      text(out, label + Vec2(0, 4.5), "middle", 13, ink, garment_.features[i].name);
    }
    for (std::size_t i = 0; i < garment_.features.size(); ++i) {
      const Vec2 p = at(pose_.uv[i]);
      const bool anchor =
          std::find(garment_.anchors.begin(), garment_.anchors.end(), static_cast<int>(i)) != garment_.anchors.end();
      print(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\" fill=\"%s\" stroke=\"%s\" stroke-width=\"2\"/>\n", p.x(),
            p.y(), anchor ? "#ffffff" : ink, ink);
    }
  }

  const GarmentTemplate& garment_;
  const TemplatePose& pose_;
  Labels labels_;
  Vec2 box_, origin_, title_, centre_ = Vec2::Zero();
};

/// Only what the garment has.
void legend(std::string& out, const GarmentTemplate& garment, double y) {
  double x = 32;
  const auto entry = [&](const std::string& what, double mark_width) {
    text(out, {x + mark_width + 7, y}, "start", 13, ink, what);
    x += mark_width + 34 + 7.6 * static_cast<double>(what.size());
  };
  for (const auto& [kind, what] : {std::pair{EdgeKind::seam, "seam, with its number"},
                                   std::pair{EdgeKind::open, "open edge"}, std::pair{EdgeKind::neck, "neck edge"}}) {
    if (std::none_of(garment.edges.begin(), garment.edges.end(),
                     [k = kind](const TemplateEdge& e) { return e.kind == k; }))
      continue;
    print(out, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"4\"/>\n", x, y - 4,
          x + 26, y - 4, colour_of(kind));
    entry(what, 26);
  }
  if (!garment.limbs.empty()) {
    print(out,
          "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#8a6fb0\" stroke-width=\"2\" "
          "stroke-dasharray=\"9 6\"/>\n",
          x, y - 4, x + 26, y - 4);
    entry("limb: root line and axis", 26);
  }
  print(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\" fill=\"%s\" stroke=\"%s\" stroke-width=\"2\"/>\n", x + 5, y - 4,
        ink, ink);
  entry("feature", 10);
  print(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\" fill=\"#ffffff\" stroke=\"%s\" stroke-width=\"2\"/>\n", x + 5,
        y - 4, ink);
  entry("feature that hangs at its body landmark", 10);
  print(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"8\" fill=\"#e0a030\" fill-opacity=\"0.08\" stroke=\"#e0a030\"/>\n",
        x + 8, y - 4);
  entry("search radius", 16);
}

std::string seam_text(const GarmentTemplate& g, std::size_t s) {
  const TemplateSeam& seam = g.seams[s];
  const auto side = [](Side which) { return which == Side::front ? "front " : "back "; };
  const std::string &a = g.edges[static_cast<std::size_t>(seam.edge_a)].name,
                    &b = g.edges[static_cast<std::size_t>(seam.edge_b)].name;
  std::string what = std::to_string(s + 1) + "  ";
  if (a == b && seam.side_a != seam.side_b && !seam.reversed) return what + a;
  return what + side(seam.side_a) + a + " with " + side(seam.side_b) + b + (seam.reversed ? ", reversed" : "");
}

}  // namespace

std::string draw_svg(const GarmentTemplate& garment) {
  const std::size_t across = std::clamp<std::size_t>(garment.poses.size(), 1, columns);
  const std::size_t down = (garment.poses.size() + across - 1) / across;
  const std::size_t seams_across = 2 * across;
  const std::size_t seam_rows = (garment.seams.size() + seams_across - 1) / seams_across;
  // Never narrower than its own legend.
  const double width = std::max(1200.0, panel_width * static_cast<double>(across));
  const double poses_bottom = header + panel_height * static_cast<double>(down);
  const double height = poses_bottom + legend_height + seam_row * static_cast<double>(seam_rows) + 16;
  std::string out;
  print(out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
        "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\">\n<rect width=\"%.0f\" height=\"%.0f\" "
        "fill=\"#ffffff\"/>\n",
        width, height, width, height, width, height);
  print(out, "<text x=\"32\" y=\"44\" font-size=\"24\" fill=\"%s\">", ink);
  out += escaped(garment.title) + "</text>\n";
  print(out, "<text x=\"32\" y=\"66\" font-size=\"13\" fill=\"#6a6f78\">%s, from %s %s</text>\n", garment.id.c_str(),
        garment.plugin.c_str(), garment.version.c_str());
  for (std::size_t i = 0; i < garment.poses.size(); ++i)
    PoseDrawing(
        garment, garment.poses[i],
        Vec2(panel_width * static_cast<double>(i % across), header + panel_height * static_cast<double>(i / across)))
        .draw(out);
  legend(out, garment, poses_bottom + 28);
  const double seam_width = (width - 64) / static_cast<double>(seams_across);
  for (std::size_t s = 0; s < garment.seams.size(); ++s)
    text(out,
         {32 + seam_width * static_cast<double>(s % seams_across),
          poses_bottom + legend_height + 10 + seam_row * static_cast<double>(s / seams_across)},
         "start", 13, colour_of(EdgeKind::seam), seam_text(garment, s));
  out += "</svg>\n";
  return out;
}

}  // namespace vitrine
