// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/commerce.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "commerce_uv.hpp"
#include "gltf.hpp"

namespace vitrine {

struct CommerceMemory::Held {
  struct Charts {
    std::vector<Vec2> uv;
    std::vector<Triangle> triangles;
    std::shared_ptr<const Image> texture;
    UvFigures figures;
  };
  struct Picture {
    std::vector<unsigned char> encoded;
    std::shared_ptr<const Image> decoded;
  };
  std::vector<Picture> pictures;
  std::vector<Charts> charts;
};

CommerceMemory::CommerceMemory() : held_(std::make_shared<Held>()) {}

namespace {

using Memory = CommerceMemory::Held;

constexpr double kMegabyte = 1024.0 * 1024.0;
const char* const kAll = "khronos, shopify, google, apple";

std::string number(double v, int digits = 0) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, v);
  return text;
}

/// A mesh as it stands in the file.
struct Part {
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> uv;
  std::vector<Triangle> triangles;
  std::shared_ptr<const Image> texture;
};

template <class V>
bool read_floats(const tinygltf::Model& m, const tinygltf::Primitive& p, const char* name, std::vector<V>& out) {
  const auto found = p.attributes.find(name);
  if (found == p.attributes.end()) return false;
  const tinygltf::Accessor& a = m.accessors.at(found->second);
  const tinygltf::BufferView& view = m.bufferViews.at(a.bufferView);
  const auto& bytes = m.buffers.at(view.buffer).data;
  constexpr std::size_t n = V::RowsAtCompileTime;
  const int stride = a.ByteStride(view);
  if (a.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || stride <= 0 || a.count == 0) return false;
  const std::size_t first = view.byteOffset + a.byteOffset;
  if (first + (a.count - 1) * static_cast<std::size_t>(stride) + n * sizeof(float) > bytes.size()) return false;
  for (std::size_t i = 0; i < a.count; ++i) {
    float v[n];
    std::memcpy(v, bytes.data() + first + i * static_cast<std::size_t>(stride), sizeof v);
    V value;
    for (std::size_t k = 0; k < n; ++k) value[static_cast<Eigen::Index>(k)] = v[k];
    out.push_back(value);
  }
  return true;
}

bool read_triangles(const tinygltf::Model& m, const tinygltf::Primitive& p, std::size_t vertices,
                    std::vector<Triangle>& out) {
  if (p.indices < 0 || p.mode != TINYGLTF_MODE_TRIANGLES) return false;
  const tinygltf::Accessor& a = m.accessors.at(p.indices);
  const tinygltf::BufferView& view = m.bufferViews.at(a.bufferView);
  const auto& bytes = m.buffers.at(view.buffer).data;
  const std::size_t size = a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT     ? 4
                           : a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2
                                                                                       : 1;
  const std::size_t first = view.byteOffset + a.byteOffset;
  if (first + a.count * size > bytes.size()) return false;
  Triangle t{};
  for (std::size_t i = 0; i < a.count; ++i) {
    std::uint32_t v = 0;
    std::memcpy(&v, bytes.data() + first + i * size, size);
    if (v >= vertices) return false;
    t[i % 3] = v;
    if (i % 3 == 2) out.push_back(t);
  }
  return true;
}

