// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <stdexcept>

#include "mesh_bench.hpp"

namespace vitrine::bench {
namespace {

struct Point {
  double x, y;  ///< decades of nodes; the figure
};
using Lines = std::map<std::string, std::vector<Point>>;

const std::map<std::string, const char*> kColours = {
    {"vitrine", "#1b6e3c"}, {"gmsh frontal", "#b3541e"}, {"CGAL Lloyd", "#5a5aa8"}};

/// Slope of the least-squares line.
double slope(const std::vector<Point>& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(points.size());
  for (const Point& p : points) x += p.x, y += p.y, xx += p.x * p.x, xy += p.x * p.y;
  return (n * xy - x * y) / (n * xx - x * x);
}

class Chart {
 public:
  Chart(std::ofstream& out, double left, double x0, double x1, double y0, double y1)
      : out_(out), left_(left), x0_(x0), x1_(x1), y0_(y0), y1_(y1) {}
  double x(double v) const { return left_ + 300 * (v - x0_) / (x1_ - x0_); }
  double y(double v) const { return 280 - 230 * (v - y0_) / (y1_ - y0_); }
  void text(double px, double py, const std::string& words, const char* colour, const char* anchor = "middle") {
    out_ << "<text x='" << px << "' y='" << py << "' fill='" << colour << "' text-anchor='" << anchor << "'>" << words
         << "</text>\n";
  }
  void line(double ax, double ay, double bx, double by) {
    out_ << "<path d='M" << ax << ' ' << ay << 'L' << bx << ' ' << by << "' stroke='#ccc'/>\n";
  }
  void draw(const Lines& lines) {
    for (const auto& [mesher, points] : lines) {
      const char* colour = kColours.at(mesher);
      for (const Point& p : points)
        out_ << "<circle cx='" << x(p.x) << "' cy='" << y(p.y) << "' r='3' fill='" << colour << "'/>\n";
    }
  }

 private:
  std::ofstream& out_;
  double left_, x0_, x1_, y0_, y1_;
};

std::string number(const char* format, double v) {
  char words[64];
  std::snprintf(words, sizeof words, format, v);
  return words;
}

void require(std::ofstream& out, const std::string& file) {
  if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace

void write_csv(const std::vector<PeerRow>& rows, const std::string& file) {
  std::ofstream out(file);
  out << "outline,mesher,edge_length_m,nodes,triangles,cpu_ms_median,min_angle_deg,mean_min_angle_deg,"
         "ratio_below_1_3_pct,ratio_above_1_6_pct,edge_cv,valence6_interior_pct\n";
  for (const PeerRow& r : rows) {
    char line[256];
    std::snprintf(line, sizeof line, ",%.6g,%d,%d,%.2f,%.2f,%.2f,%.3f,%.3f,%.4f,%.2f\n", r.edge_length, r.stats.nodes,
                  r.stats.triangles, r.ms, r.stats.min_angle_deg, r.stats.mean_min_angle_deg, 100 * r.stats.flat_share,
                  100 * r.stats.good_share, r.stats.edge_cv, 100 * r.stats.valence6_share);
    out << r.outline << ',' << r.mesher << line;
  }
  require(out, file);
}

void write_svg(const std::vector<PeerRow>& rows, const std::string& file) {
  Lines time, cv;
  double x0 = 1e9, x1 = 0, t0 = 1e9, t1 = -1e9, c1 = 0;
  for (const PeerRow& r : rows) {
    const double x = std::log10(r.stats.nodes), t = std::log10(r.ms);
    time[r.mesher].push_back({x, t});
    cv[r.mesher].push_back({x, r.stats.edge_cv});
    x0 = std::min(x0, std::floor(x));
    x1 = std::max(x1, std::ceil(x - 0.05));  // 102,000 nodes still belong to the fifth decade
    t0 = std::min(t0, std::floor(t));
    t1 = std::max(t1, std::ceil(t));
    c1 = std::max(c1, std::ceil(20 * r.stats.edge_cv) / 20);
  }
  std::ofstream out(file);
  out << "<svg xmlns='http://www.w3.org/2000/svg' width='760' height='340' font-family='sans-serif' font-size='11'>\n"
         "<rect width='760' height='340' fill='white'/>\n";
  Chart left(out, 60, x0, x1, t0, t1), right(out, 440, x0, x1, 0, c1);
  for (Chart* chart : {&left, &right})
    for (double x = x0; x <= x1; ++x) {
      chart->line(chart->x(x), 50, chart->x(x), 280);
      chart->text(chart->x(x), 296, number("%.0f", std::pow(10, x)), "#333");
    }
  for (double t = t0; t <= t1; ++t) {
    left.line(60, left.y(t), 360, left.y(t));
    left.text(54, left.y(t) + 4, number("%g", std::pow(10, t)), "#333", "end");
  }
  for (int k = 0; k <= 4; ++k) {
    right.line(440, right.y(c1 * k / 4), 740, right.y(c1 * k / 4));
    right.text(434, right.y(c1 * k / 4) + 4, number("%.3f", c1 * k / 4), "#333", "end");
  }
  left.text(210, 316, "nodes", "#333");
  right.text(590, 316, "nodes", "#333");
  left.text(60, 20, "processor time [ms], median", "#000", "start");
  right.text(440, 20, "coefficient of variation of the edge lengths", "#000", "start");
  left.draw(time);
  right.draw(cv);
  double at = 64;
  for (const auto& [mesher, points] : time) {
    const double reach = std::max_element(points.begin(), points.end(), [](auto& a, auto& b) { return a.x < b.x; })->x -
                         std::min_element(points.begin(), points.end(), [](auto& a, auto& b) { return a.x < b.x; })->x;
    left.text(68, at, mesher + (reach > 1 ? number(": nodes^%.2f", slope(points)) : ""), kColours.at(mesher), "start");
    at += 15;
  }
  out << "</svg>\n";
  require(out, file);
}

}  // namespace vitrine::bench
