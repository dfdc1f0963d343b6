// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "vitrine/host/describe.hpp"

namespace vitrine {

namespace {

constexpr double panel_width = 620, panel_height = 700, margin = 90, header = 70, footer = 56;
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

[[gnu::format(printf, 2, 3)]] void print(std::string& out, const char* format, ...) {
  char line[1024];  // every line below is shorter: names have at most 64 bytes, titles 200, and escapes six for one
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  out += line;
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

/// One pose of a garment, in a frame of its own.
class PoseDrawing {
 public:
  PoseDrawing(const GarmentTemplate& garment, const TemplatePose& pose, double left) : garment_(garment), pose_(pose) {
    // The box of the silhouette has no aspect of its own in a template; this one suits a garment on its board.
    box_ = {panel_width - 2 * margin, panel_height - 2 * margin};
    origin_ = {left + margin, header + margin};
    for (const Vec2& uv : pose.uv) centre_ += at(uv) / static_cast<double>(pose.uv.size());
  }

  void draw(std::string& out) const {
    print(out,
          "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" stroke=\"#d5d5d5\" "
          "stroke-dasharray=\"3 5\"/>\n",
          origin_.x(), origin_.y(), box_.x(), box_.y());
    text(out, {origin_.x() + box_.x() / 2, header + 24}, "middle", 17, ink, "pose " + pose_.name);
    outline(out);
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

  void edges(std::string& out) const {
    for (std::size_t e = 0; e < garment_.edges.size(); ++e) {
      const TemplateEdge& edge = garment_.edges[e];
      const Vec2 a = place(edge.from), b = place(edge.to), middle = (a + b) / 2;
      const char* colour = colour_of(edge.kind);
      print(out,
            "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"4\" "
            "stroke-linecap=\"round\"/>\n",
            a.x(), a.y(), b.x(), b.y(), colour);
      if (edge.kind == EdgeKind::seam) {
        const std::string number = seam_number(static_cast<int>(e));
        print(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"10\" fill=\"#ffffff\" stroke=\"%s\" stroke-width=\"1.5\"/>\n",
              middle.x(), middle.y(), colour);
        print(out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\" font-size=\"11\" fill=\"%s\">%s</text>\n",
              middle.x(), middle.y() + 4, colour, number.c_str());
      } else {
        // Inside the cloth, off the line.
        Vec2 normal(-(b - a).y(), (b - a).x());
        normal /= std::max(normal.norm(), 1e-9);
        text(out, middle + 15 * normal + Vec2(0, 4),
             std::abs(normal.x()) < 0.7 ? "middle"
             : normal.x() > 0           ? "start"
                                        : "end",
             12, colour, edge.name);
      }
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

  void features(std::string& out) const {
    const double diagonal = box_.norm();
    for (std::size_t i = 0; i < garment_.features.size(); ++i) {
      const Vec2 p = at(pose_.uv[i]);
      print(out,
            "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"#e0a030\" fill-opacity=\"0.10\" stroke=\"#e0a030\" "
            "stroke-opacity=\"0.7\" stroke-width=\"1\"/>\n",
            p.x(), p.y(), pose_.radius[i] * diagonal);
    }
    for (std::size_t i = 0; i < garment_.features.size(); ++i) {
      const Vec2 p = at(pose_.uv[i]);
      const bool anchor =
          std::find(garment_.anchors.begin(), garment_.anchors.end(), static_cast<int>(i)) != garment_.anchors.end();
      print(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\" fill=\"%s\" stroke=\"%s\" stroke-width=\"2\"/>\n", p.x(),
            p.y(), anchor ? "#ffffff" : ink, ink);
      const bool above = p.y() < centre_.y();
      text(out, p + Vec2(p.x() < centre_.x() ? -9 : 9, above ? -10 : 20), p.x() < centre_.x() ? "end" : "start", 13,
           ink, garment_.features[i].name);
    }
  }

  const GarmentTemplate& garment_;
  const TemplatePose& pose_;
  Vec2 box_, origin_, centre_ = Vec2::Zero();
};

void legend(std::string& out, double y) {
  double x = 32;
  for (const auto& [kind, what] : {std::pair{EdgeKind::seam, "seam (with its number)"},
                                   std::pair{EdgeKind::open, "open edge"}, std::pair{EdgeKind::neck, "neck edge"}}) {
    print(out, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"4\"/>\n", x, y - 4,
          x + 26, y - 4, colour_of(kind));
    text(out, {x + 33, y}, "start", 13, ink, what);
    x += kind == EdgeKind::seam ? 195 : 115;
  }
  print(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\" fill=\"#ffffff\" stroke=\"%s\" stroke-width=\"2\"/>\n", x + 6,
        y - 4, ink);
  text(out, {x + 18, y}, "start", 13, ink, "anchor");
}

}  // namespace

std::string draw_svg(const GarmentTemplate& garment) {
  const double width = panel_width * static_cast<double>(std::max<std::size_t>(1, garment.poses.size()));
  const double height = header + panel_height + footer;
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
  double left = 0;
  for (const TemplatePose& pose : garment.poses) {
    PoseDrawing(garment, pose, left).draw(out);
    left += panel_width;
  }
  legend(out, height - 22);
  out += "</svg>\n";
  return out;
}

}  // namespace vitrine
