// SPDX-License-Identifier: GPL-3.0-or-later
#include <assimp/material.h>
#include <assimp/scene.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <assimp/Importer.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "sample.hpp"

namespace vitrine::test {
namespace {

namespace fs = std::filesystem;

/// An empty folder that goes away with the test.
class Files : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "vitrine_export_XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& entry : fs::directory_iterator(folder_)) out.push_back(entry.path().filename().string());
    std::sort(out.begin(), out.end());
    return out;
  }
  static std::string read(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path folder_;
};

TEST_F(Files, are_written_whole_and_leave_nothing_else_behind) {
  const std::string text(300'000, 'x');
  EXPECT_EQ(write_file(path("a.txt"), text), std::nullopt);
  EXPECT_EQ(write_file(path("a.txt"), std::string("short")), std::nullopt);
  EXPECT_EQ(read(path("a.txt")), "short");
  EXPECT_THAT(names(), testing::ElementsAre("a.txt"));
}

TEST_F(Files, name_the_path_and_the_reason_when_they_cannot_be_written) {
  const auto missing = write_file(path("nowhere/a.glb"), std::string("x"));
  ASSERT_TRUE(missing);
  EXPECT_EQ(missing->exit_code(), 73);
  EXPECT_THAT(missing->message, testing::HasSubstr("nowhere/a.glb"));
  EXPECT_THAT(missing->message, testing::HasSubstr("No such file"));
  EXPECT_FALSE(missing->remedy.empty());

  fs::create_directory(path("taken"));
  const auto taken = write_file(path("taken"), std::string("x"));
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->exit_code(), 73);
  EXPECT_THAT(names(), testing::ElementsAre("taken"));
}

TEST_F(Files, keep_the_old_version_when_the_new_one_does_not_fit) {
  EXPECT_EQ(write_file(path("a"), std::string("old")), std::nullopt);
  // A file size limit stands for a full disk; it holds for root as well.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto error = write_file(path("a"), std::string(5000, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->exit_code(), 73);
  EXPECT_THAT(error->message, testing::HasSubstr("too large"));
  EXPECT_EQ(read(path("a")), "old");
  EXPECT_THAT(names(), testing::ElementsAre("a"));
}

TEST_F(Files, obj_reads_back_with_its_material_and_texture_beside_it) {
  const std::vector<RenderMesh> meshes{textured_sheet(6), plain_sheet("mannequin", 4)};
  ASSERT_EQ(write_meshes(meshes, MeshFormat::obj, folder_.string(), "item"), std::nullopt);
  EXPECT_THAT(names(), testing::ElementsAre("item.mtl", "item.obj", "item_garment.png"));
  EXPECT_THAT(read(path("item.obj")), testing::HasSubstr("mtllib item.mtl"));
  EXPECT_THAT(read(path("item.mtl")), testing::HasSubstr("map_Kd item_garment.png"));

  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path("item.obj"), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 2u);
  EXPECT_EQ(scene->mMeshes[0]->mNumFaces, meshes[0].triangles.size());
  EXPECT_EQ(scene->mMeshes[1]->mNumFaces, meshes[1].triangles.size());
  EXPECT_STREQ(scene->mMeshes[0]->mName.C_Str(), "garment");
  // The top of the sheet shows the top of the picture, in OBJ's own direction of v.
  const aiMesh& garment = *scene->mMeshes[0];
  for (unsigned i = 0; i < garment.mNumVertices; ++i)
    EXPECT_NEAR(garment.mTextureCoords[0][i].y, (garment.mVertices[i].y - 0.1) / 1.1, 1e-4);
}

TEST_F(Files, obj_is_the_same_bytes_in_another_folder) {
  const std::vector<RenderMesh> meshes{textured_sheet(6)};
  fs::create_directory(path("one"));
  fs::create_directory(path("two"));
  ASSERT_EQ(write_meshes(meshes, MeshFormat::obj, path("one"), "item"), std::nullopt);
  ASSERT_EQ(write_meshes(meshes, MeshFormat::obj, path("two"), "item"), std::nullopt);
  for (const char* name : {"item.obj", "item.mtl", "item_texture.png"})
    EXPECT_EQ(read(path("one/") + name), read(path("two/") + name)) << name;
}

