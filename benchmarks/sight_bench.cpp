// SPDX-License-Identifier: GPL-3.0-or-later
// How well garments are seen, and what seeing costs: silhouettes, feature points and necklines against marked photos
// (--photos, the folder described in docs/TESTING.md) or against generated photos (--variants N), with GrabCut at 512
// px beside them in the same run (--grabcut). Prints a table, keeps it as CSV and draws it as SVG. Run by hand.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "sight_cases.hpp"
#include "vitrine/features.hpp"
#include "vitrine/host/registry.hpp"
#include "vitrine/photo.hpp"
#include "vitrine/silhouette.hpp"

namespace vitrine::sight {
namespace {

struct Row {
  std::string name, garment, ground, method, code;
  double iou = 0, face_iou = 0, contour = 0;  ///< [-]
  std::vector<double> distances;              ///< [-] feature points, share of the garment's diagonal
  std::string neckline, neckline_wanted;      ///< empty = not asked
  double neck_ratio = 0;
  int neckline_right = -1;  ///< -1 = not asked
  double silhouette_ms = 0, features_ms = 0, grabcut_ms = 0, megapixel = 0, grabcut_iou = 0;
};

double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

cv::Mat view(const Image& i) {
  return cv::Mat(i.height, i.width, CV_8UC(i.channels), const_cast<std::uint8_t*>(i.data.data()));
}

double overlap(const cv::Mat& a, const cv::Mat& b) {
  const int any = cv::countNonZero(a | b);
  return any ? static_cast<double>(cv::countNonZero(a & b)) / any : 0;
}

double diagonal_of(const cv::Mat& mask) {
  const cv::Rect box = cv::boundingRect(mask);
  return std::hypot(box.width, box.height);
}

/// Share of the marked contour's length that the found contour comes within `reach` [px] of.
double contour_share(const cv::Mat& found, const cv::Mat& truth, double reach) {
  const auto rim = [](const cv::Mat& mask) {
    cv::Mat padded, inner;
    cv::copyMakeBorder(mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
    cv::erode(padded, inner, cv::Mat());
    return cv::Mat(padded & ~inner);
  };
  cv::Mat distance;
  cv::distanceTransform(~rim(found), distance, cv::DIST_L2, 5);
  const cv::Mat marked = rim(truth);
  return cv::countNonZero(marked & (distance <= reach)) / std::max(1.0, static_cast<double>(cv::countNonZero(marked)));
}

/// The peer: OpenCV's GrabCut at 512 px, five rounds, from a rectangle of 97 % of the picture.
cv::Mat grabcut(const cv::Mat& rgb) {
  const double scale = std::min(1.0, 512.0 / std::max(rgb.cols, rgb.rows));
  cv::Mat small, labels, background, foreground, mask;
  cv::resize(rgb, small, {}, scale, scale, cv::INTER_AREA);
  const int x = std::max(1, static_cast<int>(0.015 * small.cols)),
            y = std::max(1, static_cast<int>(0.015 * small.rows));
  cv::grabCut(small, labels, {x, y, small.cols - 2 * x, small.rows - 2 * y}, background, foreground, 5,
              cv::GC_INIT_WITH_RECT);
  mask = (labels == cv::GC_FGD) | (labels == cv::GC_PR_FGD);
  cv::resize(mask, mask, rgb.size(), 0, 0, cv::INTER_LINEAR);
  return mask > 127;
}

struct Asked {
  bool grabcut = false;
  int repeat = 1;
  std::string pictures;
  std::string save;
};

/// The photo, greyed, with what was found too much in red and what was missed in blue.
void draw(const std::string& file, const cv::Mat& rgb, const cv::Mat& found, const cv::Mat& truth) {
  cv::Mat picture;
  cv::cvtColor(rgb, picture, cv::COLOR_RGB2BGR);
  picture = 0.5 * picture + cv::Scalar(100, 100, 100);
  picture.setTo(cv::Scalar(30, 30, 220), found & ~truth);
  picture.setTo(cv::Scalar(220, 60, 30), truth & ~found);
  cv::imwrite(file, picture);
}

Row measure(const Case& c, const PluginRegistry& registry, const Asked& asked) {
  Row row;
  row.name = c.name;
  row.garment = c.garment;
  row.ground = c.ground;
  const cv::Mat rgb = view(c.photo.rgb), truth = view(c.truth) > 0;
  if (!asked.save.empty()) {
    cv::Mat bgr;
    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    cv::imwrite(asked.save + "/" + c.name + ".png", bgr);
    cv::imwrite(asked.save + "/" + c.name + ".mask.png", view(c.truth));
  }
  row.megapixel = 1e-6 * static_cast<double>(rgb.total());
  Result<Silhouette> seen = Error{};
  row.silhouette_ms = 1e30;
  for (int k = 0; k < asked.repeat; ++k) {
    const double start = cpu_ms();
    seen = find_silhouette(c.photo);
    row.silhouette_ms = std::min(row.silhouette_ms, cpu_ms() - start);
  }
  if (asked.grabcut) {
    cv::setNumThreads(1);
    const double start = cpu_ms();
    const cv::Mat peer = grabcut(rgb);
    row.grabcut_ms = cpu_ms() - start;
    row.grabcut_iou = overlap(peer, truth);
  }
  if (!seen) {
    row.code = seen.error().code;
    return row;
  }
  row.method = seen->method;
  const cv::Mat found = view(seen->labels) > 0;
  row.iou = overlap(found, truth);
  const double diagonal = diagonal_of(truth);
  if (!asked.pictures.empty()) draw(asked.pictures + "/" + c.name + ".png", rgb, found, truth);
  row.contour = contour_share(found, truth, 0.006 * diagonal);
  for (const std::string& w : seen->warnings) row.code += (row.code.empty() ? "" : "+") + w;
  const GarmentTemplate* garment = registry.find_garment(c.garment);
  if (!garment) return row;
  FeatureOptions options;
  options.side = c.back ? Side::back : Side::front;
  const std::vector<NecklineTemplate> necklines = registry.necklines();
  const double start = cpu_ms();
  const auto features = find_features(c.photo, *seen, *garment, necklines, options);
  row.features_ms = cpu_ms() - start;
  if (!features) {
    row.code += (row.code.empty() ? "" : "+") + features.error().code;
    return row;
  }
  row.face_iou = overlap(view(features->labels) == label_outside, view(c.truth) == label_outside);
  for (const FeaturePoint& p : features->points) {
    const auto marked = c.points.find(p.name);
    if (marked != c.points.end()) row.distances.push_back((p.pixel - marked->second).norm() / diagonal);
  }
  if (c.points.contains("neck_low") && !features->neckline.id.empty())
    row.distances.push_back((features->neckline.low - c.points.at("neck_low")).norm() / diagonal);
  if (!c.neckline.empty() && !c.back) {
    row.neckline_wanted = c.neckline;
    row.neckline = features->neckline.id;
    row.neck_ratio = features->neckline.ratio;
    row.neckline_right = row.neckline == c.neckline;
  }
  return row;
}

double mean(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x;
  return v.empty() ? 0 : sum / static_cast<double>(v.size());
}

double quantile(std::vector<double> v, double share) {
  if (v.empty()) return 0;
  std::sort(v.begin(), v.end());
  return v[static_cast<std::size_t>(share * static_cast<double>(v.size() - 1) + 0.5)];
}

void print_group(const char* title, const std::vector<Row>& rows, const std::function<bool(const Row&)>& in) {
  std::vector<double> iou, face, contour, points, ms, features, peer, peer_iou;
  int refused = 0, silent = 0, necks = 0, necks_right = 0, n = 0;
  for (const Row& r : rows) {
    if (!in(r)) continue;
    ++n;
    ms.push_back(r.silhouette_ms);
    if (r.features_ms > 0) features.push_back(r.features_ms);
    if (r.grabcut_ms > 0) peer.push_back(r.grabcut_ms), peer_iou.push_back(r.grabcut_iou);
    if (r.method.empty()) {
      ++refused;
      continue;
    }
    iou.push_back(r.iou);
    contour.push_back(r.contour);
    silent += r.iou < 0.90 && r.code.empty();
    if (r.face_iou > 0) face.push_back(r.face_iou);
    points.insert(points.end(), r.distances.begin(), r.distances.end());
    if (r.neckline_right >= 0) ++necks, necks_right += r.neckline_right;
  }
  if (n == 0) return;
  std::printf(
      "%-12s %d photos, %d refused | IoU mean %.4f p10 %.4f worst %.4f | contour %.3f | face IoU %.4f | silent %d\n",
      title, n, refused, mean(iou), quantile(iou, 0.1), quantile(iou, 0), mean(contour), mean(face), silent);
  std::printf(
      "%-12s points median %.2f %% p90 %.2f %% (%zu) | neckline %d of %d | CPU ms silhouette %.0f (max %.0f) features "
      "%.0f",
      "", 100 * quantile(points, 0.5), 100 * quantile(points, 0.9), points.size(), necks_right, necks, mean(ms),
      quantile(ms, 1), mean(features));
  if (!peer.empty())
    std::printf(" | GrabCut %.0f ms, IoU %.4f, %.1f x", mean(peer), mean(peer_iou),
                mean(peer) / std::max(1e-9, mean(ms)));
  std::printf("\n");
}

void write_csv(const std::string& file, const std::vector<Row>& rows) {
  std::ofstream out(file + ".part");
  out << "photo,garment,ground,method,codes,iou,face_iou,contour_share,points,point_median_percent,point_worst_percent,"
         "neckline_wanted,neckline,neck_ratio,megapixel,silhouette_cpu_ms,features_cpu_ms,grabcut_cpu_ms,grabcut_iou\n";
  for (const Row& r : rows) {
    char line[512];
    std::snprintf(line, sizeof line,
                  "%s,%s,%s,%s,%s,%.4f,%.4f,%.4f,%zu,%.3f,%.3f,%s,%s,%.3f,%.3f,%.1f,%.1f,%.1f,%.4f\n", r.name.c_str(),
                  r.garment.c_str(), r.ground.c_str(), r.method.c_str(), r.code.c_str(), r.iou, r.face_iou, r.contour,
                  r.distances.size(), 100 * quantile(r.distances, 0.5), 100 * quantile(r.distances, 1),
                  r.neckline_wanted.c_str(), r.neckline.c_str(), r.neck_ratio, r.megapixel, r.silhouette_ms,
                  r.features_ms, r.grabcut_ms, r.grabcut_iou);
    out << line;
  }
  out.close();
  std::filesystem::rename(file + ".part", file);
}

/// IoU of each photo, sorted, one dot each: plain boards blue, others orange; the bars of 0.955 and 0.98 as lines.
void write_svg(const std::string& file, std::vector<Row> rows) {
  std::erase_if(rows, [](const Row& r) { return r.method.empty(); });
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.iou < b.iou; });
  const double w = 900, h = 420, left = 60, bottom = 40, low = 0.85;
  const auto y = [&](double iou) { return 20 + (h - 20 - bottom) * (1 - (std::max(iou, low) - low) / (1 - low)); };
  std::ofstream out(file + ".part");
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << w << ' ' << h
      << "\" font-family=\"sans-serif\" font-size=\"12\"><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  for (const double bar : {0.85, 0.90, 0.955, 0.98, 1.0})
    out << "<line x1=\"" << left << "\" x2=\"" << w - 20 << "\" y1=\"" << y(bar) << "\" y2=\"" << y(bar)
        << "\" stroke=\"#ccc\"/><text x=\"14\" y=\"" << y(bar) + 4 << "\">" << bar << "</text>\n";
  for (std::size_t i = 0; i < rows.size(); ++i)
    out << "<circle r=\"4\" cx=\""
        << left + (w - left - 30) * (static_cast<double>(i) + 0.5) / static_cast<double>(rows.size()) << "\" cy=\""
        << y(rows[i].iou) << "\" fill=\"" << (rows[i].ground.starts_with("plain") ? "#3366bb" : "#e07b20")
        << "\"><title>" << rows[i].name << ' ' << rows[i].iou << "</title></circle>\n";
  out << "<text x=\"" << left << "\" y=\"" << h - 12
      << "\">IoU with the marked garment, photos sorted; blue: plain board, orange: other grounds</text></svg>\n";
  out.close();
  std::filesystem::rename(file + ".part", file);
}

int run(int argc, char** argv) {
  CLI::App app("Accuracy and cost of seeing garments");
  std::string photos, only, csv, svg;
  int variants = 0, first = 1;
  Asked asked;
  app.add_option("--photos", photos, "Folder with index.tsv, masks and landmarks");
  app.add_option("--only", only, "Only photos whose name contains this");
  app.add_option("--variants", variants, "Number of generated photos");
  app.add_option("--first", first, "First seed of the generated photos");
  app.add_option("--repeat", asked.repeat, "Silhouettes are timed as the least of this many runs")
      ->check(CLI::Range(1, 99));
  app.add_flag("--grabcut", asked.grabcut, "Also run the peer");
  app.add_option("--pictures", asked.pictures, "Draw found against marked silhouettes into this folder")
      ->check(CLI::ExistingDirectory);
  app.add_option("--save", asked.save, "Write each photo and its marked labels as PNG into this folder")
      ->check(CLI::ExistingDirectory);
  app.add_option("--csv", csv, "Write the rows here");
  app.add_option("--svg", svg, "Draw the rows here");
  CLI11_PARSE(app, argc, argv);
  PluginSearch search;
  search.folders = {std::string(VITRINE_BINARY_DIR) + "/lib/vitrine-1/plugins"};
  search.built_in = false;
  const PluginRegistry registry = PluginRegistry::load(search);
  std::vector<Row> rows;
  const auto add = [&](const Case& c) {
    rows.push_back(measure(c, registry, asked));
    const Row& r = rows.back();
    std::printf(
        "%-20s %-12s %-7s IoU %.4f face %.4f contour %.3f points %.2f/%.2f %% neck %2d  %5.0f ms %4.0f ms  %s\n",
        r.name.c_str(), r.ground.c_str(), r.method.c_str(), r.iou, r.face_iou, r.contour,
        100 * quantile(r.distances, 0.5), 100 * quantile(r.distances, 1), r.neckline_right, r.silhouette_ms,
        r.features_ms, r.code.c_str());
    std::fflush(stdout);
  };
  if (!photos.empty())
    for (const Case& c : marked_photos(photos))
      if (c.name.find(only) != std::string::npos) add(c);
  for (int k = 0; k < variants; ++k) add(variant(static_cast<std::uint32_t>(first + k)));
  if (rows.empty()) {
    std::fprintf(stderr, "nothing to measure: give --photos FOLDER or --variants N\n");
    return 64;
  }
  print_group("plain", rows, [](const Row& r) { return r.ground.starts_with("plain"); });
  print_group("other", rows, [](const Row& r) { return !r.ground.starts_with("plain") && r.ground != "generated"; });
  print_group("generated", rows, [](const Row& r) { return r.ground == "generated"; });
  print_group("all", rows, [](const Row&) { return true; });
  if (!csv.empty()) write_csv(csv, rows);
  if (!svg.empty()) write_svg(svg, rows);
  return 0;
}

}  // namespace
}  // namespace vitrine::sight

int main(int argc, char** argv) {
  return vitrine::sight::run(argc, argv);
}
