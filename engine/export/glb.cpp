// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "check.hpp"
#include "gltf.hpp"
#include "order.hpp"
#include "vitrine/export.hpp"

namespace vitrine {
namespace {

static_assert(std::endian::native == std::endian::little,
              "glTF is little endian; this writer copies bytes as they are");

// Matte cloth and matte plaster; shops' viewers turn anything smoother into plastic under their lamps.
constexpr double kRoughness = 0.9;
// Indices above this are reserved for primitive restart.
constexpr std::size_t kLargest16 = 65'535;

Error failed(const std::string& message) {
  return {Cause::internal, "GLB_FAILED", message, "Report this with the photos that caused it.", "export"};
}

/// Fills the one buffer of the file.
class Builder {
 public:
  tinygltf::Model model;

  Builder() { model.buffers.emplace_back(); }

  int view(const void* data, std::size_t size, int target) {
    std::vector<unsigned char>& bytes = model.buffers[0].data;
    bytes.resize((bytes.size() + 3) / 4 * 4, 0);  // accessors start on a multiple of their component's size
    tinygltf::BufferView v;
    v.buffer = 0;
    v.byteOffset = bytes.size();
    v.byteLength = size;
    v.target = target;
    const auto* first = static_cast<const unsigned char*>(data);
    bytes.insert(bytes.end(), first, first + size);
    model.bufferViews.push_back(v);
    return static_cast<int>(model.bufferViews.size()) - 1;
  }

  /// 32-bit floats, N to an element; `bounds` as the format asks for positions.
  template <class V>
  int floats(const std::vector<V>& values, int type, bool bounds) {
    constexpr int n = V::RowsAtCompileTime;
    std::vector<float> flat;
    flat.reserve(values.size() * n);
    std::vector<double> low(n, std::numeric_limits<double>::infinity()), high(n, -low[0]);
    for (const V& v : values)
      for (int i = 0; i < n; ++i) {
        flat.push_back(static_cast<float>(v[i]));
        low[i] = std::min(low[i], static_cast<double>(flat.back()));
        high[i] = std::max(high[i], static_cast<double>(flat.back()));
      }
    tinygltf::Accessor a;
    a.bufferView = view(flat.data(), flat.size() * sizeof(float), TINYGLTF_TARGET_ARRAY_BUFFER);
    a.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
    a.count = values.size();
    a.type = type;
    if (bounds) {
      a.minValues = low;
      a.maxValues = high;
    }
    return add(a);
  }

  /// Grey per vertex as COLOR_0: 8-bit RGBA, as each element has to fill four bytes.
  int greys(const std::vector<float>& values) {
    std::vector<std::uint8_t> flat;
    flat.reserve(4 * values.size());
    for (const float v : values) {
      const auto grey = static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(v, 0.0F, 1.0F)));
      flat.insert(flat.end(), {grey, grey, grey, std::uint8_t{255}});
    }
    tinygltf::Accessor a;
    a.bufferView = view(flat.data(), flat.size(), TINYGLTF_TARGET_ARRAY_BUFFER);
    a.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    a.normalized = true;
    a.count = values.size();
    a.type = TINYGLTF_TYPE_VEC4;
    return add(a);
  }

