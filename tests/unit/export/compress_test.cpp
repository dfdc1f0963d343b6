// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>

#include "sample.hpp"

namespace vitrine::test {
namespace {

struct Parsed {
  nlohmann::json json;
  Bytes data;
};

Parsed parse(const Bytes& glb) {
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, 4);
  return {nlohmann::json::parse(glb.begin() + 20, glb.begin() + 20 + size), Bytes(glb.begin() + 28 + size, glb.end())};
}

/// A view's bytes as a viewer with the decoder sees them.
Bytes unpack(const Parsed& p, const nlohmann::json& view) {
  if (!view.contains("extensions")) {
    const auto first = p.data.begin() + view.value("byteOffset", 0);
    return Bytes(first, first + view.at("byteLength").get<int>());
  }
  const auto& e = view["extensions"]["EXT_meshopt_compression"];
  EXPECT_EQ(e.at("buffer"), 0);
  const std::size_t count = e.at("count"), stride = e.at("byteStride"), size = e.at("byteLength");
  const std::uint8_t* from = p.data.data() + e.at("byteOffset").get<std::size_t>();
  Bytes out(count * stride);
  if (e.at("mode") == "TRIANGLES") {
    EXPECT_EQ(meshopt_decodeIndexBuffer(out.data(), count, stride, from, size), 0);
  } else {
    EXPECT_EQ(meshopt_decodeVertexBuffer(out.data(), count, stride, from, size), 0);
    if (e.value("filter", "") == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), count, stride);
  }
  return out;
}

TEST(Compress, gives_back_the_same_mesh_to_a_fraction_of_a_millimetre) {
  RenderMesh body = plain_sheet("mannequin", 20);
  body.shade.assign(body.positions.size(), 0.7F);
  const Bytes plain = *encode_glb(std::vector<RenderMesh>{textured_sheet(30), body});
  const auto packed = compress_glb(plain);
  ASSERT_TRUE(packed) << packed.error().message;
  EXPECT_LT(packed->size(), plain.size() / 2);
  const Parsed a = parse(plain), b = parse(*packed);
  EXPECT_EQ(b.json.at("extensionsRequired"), nlohmann::json::array({"EXT_meshopt_compression"}));
  EXPECT_EQ(b.json.at("extensionsUsed"), b.json.at("extensionsRequired"));
  EXPECT_EQ(a.json.at("accessors"), b.json.at("accessors"));
  EXPECT_EQ(b.json.at("buffers").at(1).at("extensions").at("EXT_meshopt_compression").at("fallback"), true);
  ASSERT_EQ(a.json.at("bufferViews").size(), b.json.at("bufferViews").size());
  for (const auto& accessor : a.json.at("accessors")) {
    const std::size_t view = accessor.at("bufferView");
    const Bytes before = unpack(a, a.json["bufferViews"][view]), after = unpack(b, b.json["bufferViews"][view]);
    ASSERT_EQ(before.size(), after.size());
    if (accessor.at("componentType") != 5126) {
      // Corners may start at another of the three.
      if (accessor.at("type") != "SCALAR") {
        EXPECT_EQ(before, after);
      }
      continue;
    }
    for (std::size_t i = 0; i + 4 <= before.size(); i += 4) {
      float x = 0, y = 0;
      std::memcpy(&x, &before[i], 4);
      std::memcpy(&y, &after[i], 4);
      ASSERT_NEAR(x, y, 1.5e-4);
    }
  }
  // Pictures are not touched.
  for (const auto& image : a.json.at("images")) {
    const std::size_t view = image.at("bufferView");
    EXPECT_EQ(unpack(a, a.json["bufferViews"][view]), unpack(b, b.json["bufferViews"][view]));
  }
}

TEST(Compress, keeps_every_triangle_and_its_winding) {
  const Bytes plain = *encode_glb(std::vector<RenderMesh>{plain_sheet("sheet", 9)});
  const Parsed a = parse(plain), b = parse(*compress_glb(plain));
  const std::size_t view =
      a.json["accessors"][a.json["meshes"][0]["primitives"][0]["indices"].get<int>()]["bufferView"];
  const auto triangles = [&](const Parsed& p) {
    const Bytes bytes = unpack(p, p.json["bufferViews"][view]);
    std::vector<std::array<std::uint16_t, 3>> list(bytes.size() / 6);
    std::memcpy(list.data(), bytes.data(), bytes.size());
    for (auto& t : list) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(list.begin(), list.end());
    return list;
  };
  EXPECT_EQ(triangles(a), triangles(b));
}

TEST(Compress, is_the_same_bytes_twice_and_refuses_what_is_no_glb) {
  const Bytes plain = *encode_glb(std::vector<RenderMesh>{textured_sheet(8)});
  EXPECT_EQ(*compress_glb(plain), *compress_glb(plain));
  Bytes torn = plain;
  torn.resize(torn.size() - 40);
  for (const Bytes& bytes : {Bytes{}, Bytes(100, 7), torn}) {
    const auto packed = compress_glb(bytes);
    ASSERT_FALSE(packed);
    EXPECT_EQ(packed.error().code, "NOT_A_GLB");
  }
}

}  // namespace
}  // namespace vitrine::test
