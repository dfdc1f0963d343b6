// SPDX-License-Identifier: GPL-3.0-or-later
#include <meshoptimizer.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "vitrine/export.hpp"

namespace vitrine {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t kMagic = 0x46546c67, kJson = 0x4e4f534a, kBinary = 0x004e4942;
constexpr int kBits = 15;  // of a coordinate, beside the exponent that a vertex' coordinates share
const char* const kExtension = "EXT_meshopt_compression";

Error not_a_glb(const std::string& what) {
  return {Cause::unusable, "NOT_A_GLB", "The file to compress is no binary glTF: " + what + ".",
          "Compress a file that this program wrote.", "export"};
}

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint32_t v = 0;
  std::memcpy(&v, bytes.data() + at, sizeof v);
  return v;
}

void add_word(Bytes& bytes, std::uint32_t v) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(&v);
  bytes.insert(bytes.end(), first, first + sizeof v);
}

/// How an accessor's view is stored: what meshoptimizer has to know of it.
struct Use {
  std::size_t count = 0, stride = 0;
  bool indices = false, floats = false;
};

/// Reads accessors and primitives; a view that two accessors share is left as it is.
std::vector<Use> uses_of(const Json& gltf, std::size_t views) {
  std::vector<Use> uses(views);
  std::vector<int> users(views, 0);
  const Json& accessors = gltf.at("accessors");
  for (const Json& a : accessors) {
    const std::size_t view = a.at("bufferView").get<std::size_t>();
    const std::string type = a.at("type").get<std::string>();
    const int component = a.at("componentType").get<int>();
    const std::size_t size = component == 5126 || component == 5125   ? 4
                             : component == 5123 || component == 5122 ? 2
                                                                      : 1;
    const std::size_t parts = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : 4;
    ++users.at(view);
    uses[view] = {a.at("count").get<std::size_t>(), size * parts, false, component == 5126};
  }
  for (const Json& mesh : gltf.at("meshes"))
    for (const Json& p : mesh.at("primitives"))
      uses.at(accessors.at(p.at("indices").get<std::size_t>()).at("bufferView").get<std::size_t>()).indices = true;
  for (std::size_t i = 0; i < views; ++i)
    if (users[i] != 1) uses[i].count = 0;
  return uses;
}

Bytes encode(std::span<const std::uint8_t> raw, const Use& use, Json& extension) {
  Bytes out;
  if (use.indices) {
    extension["mode"] = "TRIANGLES";
    std::vector<unsigned> indices(use.count);
    for (std::size_t i = 0; i < use.count; ++i)
      indices[i] = use.stride == 2 ? static_cast<unsigned>(raw[2 * i] | raw[2 * i + 1] << 8) : word(raw, 4 * i);
    out.resize(meshopt_encodeIndexBufferBound(use.count,
                                              use.count ? *std::max_element(indices.begin(), indices.end()) + 1 : 0));
    out.resize(meshopt_encodeIndexBuffer(out.data(), out.size(), indices.data(), indices.size()));
    return out;
  }
  extension["mode"] = "ATTRIBUTES";
  Bytes filtered(raw.begin(), raw.end());
  if (use.floats) {
    extension["filter"] = "EXPONENTIAL";
    std::vector<float> values(raw.size() / sizeof(float));
    std::memcpy(values.data(), raw.data(), values.size() * sizeof(float));
    meshopt_encodeFilterExp(filtered.data(), use.count, use.stride, kBits, values.data());
  }
  out.resize(meshopt_encodeVertexBufferBound(use.count, use.stride));
  out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), filtered.data(), use.count, use.stride));
  return out;
}

void pad(Bytes& bytes, std::uint8_t with) {
  bytes.resize((bytes.size() + 3) / 4 * 4, with);
}

}  // namespace

Result<Bytes> compress_glb(std::span<const std::uint8_t> glb) {
  if (glb.size() < 28 || word(glb, 0) != kMagic || word(glb, 4) != 2 || word(glb, 8) != glb.size())
    return not_a_glb("its header is wrong");
  const std::size_t json_size = word(glb, 12);
  if (word(glb, 16) != kJson || json_size > glb.size() - 28) return not_a_glb("it has no JSON chunk");
  const std::size_t binary = 20 + json_size;
  if (word(glb, binary + 4) != kBinary || word(glb, binary) > glb.size() - binary - 8)
    return not_a_glb("it has no binary chunk");
  const auto data = glb.subspan(binary + 8, word(glb, binary));
  try {
    Json gltf = Json::parse(glb.begin() + 20, glb.begin() + 20 + static_cast<std::ptrdiff_t>(json_size));
    Json& views = gltf.at("bufferViews");
    const std::vector<Use> uses = uses_of(gltf, views.size());
    meshopt_encodeVertexVersion(0);  // what the extension names
    meshopt_encodeIndexVersion(1);
    Bytes packed;
    std::size_t unpacked = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
      Json& view = views[i];
      const std::size_t offset = view.value("byteOffset", std::size_t{0}), size = view.at("byteLength");
      if (offset > data.size() || size > data.size() - offset) return not_a_glb("a view lies outside its buffer");
      const auto raw = data.subspan(offset, size);
      const Use& use = uses[i];
      const std::size_t at = packed.size();
      // Attributes are stored four bytes at a time.
      if (use.count > 0 && use.count * use.stride == size && (use.indices || use.stride % 4 == 0)) {
        Json extension{{"buffer", 0}, {"byteOffset", at}};
        const Bytes bytes = encode(raw, use, extension);
        extension["byteLength"] = bytes.size();
        extension["byteStride"] = use.stride;
        extension["count"] = use.count;
        packed.insert(packed.end(), bytes.begin(), bytes.end());
        view["buffer"] = 1;
        view["byteOffset"] = unpacked;
        if (!use.indices) view["byteStride"] = use.stride;
        view["extensions"][kExtension] = std::move(extension);
        unpacked += (size + 3) / 4 * 4;
      } else {
        packed.insert(packed.end(), raw.begin(), raw.end());
        view["byteOffset"] = at;
      }
      pad(packed, 0);
    }
    if (unpacked > 0) {
      Json fallback{{"byteLength", unpacked}};
      fallback["extensions"][kExtension] = {{"fallback", true}};
      gltf["buffers"] = Json::array({Json{{"byteLength", packed.size()}}, std::move(fallback)});
      for (const char* list : {"extensionsUsed", "extensionsRequired"}) gltf[list].push_back(kExtension);
    }
    const std::string text = gltf.dump();
    Bytes json(text.begin(), text.end());
    pad(json, ' ');
    Bytes out;
    add_word(out, kMagic);
    add_word(out, 2);
    add_word(out, static_cast<std::uint32_t>(28 + json.size() + packed.size()));
    add_word(out, static_cast<std::uint32_t>(json.size()));
    add_word(out, kJson);
    out.insert(out.end(), json.begin(), json.end());
    add_word(out, static_cast<std::uint32_t>(packed.size()));
    add_word(out, kBinary);
    out.insert(out.end(), packed.begin(), packed.end());
    return out;
  } catch (const std::exception& e) {
    return not_a_glb(e.what());
  }
}

}  // namespace vitrine