Image decode(const tinygltf::Image& image) {
  if (image.image.empty()) return {};
  const cv::Mat bgr = cv::imdecode(image.image, cv::IMREAD_COLOR);
  if (bgr.empty()) return {};
  Image out(bgr.cols, bgr.rows, 3);
  cv::Mat rgb(bgr.size(), CV_8UC3, out.data.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return out;
}

std::shared_ptr<const Image> decode(const tinygltf::Image& image, Memory& memory) {
  for (const Memory::Picture& known : memory.pictures)
    if (known.encoded == image.image) return known.decoded;
  memory.pictures.push_back({image.image, std::make_shared<const Image>(decode(image))});
  return memory.pictures.back().decoded;
}

const UvFigures& measure(Part& part, Memory& memory) {
  for (const Memory::Charts& known : memory.charts)
    if (known.texture == part.texture && known.uv == part.uv && known.triangles == part.triangles) return known.figures;
  const UvFigures figures = measure_uv(part.uv, part.triangles, *part.texture);
  memory.charts.push_back({std::move(part.uv), std::move(part.triangles), part.texture, figures});
  return memory.charts.back().figures;
}

bool good_name(const std::string& name) {
  if (name.empty() || name[0] < 'a' || name[0] > 'z') return false;
  return std::all_of(name.begin(), name.end(),
                     [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-'; });
}

class Findings {
 public:
  std::vector<CommerceFinding> list;
  void add(const char* rule, std::string value, const char* limit, const char* sources, Verdict verdict) {
    list.push_back({rule, std::move(value), limit, sources, verdict});
  }
  /// Fails above `hard`, warns above `soft`.
  void at_most(const char* rule, double value, double soft, double hard, const char* limit, const char* sources,
               int digits = 0) {
    add(rule, number(value, digits), limit, sources,
        value > hard   ? Verdict::fail
        : value > soft ? Verdict::warn
                       : Verdict::pass);
  }
  void holds(const char* rule, bool good, std::string value, const char* limit, const char* sources,
             Verdict otherwise = Verdict::fail) {
    add(rule, std::move(value), limit, sources, good ? Verdict::pass : otherwise);
  }
};

void check_names(const tinygltf::Model& m, Findings& f) {
  std::string bad;
  const auto look = [&](const auto& items) {
    for (const auto& item : items)
      if (!good_name(item.name)) bad += (bad.empty() ? "" : ", ") + ("\"" + item.name + "\"");
  };
  look(m.nodes);
  look(m.meshes);
  look(m.materials);
  look(m.images);
  f.holds("names", bad.empty(), bad.empty() ? "all good" : bad, "[a-z][a-z0-9_-]*", "khronos");
}

void check_textures(const tinygltf::Model& m, const std::vector<std::shared_ptr<const Image>>& pictures, Findings& f) {
  if (pictures.empty()) return;
  int largest = 0, smallest = 1 << 30;
  bool power = true, jpeg = true;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const int w = pictures[i]->width, h = pictures[i]->height;
    largest = std::max({largest, w, h});
    power = power && w > 0 && h > 0 && std::has_single_bit(static_cast<unsigned>(w)) &&
            std::has_single_bit(static_cast<unsigned>(h));
    jpeg = jpeg && m.images[i].mimeType == "image/jpeg";
  }
  // The smallest side asked for is that of colours; occlusion has no detail to lose.
  for (const tinygltf::Material& material : m.materials) {
    const int texture = material.pbrMetallicRoughness.baseColorTexture.index;
    if (texture < 0) continue;
    const Image& p = *pictures.at(m.textures.at(texture).source);
    smallest = std::min({smallest, p.width, p.height});
  }
  f.at_most("texture_side_px", largest, 2048, 4096, "2048 (4096 at most)", kAll);
  f.holds("texture_smallest_side_px", smallest >= 512, number(smallest), "512 of a base colour", "khronos",
          Verdict::warn);
  f.holds("texture_power_of_two", power, power ? "yes" : "no", "yes", "khronos");
  f.holds("texture_format", jpeg, jpeg ? "jpeg" : "other", "jpeg", "khronos, shopify", Verdict::warn);
}

/// Takes the parts' charts with it.
void check_uvs(std::vector<Part>& parts, Memory& memory, Findings& f) {
  for (Part& part : parts) {
    if (!part.texture) continue;
    const UvFigures u = measure(part, memory);
    f.holds("uv_range", u.low >= 0 && u.high <= 1, number(u.low, 3) + " to " + number(u.high, 3), "0 to 1", "khronos");
    f.at_most("uv_overlap_share", u.overlap_share, 0, 0, "0", "khronos, shopify", 4);
    f.at_most("uv_inverted_triangles", u.inverted, 0, 0, "0", "khronos");
    const int wanted =
        static_cast<int>(std::lround(8.0 * std::max(part.texture->width, part.texture->height) / 1024.0));
    f.holds("uv_gutter_px", u.gutter >= wanted, number(u.gutter), "8 at 1024", "khronos", Verdict::warn);
    // White or black cloth breaks this by nature.
    f.holds("colour_bright_share", u.bright_share <= 0.01, number(u.bright_share, 4), "0.01 above 243", "khronos",
            Verdict::warn);
    f.holds("colour_dark_share", u.dark_share <= 0.01, number(u.dark_share, 4), "0.01 below 30", "khronos",
            Verdict::warn);
  }
}

void check_shape(const tinygltf::Model& m, const std::vector<Part>& parts, const CommerceScale& scale, Findings& f) {
  double worst = 0;
  Vec3 low = Vec3::Constant(1e30), high = Vec3::Constant(-1e30);
  for (const Part& part : parts) {
    for (const Vec3& n : part.normals) worst = std::max(worst, std::abs(n.norm() - 1.0));
    for (const Vec3& p : part.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  f.at_most("normal_length_error", worst, 1e-3, 1e-2, "0.001", "gltf", 5);
  bool plain = true;
  for (const tinygltf::Node& node : m.nodes)
    plain = plain && node.translation.empty() && node.rotation.empty() && node.scale.empty() && node.matrix.empty();
  f.holds("root_transform", plain, plain ? "none" : "some", "none", "khronos");
  const Vec3 size = high - low;
  f.holds("size_m", size.maxCoeff() > 0.05 && size.maxCoeff() < 3.0,
          number(size.x(), 3) + " x " + number(size.y(), 3) + " x " + number(size.z(), 3), "metres, real size", kAll);
  if ((scale.high - scale.low).maxCoeff() <= 0) return;
  const Vec3 body = scale.high - scale.low;
  // Clothes hang around the body: not above its head, hardly below its soles, in depth and width about as large.
  const bool within = low.y() > scale.low.y() - 0.05 && high.y() < scale.high.y() + 0.05 && size.x() < 1.6 * body.x() &&
                      size.z() < 3.0 * body.z() + 0.5;
  f.holds("scale_to_mannequin", within, number(size.y() / body.y(), 3) + " of its height",
          "within the mannequin's reach", "khronos, google");
  const Vec3 middle = 0.5 * (scale.low + scale.high);
  const bool origin = std::abs(scale.low.y()) < 0.005 && std::abs(middle.x()) < 0.02 && std::abs(middle.z()) < 0.15;
  f.holds("origin", origin, number(middle.x(), 3) + ", " + number(scale.low.y(), 3) + ", " + number(middle.z(), 3),
          "bottom centre of the mannequin", "khronos", Verdict::warn);
}

}  // namespace

Result<std::vector<CommerceFinding>> check_commerce(std::span<const std::uint8_t> glb, const CommerceScale& scale,
                                                    CommerceMemory* memory) {
  const auto broken = [](const std::string& what) {
    return Error{Cause::unusable, "NOT_A_GLB", "The GLB cannot be checked: " + what + ".",
                 "Check a file that this program wrote, without --compress.", "export"};
  };
  try {
    tinygltf::TinyGLTF reader;
    // Pictures stay encoded here: tinygltf gets no decoder.
    reader.SetImageLoader(
        [](tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* data, int size,
           void*) {
          image->image.assign(data, data + size);
          return true;
        },
        nullptr);
    tinygltf::Model m;
    std::string error, warning;
    if (!reader.LoadBinaryFromMemory(&m, &error, &warning, glb.data(), static_cast<unsigned>(glb.size())))
      return broken(error.empty() ? "it does not parse" : error);
    CommerceMemory own;
    Memory& known = (memory != nullptr ? *memory : own).held();
    std::vector<std::shared_ptr<const Image>> pictures;
    for (const tinygltf::Image& image : m.images) {
      pictures.push_back(decode(image, known));
      if (pictures.back()->empty()) return broken("a picture in it cannot be decoded");
    }
    std::vector<Part> parts;
    std::size_t triangles = 0;
    for (const tinygltf::Mesh& mesh : m.meshes)
      for (const tinygltf::Primitive& p : mesh.primitives) {
        Part part;
        if (!read_floats(m, p, "POSITION", part.positions) ||
            !read_triangles(m, p, part.positions.size(), part.triangles))
          return broken("a mesh in it is not whole");
        read_floats(m, p, "NORMAL", part.normals);
        read_floats(m, p, "TEXCOORD_0", part.uv);
        if (p.material >= 0) {
          const int texture = m.materials.at(p.material).pbrMetallicRoughness.baseColorTexture.index;
          if (texture >= 0 && part.uv.size() == part.positions.size())
            part.texture = pictures.at(m.textures.at(texture).source);
        }
        triangles += part.triangles.size();
        parts.push_back(std::move(part));
      }
    Findings f;
    f.at_most("file_size_mb", static_cast<double>(glb.size()) / kMegabyte, 3, 5, "3 (5 at most)", kAll, 3);
    f.at_most("triangles", static_cast<double>(triangles), 100'000, 150'000, "100000", kAll);
    f.at_most("materials", static_cast<double>(m.materials.size()), 2, 5, "1, and 1 for a mannequin (5 at most)",
              "khronos, shopify");
    f.at_most("nodes", static_cast<double>(m.nodes.size()), 5, 20, "5", "khronos");
    check_textures(m, pictures, f);
    check_uvs(parts, known, f);
    check_names(m, f);
    check_shape(m, parts, scale, f);
    return f.list;
  } catch (const std::exception& e) {
    return broken(e.what());
  }
}

}  // namespace vitrine
