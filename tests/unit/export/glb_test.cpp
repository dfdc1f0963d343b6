// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <set>

#include "sample.hpp"

// The same switches as the writer: its tinygltf is linked, this file only reads with it.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

namespace vitrine::test {
namespace {

tinygltf::Model parse(const Bytes& glb) {
  tinygltf::TinyGLTF reader;
  // Pictures stay encoded: no decoder is compiled in.
  reader.SetImageLoader(
      [](tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* data, int size,
         void*) {
        image->image.assign(data, data + size);
        return true;
      },
      nullptr);
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(reader.LoadBinaryFromMemory(&model, &error, &warning, glb.data(), static_cast<unsigned>(glb.size())))
      << error;
  EXPECT_EQ(error + warning, "");
  return model;
}

Bytes encode(const std::vector<RenderMesh>& meshes, const GlbOptions& options = {}) {
  auto glb = encode_glb(meshes, options);
  EXPECT_TRUE(glb) << (glb ? "" : glb.error().message);
  return glb ? *std::move(glb) : Bytes{};
}

TEST(Glb, reads_back_with_the_names_and_counts_it_was_given) {
  const RenderMesh garment = textured_sheet(4), body = plain_sheet("mannequin", 3);
  const tinygltf::Model m = parse(encode({garment, body}, {.copyright = "A shop"}));
  ASSERT_EQ(m.nodes.size(), 2u);
  ASSERT_EQ(m.meshes.size(), 2u);
  EXPECT_EQ(m.asset.version, "2.0");
  EXPECT_EQ(m.asset.generator, "Vitrine");
  EXPECT_EQ(m.asset.copyright, "A shop");
  EXPECT_EQ(m.defaultScene, 0);
  EXPECT_THAT(m.scenes[0].nodes, testing::ElementsAre(0, 1));
  EXPECT_FALSE(m.scenes[0].name.empty());
  EXPECT_TRUE(m.extensionsUsed.empty());
  EXPECT_EQ(m.buffers.size(), 1u);
  for (int i = 0; i < 2; ++i) {
    const RenderMesh& in = i ? body : garment;
    EXPECT_EQ(m.nodes[i].name, in.name);
    EXPECT_EQ(m.meshes[i].name, in.name);
    ASSERT_EQ(m.meshes[i].primitives.size(), 1u);
    const tinygltf::Primitive& p = m.meshes[i].primitives[0];
    EXPECT_EQ(m.accessors[p.attributes.at("POSITION")].count, in.positions.size());
    EXPECT_EQ(m.accessors[p.attributes.at("NORMAL")].count, in.positions.size());
    EXPECT_EQ(m.accessors[p.indices].count, 3 * in.triangles.size());
    EXPECT_EQ(p.attributes.count("TEXCOORD_0"), i ? 0u : 1u);
    EXPECT_TRUE(m.materials[p.material].doubleSided);
    EXPECT_EQ(m.materials[p.material].pbrMetallicRoughness.metallicFactor, 0.0);
    EXPECT_GE(m.materials[p.material].pbrMetallicRoughness.roughnessFactor, 0.8);
  }
  ASSERT_EQ(m.images.size(), 1u);
  EXPECT_EQ(m.images[0].mimeType, "image/jpeg");
  EXPECT_THAT(m.materials[1].pbrMetallicRoughness.baseColorFactor, testing::ElementsAre(0.5, 0.4, 0.3, 1.0));
}

TEST(Glb, states_the_exact_bounds_of_what_it_stores) {
  const RenderMesh garment = textured_sheet(7);
  const tinygltf::Model m = parse(encode({garment}));
  const tinygltf::Accessor& a = m.accessors[m.meshes[0].primitives[0].attributes.at("POSITION")];
  const tinygltf::BufferView& view = m.bufferViews[a.bufferView];
  EXPECT_EQ(view.target, TINYGLTF_TARGET_ARRAY_BUFFER);
  std::vector<float> stored(a.count * 3);
  std::memcpy(stored.data(), m.buffers[0].data.data() + view.byteOffset, stored.size() * sizeof(float));
  for (int c = 0; c < 3; ++c) {
    double low = 1e9, high = -1e9;
    for (std::size_t i = 0; i < a.count; ++i) {
      low = std::min<double>(low, stored[3 * i + c]);
      high = std::max<double>(high, stored[3 * i + c]);
    }
    EXPECT_EQ(a.minValues[c], low);
    EXPECT_EQ(a.maxValues[c], high);
  }
}

/// What viewers get: the corners of every triangle, in the file's order.
std::vector<Vec3> corners(const tinygltf::Model& m, const tinygltf::Primitive& p) {
  const tinygltf::Accessor &a = m.accessors[p.attributes.at("POSITION")], &indices = m.accessors[p.indices];
  const auto& data = m.buffers[0].data;
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < indices.count; ++i) {
    std::uint16_t v = 0;
    std::memcpy(&v, data.data() + m.bufferViews[indices.bufferView].byteOffset + 2 * i, 2);
    float xyz[3];
    std::memcpy(xyz, data.data() + m.bufferViews[a.bufferView].byteOffset + 12 * v, 12);
    out.emplace_back(xyz[0], xyz[1], xyz[2]);
  }
  return out;
}

TEST(Glb, holds_the_same_triangles_the_same_way_round_in_an_order_that_caches_like) {
  RenderMesh sheet = plain_sheet("sheet", 40);
  // Triangles far apart follow each other: every vertex would be fetched anew.
  std::vector<Triangle> scattered;
  for (std::size_t i = 0, at = 0; i < sheet.triangles.size(); ++i, at = (at + 1217) % sheet.triangles.size())
    scattered.push_back(sheet.triangles[at]);
  sheet.triangles = scattered;
  const tinygltf::Model m = parse(encode({sheet}));
  const std::vector<Vec3> stored = corners(m, m.meshes[0].primitives[0]);
  ASSERT_EQ(stored.size(), 3 * sheet.triangles.size());
  const auto key = [](Vec3 a, Vec3 b, Vec3 c) {
    // Which corner comes first does not matter, which way round they go does.
    const auto less = [](const Vec3& p, const Vec3& q) {
      return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
    };
    while (less(b, a) || less(c, a)) {
      const Vec3 first = a;
      a = b;
      b = c;
      c = first;
    }
    std::array<float, 9> k{};
    for (int i = 0; i < 3; ++i) {
      k[i] = static_cast<float>(a[i]);
      k[3 + i] = static_cast<float>(b[i]);
      k[6 + i] = static_cast<float>(c[i]);
    }
    return k;
  };
  std::multiset<std::array<float, 9>> wanted, found;
  const auto single = [](const Vec3& p) { return Vec3(p.cast<float>().cast<double>()); };
  for (const Triangle& t : sheet.triangles)
    wanted.insert(key(single(sheet.positions[t[0]]), single(sheet.positions[t[1]]), single(sheet.positions[t[2]])));
  std::vector<Vec3> cache;
  int misses = 0;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    if (i % 3 == 0) found.insert(key(stored[i], stored[i + 1], stored[i + 2]));
    if (std::find(cache.begin(), cache.end(), stored[i]) != cache.end()) continue;
    ++misses;
    cache.push_back(stored[i]);
    if (cache.size() > 16) cache.erase(cache.begin());
  }
  EXPECT_EQ(found, wanted);
  EXPECT_LT(misses, 0.9 * static_cast<double>(sheet.triangles.size()));
}

