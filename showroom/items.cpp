// SPDX-License-Identifier: GPL-3.0-or-later
#include "items.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "model.hpp"
#include "vitrine/sku.hpp"

namespace vitrine::showroom {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::uintmax_t most_line = 4u << 20, most_report = 16u << 20;  // [byte]
constexpr std::size_t most_sizes = 64, most_bodies = 256;

std::string text_of(const Json& json, const char* key) {
  const auto found = json.is_object() ? json.find(key) : json.end();
  return json.is_object() && found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

const Json& part_of(const Json& json, const char* key) {
  static const Json nothing = Json::object();
  if (!json.is_object()) return nothing;
  const auto found = json.find(key);
  return found == json.end() ? nothing : *found;
}

double number_of(const Json& json, const char* key) {
  const Json& value = part_of(json, key);
  return value.is_number() && std::isfinite(value.get<double>()) ? value.get<double>() : 0;
}

bool plain_file(const fs::path& path) {
  std::error_code failed;
  return fs::is_regular_file(fs::symlink_status(path, failed));
}

bool plain_folder(const fs::path& path) {
  std::error_code failed;
  return fs::is_directory(fs::symlink_status(path, failed));
}

Json read_report(const fs::path& file) {
  std::error_code failed;
  if (!plain_file(file) || fs::file_size(file, failed) > most_report || failed) return {};
  std::ifstream in(file, std::ios::binary);
  return Json::parse(in, nullptr, false);
}

WornBody body_of(const Json& report, const std::string& size) {
  WornBody body;
  const Json& mannequin = part_of(report, "mannequin");
  const std::string source = text_of(mannequin, "source");
  if (source == "built-in woman") body.sex = "woman";
  if (source == "built-in man") body.sex = "man";
  body.label = size.empty() ? source : size;
  const Json& mm = part_of(mannequin, "measurements_mm");
  for (std::size_t i = 0; i < body.cm.size(); ++i) body.cm[i] = std::round(number_of(mm, body_measures[i])) / 10;
  if (std::any_of(body.cm.begin(), body.cm.end(), [](double v) { return !(v > 0); })) body.cm.fill(0);
  return body;
}

/// What a shop lists of a garment that lies flat, where both ends were seen.
std::vector<FlatMeasure> flat_measures(const Json& report) {
  const double scale = number_of(part_of(report, "panels"), "mm_per_pixel_front") / 10;
  std::map<std::string, std::pair<double, double>> points;
  const Json& features = part_of(report, "features");
  if (features.is_array())
    for (const Json& point : features)
      if (text_of(point, "panel") == "front" && number_of(point, "confidence") >= 0.5)
        points[text_of(point, "name")] = {number_of(point, "x") * scale, number_of(point, "y") * scale};
  std::vector<FlatMeasure> list;
  const auto add = [&](const char* name, double cm) {
    if (cm > 0.5 && cm < 400) list.push_back({name, std::round(cm * 2) / 2});
  };
  const auto between = [&](const char* name, const char* a, const char* b) {
    const auto p = points.find(a), q = points.find(b);
    if (p != points.end() && q != points.end())
      add(name, std::hypot(p->second.first - q->second.first, p->second.second - q->second.second));
  };
  between("Chest, armpit to armpit", "armpit_left", "armpit_right");
  between("Waist, lying flat", "waist_left", "waist_right");
  between("Shoulder to shoulder", "shoulder_left", "shoulder_right");
  between("Hem, lying flat", "hem_left", "hem_right");
  for (const char* top : {"neck_left", "waist_left"}) {
    const auto p = points.find(top), q = points.find("hem_left");
    if (p != points.end() && q != points.end()) add("Length at the side", q->second.second - p->second.second);
  }
  return list;
}

int number_of_body(std::vector<WornBody>& bodies, const WornBody& body) {
  const auto found = std::find(bodies.begin(), bodies.end(), body);
  if (found != bodies.end()) return static_cast<int>(found - bodies.begin());
  if (bodies.size() >= most_bodies) return -1;
  bodies.push_back(body);
  return static_cast<int>(bodies.size()) - 1;
}

/// XS before S before M; names that are no size come after, in their own order.
int rank_of(const std::string& size) {
  std::string name = size.substr(size.rfind('-') == std::string::npos ? 0 : size.rfind('-') + 1);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  constexpr const char* sizes[] = {"xxs", "xs", "s", "m", "l", "xl", "xxl", "xxxl"};
  return static_cast<int>(std::find(std::begin(sizes), std::end(sizes), name) - std::begin(sizes));
}

bool add_look(ShownItem& item, ShownCatalogue& all, const fs::path& folder, const std::string& size) {
  if (!plain_file(folder / "dressed.glb") || !plain_file(folder / "garment.glb")) return false;
  const Json report = read_report(folder / "report.json");
  if (!report.is_object()) return false;
  Look look;
  look.size = size;
  look.folder = folder;
  look.body = number_of_body(all.bodies, body_of(report, size));
  look.fabric = shown_text(text_of(part_of(report, "fabric"), "name"), 80);
  look.flat = flat_measures(report);
  if (item.looks.empty()) {
    const Json& photos = part_of(report, "photos");
    item.front = text_of(photos, "front");
    item.back = text_of(photos, "back");
    if (item.back == "mirrored front") item.back.clear();
    if (const std::string id = text_of(part_of(report, "neckline"), "id"); !id.empty()) item.neckline = id;
  }
  item.looks.push_back(std::move(look));
  return true;
}

void add_looks(ShownItem& item, ShownCatalogue& all, const fs::path& folder) {
  if (add_look(item, all, folder, "")) return;
  std::error_code failed;
  std::vector<std::string> sizes;
  for (const auto& entry : fs::directory_iterator(folder, failed)) {
    const std::string name = entry.path().filename().string();
    if (is_safe_sku(name) && plain_folder(entry.path())) sizes.push_back(name);
  }
  std::sort(sizes.begin(), sizes.end(), [](const std::string& a, const std::string& b) {
    const int i = rank_of(a), j = rank_of(b);
    return i != j ? i < j : a < b;
  });
  for (const std::string& size : sizes)
    if (item.looks.size() < most_sizes) add_look(item, all, folder / size, size);
}

Part part_of(const ShownItem& item) {
  const auto garment = vertical_extent(item.looks.front().folder / "garment.glb");
  const auto dressed = vertical_extent(item.looks.front().folder / "dressed.glb");
  if (!garment || !dressed || !(dressed->high > 0.5)) return Part::none;
  const double low = garment->low / dressed->high, high = garment->high / dressed->high;
  // In statures: a waistband lies about 0.62 high, shoulders 0.82, the crotch 0.47. What begins at the shoulders and
  // ends above the middle of the thigh is worn with something; what ends below it is a dress.
  if (high < 0.72) return Part::bottom;
  return low > 0.40 ? Part::top : Part::none;
}

}  // namespace

std::string shown_text(const std::string& text, std::size_t most) {
  std::string out;
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[i + k]); };
    const unsigned first = byte(0);
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xC2 && first < 0xE0 ? 2
                               : first >= 0xE0 && first < 0xF0 ? 3
                               : first >= 0xF0 && first < 0xF5 ? 4
                                                               : 0;
    char32_t code = length == 1 ? first : length == 0 ? 0xFFFD : first & (0xFFu >> (length + 1));
    bool good = length > 0 && i + length <= text.size();
    for (std::size_t k = 1; good && k < length; ++k) {
      good = (byte(k) & 0xC0u) == 0x80;
      code = code << 6 | (byte(k) & 0x3Fu);
    }
    if (good && ((length == 3 && (code < 0x800 || (code >= 0xD800 && code < 0xE000))) ||
                 (length == 4 && (code < 0x10000 || code > 0x10FFFF))))
      good = false;
    const std::string piece = good ? text.substr(i, length) : "\xEF\xBF\xBD";
    i += good ? length : 1;
    if (good && (code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029)) {
      if (!out.empty() && out.back() != ' ') out += ' ', ++count;
      continue;
    }
    const bool turns = good && (code == 0x200E || code == 0x200F || code == 0x061C ||
                                (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069));
    if (turns) continue;
    if (count >= most) return out + "\xE2\x80\xA6";
    out += piece;
    ++count;
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