TEST_F(Files, ply_reads_back_and_names_its_texture_in_the_header) {
  const std::vector<RenderMesh> meshes{textured_sheet(6)};
  ASSERT_EQ(write_meshes(meshes, MeshFormat::ply, folder_.string(), "item"), std::nullopt);
  EXPECT_THAT(names(), testing::ElementsAre("item.ply", "item_texture.png"));
  EXPECT_THAT(read(path("item.ply")), testing::StartsWith("ply\nformat binary_little_endian 1.0\n"
                                                          "comment TextureFile item_texture.png\n"));
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path("item.ply"), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 1u);
  const aiMesh& mesh = *scene->mMeshes[0];
  EXPECT_EQ(mesh.mNumFaces, meshes[0].triangles.size());
  ASSERT_TRUE(mesh.HasNormals() && mesh.HasTextureCoords(0));
  for (unsigned i = 0; i < mesh.mNumVertices; ++i)
    EXPECT_NEAR(mesh.mTextureCoords[0][i].y, (mesh.mVertices[i].y - 0.1) / 1.1, 1e-4);
}

TEST_F(Files, one_ply_is_written_for_each_mesh_when_there_are_several) {
  const std::vector<RenderMesh> meshes{textured_sheet(3), plain_sheet("mannequin", 2)};
  ASSERT_EQ(write_meshes(meshes, MeshFormat::ply, folder_.string(), "item"), std::nullopt);
  EXPECT_THAT(names(), testing::ElementsAre("item_garment.ply", "item_garment_texture.png", "item_mannequin.ply"));
}

TEST_F(Files, obj_into_a_missing_folder_is_an_error_73) {
  const std::vector<RenderMesh> meshes{textured_sheet(2)};
  const auto error = write_meshes(meshes, MeshFormat::obj, path("nowhere"), "item");
  ASSERT_TRUE(error);
  EXPECT_EQ(error->exit_code(), 73);
  EXPECT_TRUE(write_meshes(meshes, MeshFormat::obj, folder_.string(), "../escape"));
  EXPECT_THAT(names(), testing::IsEmpty());
}

TEST(Pictures, keep_red_red_and_blue_blue) {
  const Image image = red_over_blue();
  for (const bool png : {true, false}) {
    const auto bytes = png ? encode_png(image) : encode_jpeg(image, 90);
    ASSERT_TRUE(bytes);
    const cv::Mat bgr = cv::imdecode(*bytes, cv::IMREAD_COLOR);
    ASSERT_EQ(bgr.size(), cv::Size(32, 32));
    EXPECT_NEAR(bgr.at<cv::Vec3b>(4, 4)[2], 220, png ? 0 : 8);
    EXPECT_NEAR(bgr.at<cv::Vec3b>(28, 4)[0], 220, png ? 0 : 8);
  }
}

TEST(Pictures, refuse_torn_images_and_impossible_quality) {
  Image torn(8, 8, 3);
  torn.data.pop_back();
  EXPECT_FALSE(encode_png(torn));
  EXPECT_FALSE(encode_png(Image{}));
  EXPECT_FALSE(encode_jpeg(red_over_blue(), 0));
  EXPECT_FALSE(encode_jpeg(Image(8, 8, 4), 80));
  EXPECT_FALSE(encode_webp(red_over_blue(), 101));
  EXPECT_EQ(encode_webp(Image(16'384, 4, 3), 80).error().code, "PICTURE_TOO_LARGE");
}

TEST(Pictures, keep_their_alpha_channel_in_webp) {
  Image image(32, 32, 4);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      image.at(x, y)[0] = 220;
      image.at(x, y)[3] = y < 16 ? 0 : 255;
    }
  const auto bytes = encode_webp(image, 90);
  ASSERT_TRUE(bytes);
  const cv::Mat bgra = cv::imdecode(*bytes, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(bgra.type(), CV_8UC4);
  EXPECT_EQ(bgra.at<cv::Vec4b>(4, 4)[3], 0);
  EXPECT_EQ(bgra.at<cv::Vec4b>(28, 4)[3], 255);
  EXPECT_NEAR(bgra.at<cv::Vec4b>(28, 4)[2], 220, 8);
}

TEST(Names, are_portable_whatever_a_shop_calls_its_goods) {
  EXPECT_EQ(portable_name("garment", ""), "garment");
  EXPECT_EQ(portable_name("garment", "12-AB_7"), "garment_12-ab_7");
  EXPECT_EQ(portable_name("garment", "Kleid \xC3\xA4 1.5"), "garment_kleid----1-5");
}

}  // namespace
}  // namespace vitrine::test