TEST(Glb, lowers_the_jpeg_quality_only_as_far_as_the_budget_asks) {
  RenderMesh mesh = textured_sheet(3);
  mesh.texture = Image(256, 256, 3);
  for (std::size_t i = 0; i < mesh.texture.data.size(); ++i)
    mesh.texture.data[i] = static_cast<std::uint8_t>((i * 2654435761u) >> 13);
  const std::size_t free = encode({mesh}).size();
  const std::size_t tight = encode({mesh}, {.texture_bytes = 45'000}).size();
  const std::size_t none = encode({mesh}, {.lowest_quality = 80, .texture_bytes = 1}).size();
  EXPECT_LT(tight, free);
  EXPECT_LE(none, tight);
  EXPECT_EQ(none, encode({mesh}, {.jpeg_quality = 80, .lowest_quality = 80}).size());
  EXPECT_FALSE(encode_glb(std::span(&mesh, 1), {.jpeg_quality = 50, .lowest_quality = 80}));
}

TEST(Glb, keeps_occlusion_in_the_one_material_and_shade_in_the_vertices) {
  RenderMesh garment = textured_sheet(4), body = plain_sheet("mannequin", 3);
  garment.occlusion = Image(16, 16, 1, 200);
  body.shade.assign(body.positions.size(), 0.5F);
  const tinygltf::Model m = parse(encode({garment, body}));
  ASSERT_EQ(m.materials.size(), 2u);
  EXPECT_EQ(m.images.size(), 2u);
  EXPECT_EQ(m.images[m.textures[m.materials[0].occlusionTexture.index].source].name, "garment_occlusion");
  EXPECT_EQ(m.materials[0].occlusionTexture.texCoord, 0);
  const tinygltf::Accessor& a = m.accessors[m.meshes[1].primitives[0].attributes.at("COLOR_0")];
  EXPECT_TRUE(a.normalized);
  EXPECT_EQ(a.count, body.positions.size());
  EXPECT_EQ(m.buffers[0].data[m.bufferViews[a.bufferView].byteOffset], 128);
  EXPECT_EQ(m.meshes[0].primitives[0].attributes.count("COLOR_0"), 0u);
}

TEST(Glb, uses_16_bit_indices_as_long_as_they_fit) {
  // 255 x 257 = 65,535 vertices, and one row more.
  for (const bool large : {false, true}) {
    const RenderMesh sheet = plain_sheet("sheet", 254, large ? 257 : 256);
    const tinygltf::Model m = parse(encode({sheet}));
    const tinygltf::Accessor& a = m.accessors[m.meshes[0].primitives[0].indices];
    EXPECT_EQ(a.componentType, large ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    EXPECT_EQ(m.bufferViews[a.bufferView].target, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    for (const auto& view : m.bufferViews) EXPECT_EQ(view.byteOffset % 4, 0u);
  }
}

TEST(Glb, carries_extras_as_they_were_written) {
  const tinygltf::Model m =
      parse(encode({textured_sheet(2)}, {.extras_json = R"({"sku":"12-A","n":[1,2.5],"ok":true,"big":5000000000})"}));
  EXPECT_EQ(m.asset.extras.Get("sku").Get<std::string>(), "12-A");
  EXPECT_EQ(m.asset.extras.Get("n").Get(1).GetNumberAsDouble(), 2.5);
  EXPECT_TRUE(m.asset.extras.Get("ok").Get<bool>());
  EXPECT_EQ(m.asset.extras.Get("big").GetNumberAsDouble(), 5e9);
}

TEST(Glb, is_the_same_bytes_twice) {
  const std::vector<RenderMesh> meshes{textured_sheet(9), plain_sheet("mannequin", 5)};
  EXPECT_EQ(encode(meshes), encode(meshes));
}

TEST(Glb, is_the_same_bytes_with_pictures_that_were_encoded_before) {
  const std::vector<RenderMesh> both{textured_sheet(4), plain_sheet("mannequin", 3)};
  const auto pictures = encode_pictures(both);
  ASSERT_TRUE(pictures);
  ASSERT_EQ(pictures->size(), 2u);
  const auto dressed = encode_glb(both, *pictures, {}), garment = encode_glb(std::span(both).first(1), *pictures, {});
  ASSERT_TRUE(dressed && garment);
  EXPECT_EQ(*dressed, encode(both));
  EXPECT_EQ(*garment, encode({both[0]}));
  EXPECT_FALSE(encode_glb(both, std::span(*pictures).first(1), {}));
}

TEST(Glb, refuses_what_no_viewer_could_show) {
  const auto refused = [](RenderMesh mesh) {
    const auto glb = encode_glb(std::span(&mesh, 1));
    return !glb && glb.error().cause == Cause::internal;
  };
  EXPECT_FALSE(refused(textured_sheet(2)));
  RenderMesh m = textured_sheet(2);
  m.positions[1].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused(m));
  m = textured_sheet(2);
  m.normals[1] *= 2;
  EXPECT_TRUE(refused(m));
  m = textured_sheet(2);
  m.triangles[0][2] = 1000;
  EXPECT_TRUE(refused(m));
  m = textured_sheet(2);
  m.uv.pop_back();
  EXPECT_TRUE(refused(m));
  m = textured_sheet(2);
  m.triangles.clear();
  EXPECT_TRUE(refused(m));
  m = textured_sheet(2);
  m.texture.data.pop_back();
  EXPECT_TRUE(refused(m));
  EXPECT_FALSE(encode_glb({}));
  m = textured_sheet(2);
  EXPECT_FALSE(encode_glb(std::span(&m, 1), {.extras_json = "{broken"}));
}

}  // namespace
}  // namespace vitrine::test
