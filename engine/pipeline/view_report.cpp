// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "as_given.hpp"

namespace vitrine {
namespace {

using Json = nlohmann::ordered_json;

/// Digits beyond what a measurement can carry only make files differ.
double rounded(double value, double step) {
  return std::round(value / step) * step;
}

/// Of the garment in the photo as given.
double tilt_as_given(const View& view) {
  const double tilt = rounded(view.features.tilt_deg, 1.0 / 64);
  return view.photo.mirrored && tilt != 0 ? -tilt : tilt;
}

const char* side_name(Side side) {
  return side == Side::front ? "front" : "back";
}

}  // namespace

Json point_json(const NamedPoint& point) {
  return {{"name", point.name},
          {"landmark", point.landmark},
          {"x", rounded(point.pixel.x(), 1.0 / 64)},
          {"y", rounded(point.pixel.y(), 1.0 / 64)},
          {"origin", point.origin},
          {"confidence", rounded(point.confidence, 1.0 / 1024)}};
}

Json silhouette_json(const Silhouette& s) {
  Json j{{"method", s.method}, {"edge_support", s.edge_support}, {"contrast", s.contrast}};
  if (!s.method_reason.empty()) j["method_reason"] = s.method_reason;
  return j;
}

Json neckline_json(const NecklineChoice& n) {
  return {{"id", n.id}, {"ratio", n.ratio}, {"forced", n.forced}, {"inside_found", n.inside_found}};
}

std::string view_json(const ViewRequest& request, const View& view) {
  Json j;
  j["status"] = view.error ? view.error->code : "OK";
  if (view.error) {
    j["stage"] = view.error->stage;
    j["message"] = view.error->message;
    j["remedy"] = view.error->remedy;
    j["exit_code"] = view.error->exit_code();
  }
  j["photo"] = request.photo;
  j["side"] = side_name(request.side);
  j["garment"] = request.garment.id;
  j["size"] = nullptr;
  if (!view.photo.rgb.empty()) j["size"] = {view.photo.source_width, view.photo.source_height};
  j["silhouette"] = Json::object();
  if (!view.silhouette.method.empty()) j["silhouette"] = silhouette_json(view.silhouette);
  j["pose"] = nullptr;
  j["tilt_deg"] = nullptr;
  j["template_score"] = nullptr;
  j["neckline"] = Json::object();
  if (!view.features.points.empty()) {
    j["pose"] = view.features.pose;
    j["tilt_deg"] = tilt_as_given(view);
    j["quarter_turns"] = view.photo.quarter_turns;
    j["template_score"] = view.features.score;
    if (!view.features.neckline.id.empty()) j["neckline"] = neckline_json(view.features.neckline);
  }
  j["features"] = Json::array();
  for (const NamedPoint& p : points_as_given(request, view)) j["features"].push_back(point_json(p));
  j["warnings"] = view.warnings();
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string view_table(const ViewRequest& request, const View& view) {
  const std::vector<NamedPoint> points = points_as_given(request, view);
  std::size_t width = 7;
  for (const NamedPoint& p : points) width = std::max(width, p.name.size());
  const NecklineChoice& neckline = view.features.neckline;
  std::ostringstream out;
  out << std::fixed << std::setprecision(1);
  out << request.garment.id << ' ' << side_name(request.side) << ": " << (view.error ? view.error->code : "OK");
  if (!points.empty()) out << ", lies " << view.features.pose << ", tilt " << tilt_as_given(view) << " degrees";
  if (!neckline.id.empty())
    out << ", neckline " << neckline.id << std::setprecision(2) << " (ratio " << neckline.ratio << ")"
        << (neckline.inside_found ? ", inside of the back seen" : "") << std::setprecision(1);
  out << '\n'
      << std::left << std::setw(static_cast<int>(width)) << "feature" << std::right << std::setw(9) << "x"
      << std::setw(9) << "y"
      << "  " << std::left << std::setw(11) << "origin"
      << "confidence\n";
  for (const NamedPoint& p : points)
    out << std::left << std::setw(static_cast<int>(width)) << p.name << std::right << std::setw(9) << p.pixel.x()
        << std::setw(9) << p.pixel.y() << "  " << std::left << std::setw(11) << p.origin << std::setprecision(2)
        << p.confidence << std::setprecision(1) << '\n';
  return out.str();
}

}  // namespace vitrine
