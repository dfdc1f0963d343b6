// SPDX-License-Identifier: GPL-3.0-or-later
// What the site needs to know of a GLB of our own: how high it reaches and what colours it shows.
#include "model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace vitrine::showroom {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = 64u << 20;
constexpr int side = 256;  // [px] of the picture that colours are counted in

struct Glb {
  Json json;
  std::vector<unsigned char> bin;
};

std::uint32_t word(const unsigned char* at) {
  return at[0] | at[1] << 8 | at[2] << 16 | static_cast<std::uint32_t>(at[3]) << 24;
}

/// Header and JSON, and the binary chunk when asked for.
std::optional<Glb> read_glb(const fs::path& file, bool whole) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(file, failed);
  std::ifstream in(file, std::ios::binary);
  unsigned char head[20];
  if (failed || size > most_bytes || !in.read(reinterpret_cast<char*>(head), 20)) return {};
  const std::uint32_t length = word(head + 12);
  if (word(head) != 0x46546C67 || word(head + 16) != 0x4E4F534A || 20ull + length > size) return {};
  std::string text(length, '\0');
  if (!in.read(text.data(), length)) return {};
  Glb glb{Json::parse(text, nullptr, false), {}};
  if (!glb.json.is_object()) return {};
  if (!whole) return glb;
  if (!in.read(reinterpret_cast<char*>(head), 8)) return {};
  const std::uint32_t bytes = word(head);
  if (word(head + 4) != 0x004E4942 || 28ull + length + bytes > size) return {};
  glb.bin.resize(bytes);
  if (!in.read(reinterpret_cast<char*>(glb.bin.data()), bytes)) return {};
  return glb;
}

/// Where an accessor's numbers lie in the binary chunk; checked to lie inside.
struct Column {
  const unsigned char* at = nullptr;
  std::size_t count = 0, stride = 0;
  int type = 0;
};

Column column(const Glb& glb, std::size_t accessor, int components) {
  const Json& a = glb.json.at("accessors").at(accessor);
  const Json& v = glb.json.at("bufferViews").at(a.at("bufferView").get<std::size_t>());
  Column c;
  c.type = a.at("componentType").get<int>();
  c.count = a.at("count").get<std::size_t>();
  const std::size_t width = (c.type == 5126 || c.type == 5125 ? 4u : c.type == 5123 ? 2u : 1u) * components;
  c.stride = v.value("byteStride", width);
  const std::size_t start = v.value("byteOffset", std::size_t{0}) + a.value("byteOffset", std::size_t{0});
  if (c.count == 0 || c.count > glb.bin.size() || c.stride < width || c.stride > 255 || start > glb.bin.size() ||
      (c.count - 1) * c.stride + width > glb.bin.size() - start)
    throw std::runtime_error("accessor outside of the file");
  c.at = glb.bin.data() + start;
  return c;
}

/// What of the texture the triangles show, as a mask over it.
cv::Mat shown_mask(const Glb& glb, const Json& primitive, cv::Size size) {
  const Column uv = column(glb, primitive.at("attributes").at("TEXCOORD_0").get<std::size_t>(), 2);
  const Column index = column(glb, primitive.at("indices").get<std::size_t>(), 1);
  if (uv.type != 5126 || (index.type != 5125 && index.type != 5123)) throw std::runtime_error("not a plain GLB");
  cv::Mat mask(size, CV_8U, cv::Scalar(0));
  std::array<cv::Point, 3> corners;
  for (std::size_t i = 0; i + 2 < index.count; i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned char* at = index.at + (i + k) * index.stride;
      const std::size_t vertex = index.type == 5125 ? word(at) : at[0] | at[1] << 8;
      if (vertex >= uv.count) throw std::runtime_error("index outside of the mesh");
      float st[2];
      std::memcpy(st, uv.at + vertex * uv.stride, sizeof st);
      for (const float value : st)
        if (!(value >= -1 && value <= 2)) throw std::runtime_error("texture coordinate outside of the texture");
      corners[k] = {static_cast<int>(st[0] * static_cast<float>(size.width)),
                    static_cast<int>(st[1] * static_cast<float>(size.height))};
    }
    cv::fillConvexPoly(mask, corners.data(), 3, cv::Scalar(255));
  }
  return mask;
}

double linear(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double lab_curve(double t) {
  return t > 216.0 / 24389 ? std::cbrt(t) : (t * 24389 / 27 + 16) / 116;
}

}  // namespace

