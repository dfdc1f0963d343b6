// SPDX-License-Identifier: GPL-3.0-or-later
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Exporter.hpp>
#include <cmath>
#include <filesystem>
#include <memory>

#include "check.hpp"
#include "vitrine/export.hpp"

namespace vitrine {
namespace {

Error not_written(const std::string& message) {
  return {Cause::internal, "MESH_FILE_FAILED", message, "Report this with the photos that caused it.", "export"};
}

/// OBJ and PLY show colours as they are stored, a linear value has to be turned into sRGB for it.
float to_srgb(double c) {
  return static_cast<float>(c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
}

aiMesh* to_assimp(const RenderMesh& mesh, unsigned material) {
  auto out = std::make_unique<aiMesh>();
  out->mName = mesh.name;
  out->mMaterialIndex = material;
  out->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  out->mNumVertices = static_cast<unsigned>(mesh.positions.size());
  out->mVertices = new aiVector3D[out->mNumVertices];
  out->mNormals = new aiVector3D[out->mNumVertices];
  const auto convert = [](const Vec3& v) {
    return aiVector3D(static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()));
  };
  for (unsigned i = 0; i < out->mNumVertices; ++i) {
    out->mVertices[i] = convert(mesh.positions[i]);
    out->mNormals[i] = convert(mesh.normals[i]);
  }
  if (!mesh.uv.empty()) {
    out->mNumUVComponents[0] = 2;
    out->mTextureCoords[0] = new aiVector3D[out->mNumVertices];
    // Both formats count v from the bottom of the picture.
    for (unsigned i = 0; i < out->mNumVertices; ++i)
      out->mTextureCoords[0][i] =
          aiVector3D(static_cast<float>(mesh.uv[i].x()), static_cast<float>(1.0 - mesh.uv[i].y()), 0.0F);
  }
  out->mNumFaces = static_cast<unsigned>(mesh.triangles.size());
  out->mFaces = new aiFace[out->mNumFaces];
  for (unsigned f = 0; f < out->mNumFaces; ++f) {
    out->mFaces[f].mNumIndices = 3;
    out->mFaces[f].mIndices = new unsigned[3];
    for (int i = 0; i < 3; ++i) out->mFaces[f].mIndices[i] = mesh.triangles[f][i];
  }
  return out.release();
}

aiMaterial* to_material(const RenderMesh& mesh, const std::string& texture) {
  auto out = std::make_unique<aiMaterial>();
  const aiString name(mesh.name + "_material");
  out->AddProperty(&name, AI_MATKEY_NAME);
  aiColor3D colour(to_srgb(mesh.colour[0]), to_srgb(mesh.colour[1]), to_srgb(mesh.colour[2]));
  if (!texture.empty()) {
    colour = aiColor3D(1, 1, 1);
    const aiString file(texture);
    out->AddProperty(&file, AI_MATKEY_TEXTURE_DIFFUSE(0));
  }
  out->AddProperty(&colour, 1, AI_MATKEY_COLOR_DIFFUSE);
  return out.release();
}

/// The scene owns what it is given, mesh by mesh: nothing leaks when a later one throws.
std::unique_ptr<aiScene> to_scene(std::span<const RenderMesh> meshes, const std::vector<std::string>& textures) {
  auto scene = std::make_unique<aiScene>();
  const auto count = static_cast<unsigned>(meshes.size());
  scene->mRootNode = new aiNode("scene");
  scene->mMeshes = new aiMesh* [count] {};
  scene->mMaterials = new aiMaterial* [count] {};
  auto** children = new aiNode* [count] {};
  scene->mRootNode->mChildren = children;
  for (unsigned i = 0; i < count; ++i) {
    scene->mMeshes[i] = to_assimp(meshes[i], i);
    scene->mNumMeshes = i + 1;
    scene->mMaterials[i] = to_material(meshes[i], textures[i]);
    scene->mNumMaterials = i + 1;
    children[i] = new aiNode(meshes[i].name);
    scene->mRootNode->mNumChildren = i + 1;
    children[i]->mParent = scene->mRootNode;
    children[i]->mMeshes = new unsigned[1]{i};
    children[i]->mNumMeshes = 1;
  }
  return scene;
}

/// What a format is called by assimp, and its file name ending.
struct Writer {
  const char* id;
  const char* ending;
};

/// PLY has no field for a texture; readers (MeshLab, CloudCompare) take it from a comment in the header.
Bytes with_texture_comment(std::span<const std::uint8_t> ply, const std::string& texture) {
  Bytes out(ply.begin(), ply.end());
  const std::string first = "ply\n", comment = "comment TextureFile " + texture + "\n";
  if (!texture.empty() && out.size() > first.size() && std::equal(first.begin(), first.end(), out.begin())) {
    // The format line has to come second.
    const auto second = std::find(out.begin() + static_cast<std::ptrdiff_t>(first.size()), out.end(), '\n');
    if (second != out.end()) out.insert(second + 1, comment.begin(), comment.end());
  }
  return out;
}

/// One file with what it refers to. What is referred to is written before what refers to it.
std::optional<Error> write_scene(std::span<const RenderMesh> meshes, const Writer& writer, const std::string& folder,
                                 const std::string& name) {
  const std::filesystem::path base = std::filesystem::path(folder) / name;
  std::vector<std::string> textures(meshes.size());
  std::vector<Bytes> pictures(meshes.size());
  std::string last;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (meshes[i].texture.empty()) continue;
    auto png = encode_png(meshes[i].texture);
    if (!png) return png.error();
    pictures[i] = *std::move(png);
    textures[i] = last = name + "_" + (meshes.size() == 1 ? "texture" : meshes[i].name) + ".png";
  }
  const auto scene = to_scene(meshes, textures);
  Assimp::Exporter exporter;
  // In memory first: assimp itself would leave half files behind on a full disk. The blob's name is what the OBJ calls
  // its material file.
  Assimp::ExportProperties properties;
  properties.SetPropertyString(AI_CONFIG_EXPORT_BLOB_NAME, name);
  const aiExportDataBlob* blob = exporter.ExportToBlob(scene.get(), writer.id, 0, &properties);
  if (!blob)
    return not_written(std::string("assimp could not write ") + base.string() + ": " + exporter.GetErrorString());
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (!textures[i].empty())
      if (auto error = write_file((std::filesystem::path(folder) / textures[i]).string(), pictures[i])) return error;
  for (const aiExportDataBlob* part = blob->next; part; part = part->next)
    if (auto error = write_file((std::filesystem::path(folder) / part->name.C_Str()).string(),
                                std::span(static_cast<const std::uint8_t*>(part->data), part->size)))
      return error;
  const std::span bytes(static_cast<const std::uint8_t*>(blob->data), blob->size);
  return write_file(base.string() + writer.ending, with_texture_comment(bytes, last));
}

}  // namespace

std::optional<Error> write_meshes(std::span<const RenderMesh> meshes, MeshFormat format, const std::string& folder,
                                  const std::string& name) {
  if (auto error = check_meshes(meshes)) return error;
  if (name.empty() || name.find('/') != std::string::npos || name[0] == '.')
    return not_written("\"" + name + "\" is not a file name.");
  try {
    if (format == MeshFormat::obj) return write_scene(meshes, {"obj", ".obj"}, folder, name);
    for (const RenderMesh& mesh : meshes)
      if (auto error = write_scene(std::span(&mesh, 1), {"plyb", ".ply"}, folder,
                                   meshes.size() == 1 ? name : name + "_" + mesh.name))
        return error;
    return std::nullopt;
  } catch (const std::exception& e) {
    return not_written("The mesh could not be made: " + std::string(e.what()));
  }
}

std::string portable_name(const std::string& prefix, const std::string& text) {
  std::string out = prefix;
  if (!text.empty()) out += '_';
  for (const unsigned char c : text) {
    const bool upper = c >= 'A' && c <= 'Z';
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    out += upper ? static_cast<char>(c + ('a' - 'A')) : plain ? static_cast<char>(c) : '-';
  }
  return out;
}

}  // namespace vitrine