  template <class Index>
  int indices(const std::vector<Triangle>& triangles, int component) {
    std::vector<Index> flat;
    flat.reserve(triangles.size() * 3);
    for (const Triangle& t : triangles)
      for (std::uint32_t v : t) flat.push_back(static_cast<Index>(v));
    tinygltf::Accessor a;
    a.bufferView = view(flat.data(), flat.size() * sizeof(Index), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    a.componentType = component;
    a.count = flat.size();
    a.type = TINYGLTF_TYPE_SCALAR;
    return add(a);
  }

  int texture(const Bytes& jpeg, const std::string& name) {
    tinygltf::Image image;
    image.name = name;
    image.mimeType = "image/jpeg";
    image.bufferView = view(jpeg.data(), jpeg.size(), 0);
    model.images.push_back(image);
    if (model.samplers.empty()) {
      tinygltf::Sampler s;
      s.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
      s.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
      // The two panels are neighbours in the atlas: repeating would let one bleed into the other.
      s.wrapS = s.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
      model.samplers.push_back(s);
    }
    tinygltf::Texture t;
    t.sampler = 0;
    t.source = static_cast<int>(model.images.size()) - 1;
    model.textures.push_back(t);
    return static_cast<int>(model.textures.size()) - 1;
  }

 private:
  int add(const tinygltf::Accessor& a) {
    model.accessors.push_back(a);
    return static_cast<int>(model.accessors.size()) - 1;
  }
};

tinygltf::Value to_value(const nlohmann::json& j) {
  using tinygltf::Value;
  if (j.is_boolean()) return Value(j.get<bool>());
  // tinygltf's integers are 32 bits wide; a double keeps every whole number up to 2^53.
  if (j.is_number_integer() && j.get<double>() >= -2147483648.0 && j.get<double>() <= 2147483647.0)
    return Value(j.get<int>());
  if (j.is_number()) return Value(j.get<double>());
  if (j.is_string()) return Value(j.get<std::string>());
  if (j.is_array()) {
    Value::Array items;
    for (const auto& item : j) items.push_back(to_value(item));
    return Value(std::move(items));
  }
  if (j.is_object()) {
    Value::Object members;
    for (const auto& [key, item] : j.items()) members.emplace(key, to_value(item));
    return Value(std::move(members));
  }
  return {};
}

void add_mesh(Builder& b, const RenderMesh& whole, const GlbPictures& pictures) {
  const RenderMesh mesh = ordered_for_caches(whole);
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = b.floats(mesh.positions, TINYGLTF_TYPE_VEC3, true);
  primitive.attributes["NORMAL"] = b.floats(mesh.normals, TINYGLTF_TYPE_VEC3, false);
  if (!pictures.colour.empty()) primitive.attributes["TEXCOORD_0"] = b.floats(mesh.uv, TINYGLTF_TYPE_VEC2, false);
  if (!mesh.shade.empty()) primitive.attributes["COLOR_0"] = b.greys(mesh.shade);
  primitive.indices = mesh.positions.size() <= kLargest16
                          ? b.indices<std::uint16_t>(mesh.triangles, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
                          : b.indices<std::uint32_t>(mesh.triangles, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);

  tinygltf::Material material;
  material.name = mesh.name + "_material";
  material.doubleSided = true;  // cloth is seen from inside at necks and hems
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  material.pbrMetallicRoughness.roughnessFactor = kRoughness;
  if (pictures.colour.empty())
    material.pbrMetallicRoughness.baseColorFactor = {mesh.colour[0], mesh.colour[1], mesh.colour[2], 1.0};
  else
    material.pbrMetallicRoughness.baseColorTexture.index = b.texture(pictures.colour, mesh.name + "_texture");
  if (!pictures.colour.empty() && !pictures.occlusion.empty())
    material.occlusionTexture.index = b.texture(pictures.occlusion, mesh.name + "_occlusion");
  b.model.materials.push_back(material);
  primitive.material = static_cast<int>(b.model.materials.size()) - 1;

  tinygltf::Mesh m;
  m.name = mesh.name;
  m.primitives.push_back(primitive);
  b.model.meshes.push_back(m);
  tinygltf::Node node;
  node.name = mesh.name;
  node.mesh = static_cast<int>(b.model.meshes.size()) - 1;
  b.model.nodes.push_back(node);
}

}  // namespace

Result<std::vector<GlbPictures>> encode_pictures(std::span<const RenderMesh> meshes, const GlbOptions& options) {
  if (options.lowest_quality < 1 || options.lowest_quality > options.jpeg_quality || options.jpeg_quality > 100 ||
      options.quality_step < 1)
    return Error{Cause::usage, "BAD_QUALITY", "The JPEG qualities of a GLB are out of range.",
                 "Use 1 to 100, the lowest not above the highest.", "export"};
  for (int quality = options.jpeg_quality;;
       quality = std::max(options.lowest_quality, quality - options.quality_step)) {
    std::vector<GlbPictures> pictures;
    std::size_t bytes = 0;
    for (const RenderMesh& mesh : meshes) {
      GlbPictures p;
      if (!mesh.texture.empty()) {
        auto jpeg = encode_jpeg(mesh.texture, quality);
        if (!jpeg) return jpeg.error();
        p.colour = *std::move(jpeg);
      }
      if (!mesh.occlusion.empty()) {
        auto jpeg = encode_jpeg(mesh.occlusion, quality);
        if (!jpeg) return jpeg.error();
        p.occlusion = *std::move(jpeg);
      }
      bytes += p.colour.size() + p.occlusion.size();
      pictures.push_back(std::move(p));
    }
    if (bytes <= options.texture_bytes || quality <= options.lowest_quality) return pictures;
  }
}

Result<Bytes> encode_glb(std::span<const RenderMesh> meshes, const GlbOptions& options) {
  if (auto error = check_meshes(meshes)) return *error;
  const auto pictures = encode_pictures(meshes, options);
  if (!pictures) return pictures.error();
  return encode_glb(meshes, *pictures, options);
}

Result<Bytes> encode_glb(std::span<const RenderMesh> meshes, std::span<const GlbPictures> pictures,
                         const GlbOptions& options) {
  if (auto error = check_meshes(meshes)) return *error;
  if (pictures.size() < meshes.size()) return failed("Meshes of a GLB are without their pictures.");
  try {
    Builder b;
    b.model.asset.version = "2.0";
    b.model.asset.generator = options.generator;
    b.model.asset.copyright = options.copyright;
    if (!options.extras_json.empty()) {
      const auto extras = nlohmann::json::parse(options.extras_json, nullptr, false);
      if (!extras.is_object()) return failed("The extras of a GLB are not a JSON object.");
      b.model.asset.extras = to_value(extras);
    }
    tinygltf::Scene scene;
    scene.name = "scene";
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      add_mesh(b, meshes[i], pictures[i]);
      scene.nodes.push_back(static_cast<int>(b.model.nodes.size()) - 1);
    }
    b.model.scenes.push_back(scene);
    b.model.defaultScene = 0;
    // A GLB counts its bytes in 32 bits.
    if (b.model.buffers[0].data.size() > 0xf000'0000u) return failed("The garment is too large for a GLB.");
    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&b.model, stream, false, true)) return failed("tinygltf refused the garment.");
    const std::string text = std::move(stream).str();
    return Bytes(text.begin(), text.end());
  } catch (const std::exception& e) {
    return failed(std::string("The GLB could not be made: ") + e.what());
  }
}

}  // namespace vitrine