std::optional<VerticalExtent> vertical_extent(const fs::path& file) {
  const auto glb = read_glb(file, false);
  if (!glb) return {};
  VerticalExtent e{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  try {
    for (const Json& mesh : glb->json.at("meshes"))
      for (const Json& primitive : mesh.at("primitives")) {
        const Json& a = glb->json.at("accessors").at(primitive.at("attributes").at("POSITION").get<std::size_t>());
        e.low = std::min(e.low, a.at("min").at(1).get<double>());
        e.high = std::max(e.high, a.at("max").at(1).get<double>());
      }
  } catch (const std::exception&) {
    return {};
  }
  if (!(e.low <= e.high)) return {};
  return e;
}

const char* colour_family(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  const double r = linear(red / 255.0), g = linear(green / 255.0), b = linear(blue / 255.0);
  const double x = lab_curve((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
  const double y = lab_curve(0.2126 * r + 0.7152 * g + 0.0722 * b);
  const double z = lab_curve((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
  const double light = 116 * y - 16, a = 500 * (x - y), bb = 200 * (y - z);
  const double chroma = std::hypot(a, bb);
  double hue = std::atan2(bb, a) * 180 / std::numbers::pi;
  if (hue < 0) hue += 360;
  // A colour is the less seen the darker or lighter it is; nearly grey is called grey by its lightness.
  if (light < 18 && chroma < 16) return "black";
  if (chroma < 8) return light < 25 ? "black" : light > 84 ? "white" : "grey";
  const bool warm = hue > 35 && hue < 105;
  if (warm && chroma < 32 && light > 62) return light > 88 && chroma < 14 ? "white" : "beige";
  if (warm && light < 50 && chroma < 45) return "brown";
  if (hue < 15 || hue >= 345) return light > 55 ? "pink" : "red";
  if (hue < 45) return light > 70 ? "pink" : "red";
  if (hue < 70) return "orange";
  if (hue < 108) return "yellow";
  if (hue < 195) return "green";
  if (hue < 300) return "blue";
  return hue < 330 ? "purple" : light > 55 ? "pink" : "purple";
}

Result<std::vector<std::string>> colour_families(const fs::path& file) {
  const Error bad{Cause::unusable, "NOT_A_GLB", file.string() + " is no GLB with a texture",
                  "run the catalogue again, which writes it anew", "showroom"};
  const auto glb = read_glb(file, true);
  if (!glb) return bad;
  std::vector<std::pair<std::string, int>> counts;
  int total = 0;
  try {
    const Json& primitive = glb->json.at("meshes").at(0).at("primitives").at(0);
    const Json& material = glb->json.at("materials").at(primitive.at("material").get<std::size_t>());
    const Json& base = material.at("pbrMetallicRoughness").at("baseColorTexture");
    const Json& texture = glb->json.at("textures").at(base.at("index").get<std::size_t>());
    const Json& image = glb->json.at("images").at(texture.at("source").get<std::size_t>());
    const Json& view = glb->json.at("bufferViews").at(image.at("bufferView").get<std::size_t>());
    const std::size_t start = view.value("byteOffset", std::size_t{0}),
                      length = view.at("byteLength").get<std::size_t>();
    if (start > glb->bin.size() || length > glb->bin.size() - start) return bad;
    // A quarter of the size is decoded as such, which JPEG can do cheaply.
    const cv::Mat raw(1, static_cast<int>(length), CV_8U, const_cast<unsigned char*>(glb->bin.data() + start));
    cv::Mat atlas = cv::imdecode(raw, cv::IMREAD_REDUCED_COLOR_4);
    if (atlas.empty()) return bad;
    const double shrink = std::min(1.0, static_cast<double>(side) / std::max(atlas.cols, atlas.rows));
    cv::resize(atlas, atlas, {}, shrink, shrink, cv::INTER_AREA);
    const cv::Mat mask = shown_mask(*glb, primitive, atlas.size());
    for (int row = 0; row < atlas.rows; ++row)
      for (int k = 0; k < atlas.cols; ++k) {
        if (mask.at<std::uint8_t>(row, k) == 0) continue;
        const cv::Vec3b& bgr = atlas.at<cv::Vec3b>(row, k);
        const std::string family = colour_family(bgr[2], bgr[1], bgr[0]);
        auto found = std::find_if(counts.begin(), counts.end(), [&](const auto& c) { return c.first == family; });
        if (found == counts.end()) found = counts.insert(counts.end(), {family, 0});
        ++found->second;
        ++total;
      }
  } catch (const std::exception&) {
    return bad;
  }
  if (total == 0) return bad;
  std::sort(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
    return a.second != b.second ? a.second > b.second : a.first < b.first;
  });
  std::vector<std::string> families{counts[0].first};
  if (counts.size() > 1 && 4 * counts[1].second >= total) families.push_back(counts[1].first);
  return families;
}

}  // namespace vitrine::showroom
