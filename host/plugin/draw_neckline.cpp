// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>

#include "vitrine/host/describe.hpp"

namespace vitrine {

std::string draw_svg(const NecklineTemplate& n) {
  constexpr double neck = 400, left = 80, top = 70;  // [px] width of the neck edge, and its place
  const double depth = n.default_depth * neck, bottom = top + depth;
  std::string out;
  char line[256];
  const auto print = [&](const char* format, auto... values) {
    std::snprintf(line, sizeof line, format, values...);
    out += line;
  };
  print(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
      "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#23262b\">\n",
      neck + 2 * left, bottom + 80, neck + 2 * left, bottom + 80);
  out += "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  // Names are small letters, digits and underscores; ids besides have dots: nothing to escape.
  print("<text x=\"%.0f\" y=\"28\" font-size=\"18\">%s</text>\n", left, n.id.c_str());
  print("<text x=\"%.0f\" y=\"46\" fill=\"#6a6f78\">from %s %s</text>\n", left, n.plugin.substr(0, 100).c_str(),
        n.version.substr(0, 40).c_str());
  out += "<path fill=\"#f3ece2\" stroke=\"#2f6db3\" stroke-width=\"3\" d=\"M";
  for (const Vec2& p : n.profile) print("%.1f %.1f ", left + p.x() * neck, top + p.y() * depth);
  out += "Z\"/>\n";
  print("<line x1=\"%.0f\" y1=\"%.0f\" x2=\"%.0f\" y2=\"%.0f\" stroke=\"#8a8f98\" stroke-dasharray=\"4 4\"/>\n", left,
        bottom, left + neck, bottom);
  for (const Vec2& p : n.profile)
    print("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\"/>\n", left + p.x() * neck, top + p.y() * depth);
  print(
      "<text x=\"%.0f\" y=\"%.0f\">neck edge, s from 0 to 1; depth 1 is %g of its width where the photo shows "
      "none</text>\n",
      left, bottom + 28, n.default_depth);
  print("<text x=\"%.0f\" y=\"%.0f\">chosen when foreground / background is at least %g and below %g</text>\n", left,
        bottom + 50, n.ratio_min, n.ratio_max);
  return out + "</svg>\n";
}

}  // namespace vitrine