Result<ShownCatalogue> read_catalogue(const fs::path& folder) {
  std::ifstream in(folder / "report.jsonl", std::ios::binary);
  if (!in)
    return Error{Cause::missing, "NO_CATALOGUE", (folder / "report.jsonl").string() + " cannot be read",
                 "name the output folder of a finished vitrine catalog run", "showroom"};
  ShownCatalogue all;
  std::set<std::string> seen;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const Json json = line.size() > most_line ? Json() : Json::parse(line, nullptr, false);
    const std::string sku = text_of(json, "sku"), status = text_of(json, "status");
    if (!json.is_object() || !is_safe_sku(sku) || !seen.insert(sku).second)
      return Error{Cause::unusable, "REPORT_LINE",
                   (folder / "report.jsonl").string() + ":" + std::to_string(number) +
                       ": not the line of an item, or its SKU cannot be a folder's name, or comes twice",
                   "run vitrine catalog run again, which writes the report anew", "showroom"};
    if (status != "ok" && status != "partly") continue;
    ShownItem item;
    item.sku = sku;
    item.garment = shown_text(text_of(json, "garment"), 60);
    item.neckline = text_of(json, "neckline");
    item.title = shown_text(text_of(json, "title"), 300);
    if (item.title.empty()) item.title = item.garment + " " + sku;
    if (plain_folder(folder / sku)) add_looks(item, all, folder / sku);
    if (item.looks.empty()) {
      all.warnings.push_back(sku + ": left out, its folder has no garment.glb, dressed.glb and report.json");
      continue;
    }
    item.neckline = shown_text(item.neckline, 60);
    const auto colours = colour_families(item.looks.front().folder / "garment.glb");
    if (colours)
      item.colours = *colours;
    else
      all.warnings.push_back(sku + ": no colour family, " + colours.error().message);
    item.part = part_of(item);
    all.items.push_back(std::move(item));
  }
  if (all.items.empty())
    return Error{Cause::unusable, "EMPTY_CATALOGUE", folder.string() + ": no item of the catalogue can be shown",
                 "look into its report.html, mend the items and run the catalogue again", "showroom"};
  return all;
}

}  // namespace vitrine::showroom
