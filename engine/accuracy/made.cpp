// SPDX-License-Identifier: GPL-3.0-or-later
#include "made.hpp"

#include <openssl/evp.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "child.hpp"
#include "vitrine/fidelity.hpp"

namespace vitrine::accuracy {
namespace {

using Json = nlohmann::json;

Json number(const std::optional<double>& v) {
  return v ? Json(*v) : Json();
}

std::optional<double> number(const Json& json) {
  return json.is_number() ? std::optional<double>(json.get<double>()) : std::nullopt;
}

/// Height [m] of the chest is where the body's is measured, between the two points of the bust.
void tape(const Mannequin& body, Made& made) {
  const auto at = [&](const char* name) { return body.landmarks.at(name); };
  const Vec3 waist = (at("waist_left") + at("waist_right")) / 2, arms = (at("armpit_left") + at("armpit_right")) / 2;
  const double bust = (at("bust_left").y() + at("bust_right").y()) / 2;
  made.hem = hem_height(made.surface);
  made.waist = girth_at(made.surface, waist.y(), {waist.x(), waist.z()});
  made.chest = girth_at(made.surface, bust, {arms.x(), arms.z()});
}

Made made_of(const ConvertRequest& request, const Conversion& item, bool whole) {
  Made made;
  for (const auto& [room, ms] : item.stage_ms) {
    made.cpu_ms += ms;
    if (room == "sewing") made.sewing_ms += ms;
  }
  const Drape& drape = item.drape;
  made.status = drape.status;
  if (item.error) {
    made.message = item.error->message;
    if (drape.status.empty()) made.status = item.error->code;
  }
  if (drape.positions.empty()) return made;
  made.nodes = drape.levels.empty() ? 0 : drape.levels.back().nodes;
  made.residual = drape.residual;
  made.seam_gap_mm = drape.seam_gap_mm_max;
  made.penetration_mm = drape.penetration_mm_max;
  made.estimate_mm = drape.error_estimate_mm;
  made.skipped = drape.skipped;
  made.surface = garment_surface(item.pattern, drape);
  tape(request.body->mannequin, made);
  if (!whole) return made;
  const auto look = compare_with_photo(item.front.features.labels, request.garment, item.pattern, drape.positions);
  if (look) {
    made.iou = look->iou;
    if (!look->landmarks.empty()) made.landmark_mm = look->landmark_mean_mm;
  }
  return made;
}

}  // namespace

Bytes to_bytes(const Made& made) {
  const Json json{{"status", made.status},
                  {"message", made.message},
                  {"nodes", made.nodes},
                  {"residual", made.residual},
                  {"cpu_ms", made.cpu_ms},
                  {"sewing_ms", made.sewing_ms},
                  {"peak_mb", made.peak_mb},
                  {"seam_gap_mm", made.seam_gap_mm},
                  {"penetration_mm", made.penetration_mm},
                  {"estimate_mm", number(made.estimate_mm)},
                  {"iou", number(made.iou)},
                  {"landmark_mm", number(made.landmark_mm)},
                  {"hem", number(made.hem)},
                  {"waist", number(made.waist)},
                  {"chest", number(made.chest)},
                  {"skipped", made.skipped}};
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::uint64_t sizes[3] = {text.size(), made.surface.vertices.size(), made.surface.triangles.size()};
  Bytes bytes(sizeof sizes + sizes[0] + sizes[1] * sizeof(Vec3) + sizes[2] * sizeof(Triangle));
  std::uint8_t* to = bytes.data();
  const auto put = [&to](const void* from, std::size_t size) {
    if (size > 0) std::memcpy(to, from, size);
    to += size;
  };
  put(sizes, sizeof sizes);
  put(text.data(), text.size());
  put(made.surface.vertices.data(), sizes[1] * sizeof(Vec3));
  put(made.surface.triangles.data(), sizes[2] * sizeof(Triangle));
  return bytes;
}

std::optional<Made> from_bytes(const Bytes& bytes) {
  std::uint64_t sizes[3];
  if (bytes.size() < sizeof sizes) return std::nullopt;
  std::memcpy(sizes, bytes.data(), sizeof sizes);
  for (const std::uint64_t size : sizes)
    if (size > bytes.size()) return std::nullopt;
  if (bytes.size() != sizeof sizes + sizes[0] + sizes[1] * sizeof(Vec3) + sizes[2] * sizeof(Triangle))
    return std::nullopt;
  const std::uint8_t* from = bytes.data() + sizeof sizes;
  const auto json = Json::parse(from, from + sizes[0], nullptr, false);
  if (!json.is_object()) return std::nullopt;
  Made made;
  try {
    made.status = json.at("status").get<std::string>();
    made.message = json.at("message").get<std::string>();
    made.nodes = json.at("nodes").get<int>();
    made.residual = number(json.at("residual")).value_or(1e9);
    made.cpu_ms = json.at("cpu_ms").get<double>();
    made.sewing_ms = json.at("sewing_ms").get<double>();
    made.peak_mb = json.at("peak_mb").get<double>();
    made.seam_gap_mm = number(json.at("seam_gap_mm")).value_or(0);
    made.penetration_mm = number(json.at("penetration_mm")).value_or(0);
    made.estimate_mm = number(json.at("estimate_mm"));
    made.iou = number(json.at("iou"));
    made.landmark_mm = number(json.at("landmark_mm"));
    made.hem = number(json.at("hem"));
    made.waist = number(json.at("waist"));
    made.chest = number(json.at("chest"));
    made.skipped = json.at("skipped").get<std::vector<std::string>>();
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  made.surface.vertices.resize(sizes[1]);
  made.surface.triangles.resize(sizes[2]);
  from += sizes[0];
  if (sizes[1] > 0) std::memcpy(made.surface.vertices.data()->data(), from, sizes[1] * sizeof(Vec3));
  from += sizes[1] * sizeof(Vec3);
  if (sizes[2] > 0) std::memcpy(made.surface.triangles.data()->data(), from, sizes[2] * sizeof(Triangle));
  for (const Triangle& t : made.surface.triangles)
    for (const std::uint32_t corner : t)
      if (corner >= sizes[1]) return std::nullopt;
  return made;
}

Made make(const ConvertRequest& request, const Settings& settings, bool whole) {
  ConvertRequest asked = request;
  asked.settings = settings;
  Made made;
  auto child = start([&] {
    const Conversion item = whole ? convert(asked) : cut_and_sew(asked);
    return to_bytes(made_of(asked, item, whole));
  });
  if (!child) {
    made.status = "NO_PROCESS";
    made.message = "no further process could be started";
    return made;
  }
  finish(*child);
  if (auto got = child->fine ? from_bytes(child->sent) : std::nullopt) made = *std::move(got);
  if (made.status.empty()) {
    made.status = "CRASHED";
    made.message = "the process that made it ended without a result";
  }
  made.peak_mb = child->peak_mb;
  return made;
}

std::string hash_of(const std::string& text) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  if (EVP_Digest(text.data(), text.size(), digest, &size, EVP_sha256(), nullptr) != 1) return {};
  std::string hex;
  for (unsigned int i = 0; i < size; ++i) {
    char two[3];
    std::snprintf(two, sizeof two, "%02x", digest[i]);
    hex += two;
  }
  return hex;
}

}  // namespace vitrine::accuracy
