// SPDX-License-Identifier: GPL-3.0-or-later
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>

#include "find_landmarks.hpp"
#include "mesh_check.hpp"
#include "vitrine/mannequin.hpp"

namespace vitrine {

namespace {

constexpr std::uintmax_t most_bytes = 256U << 20;
constexpr std::size_t most_read_triangles = 2'000'000;

Error refuse(const char* code, const std::string& path, const std::string& what, const std::string& remedy) {
  return Error{Cause::unusable, code, "The mannequin " + path + " " + what + ".", remedy, ""};
}

/// Vertices at the same place become one (numbered by first use); triangles that lose a corner by that are dropped.
TriMesh weld(const TriMesh& soup) {
  std::vector<std::uint32_t> order(soup.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto before = [&soup](const Vec3& a, const Vec3& b) {
    if (a.x() != b.x()) return a.x() < b.x();
    if (a.y() != b.y()) return a.y() < b.y();
    return a.z() < b.z();
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (before(soup.vertices[a], soup.vertices[b])) return true;
    if (before(soup.vertices[b], soup.vertices[a])) return false;
    return a < b;
  });
  std::vector<std::uint32_t> same(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool equal = i > 0 && soup.vertices[order[i]] == soup.vertices[order[i - 1]];
    same[order[i]] = equal ? same[order[i - 1]] : order[i];
  }
  TriMesh mesh;
  constexpr std::uint32_t none = 0xffffffffU;
  std::vector<std::uint32_t> number(order.size(), none);
  for (const Triangle& t : soup.triangles) {
    const Triangle joined{same[t[0]], same[t[1]], same[t[2]]};
    if (joined[0] == joined[1] || joined[1] == joined[2] || joined[2] == joined[0]) continue;
    Triangle out{};
    for (int i = 0; i < 3; ++i) {
      std::uint32_t& id = number[joined[i]];
      if (id == none) {
        id = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(soup.vertices[joined[i]]);
      }
      out[i] = id;
    }
    mesh.triangles.push_back(out);
  }
  return mesh;
}

/// A PLY header may claim any number of elements, and the reader would believe it: every element needs at least a byte.
bool honest_ply(const std::string& path, std::uintmax_t bytes) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  for (int i = 0; i < 200 && std::getline(in, line); ++i) {
    if (line.size() > 1000) return false;
    std::istringstream words(line);
    std::string word, name;
    words >> word;
    if (word == "end_header") return true;
    if (word != "element") continue;
    std::uintmax_t count = 0;
    if (!(words >> name >> count) || count > bytes) return false;
  }
  return false;
}

Result<TriMesh> read_mesh(const std::string& path) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                                          aiComponent_COLORS | aiComponent_TEXCOORDS |
                                                          aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                                                          aiComponent_TEXTURES | aiComponent_LIGHTS |
                                                          aiComponent_CAMERAS | aiComponent_MATERIALS);
  const aiScene* scene =
      importer.ReadFile(path, aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                  aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (scene == nullptr)
    return refuse("NOT_A_MESH", path, std::string("cannot be read (") + importer.GetErrorString() + ")",
                  "Give a closed mesh as OBJ, GLB, PLY or DAE.");
  std::size_t triangles = 0;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) triangles += scene->mMeshes[i]->mNumFaces;
  if (triangles == 0)
    return refuse("NOT_A_MESH", path, "has no triangles", "Give a closed mesh as OBJ, GLB, PLY or DAE.");
  if (triangles > most_read_triangles)
    return refuse("TOO_LARGE", path, "has more than 2,000,000 triangles", "Simplify the mesh.");
  TriMesh soup;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& part = *scene->mMeshes[i];
    const auto base = static_cast<std::uint32_t>(soup.vertices.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D& p = part.mVertices[v];
      // + 0.0 turns a negative zero into zero, so that welding sees one place.
      soup.vertices.emplace_back(p.x + 0.0, p.y + 0.0, p.z + 0.0);
      if (!soup.vertices.back().allFinite())
        return refuse("NOT_A_MESH", path, "has vertices that are not numbers", "Export the mesh again.");
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;
      Triangle t{};
      for (int k = 0; k < 3; ++k) {
        if (face.mIndices[k] >= part.mNumVertices)
          return refuse("NOT_A_MESH", path, "names vertices that it does not have", "Export the mesh again.");
        t[k] = base + face.mIndices[k];
      }
      soup.triangles.push_back(t);
    }
  }
  return weld(soup);
}

/// Where to look for the first edge at fault, in the file's own coordinates.
std::string first_fault(const TriMesh& mesh, const body::MeshState& state) {
  if (!state.has_fault) return "";
  const Vec3 &a = mesh.vertices[state.fault_from], &b = mesh.vertices[state.fault_to];
  char text[200];
  std::snprintf(text, sizeof text, "; the first from (%.4g, %.4g, %.4g) to (%.4g, %.4g, %.4g)", a.x(), a.y(), a.z(),
                b.x(), b.y(), b.z());
  return text;
}

struct Box {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  void add(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

struct Unit {
  double metres;
  const char* name;
};

/// The unit in which so tall a body is a person; metres where none is.
Unit guess_unit(double height) {
  constexpr Unit units[] = {{1e-3, "millimetres"}, {1e-2, "centimetres"}, {0.0254, "inches"}};
  for (const Unit& unit : units)
    if (height * unit.metres >= 1.4 && height * unit.metres <= 2.2) return unit;
  return {1.0, "metres"};
}

/// Whether the feet reach further to the back (-Z) than to the front of the shins. Expects metres, soles at y = 0.
bool faces_backwards(const TriMesh& mesh, double height) {
  double shin = 0, front = -1e300, back = 1e300;
  int count = 0;
  for (const Vec3& v : mesh.vertices) {
    if (v.y() > 0.07 * height && v.y() < 0.14 * height) {
      shin += v.z();
      ++count;
    }
    if (v.y() < 0.03 * height) {
      front = std::max(front, v.z());
      back = std::min(back, v.z());
    }
  }
  // A foot is 0.15 of the height long; stumps and pointed toes tell nothing.
  if (count == 0 || front - back < 0.1 * height) return false;
  shin /= count;
  return shin - back > 1.3 * (front - shin);
}

/// Keeps the largest piece. Small pieces within its box (eyes, teeth) are left out: cloth never meets them. Anything
/// else that stands apart (a base plate, a second figure) is refused.
Result<TriMesh> main_piece(const TriMesh& mesh, const std::string& path) {
  const std::vector<int> piece = body::pieces(mesh);
  const int count = piece.empty() ? 0 : *std::max_element(piece.begin(), piece.end()) + 1;
  if (count <= 1) return mesh;
  std::vector<Box> box(static_cast<std::size_t>(count));
  for (std::size_t v = 0; v < piece.size(); ++v) box[piece[v]].add(mesh.vertices[v]);
  std::size_t main = 0;
  const auto diagonal = [&box](std::size_t i) { return (box[i].high - box[i].low).norm(); };
  for (std::size_t i = 1; i < box.size(); ++i)
    if (diagonal(i) > diagonal(main)) main = i;
  for (std::size_t i = 0; i < box.size(); ++i) {
    const bool within =
        ((box[i].low - box[main].low).array() >= 0).all() && ((box[main].high - box[i].high).array() >= 0).all();
    if (i != main && (!within || diagonal(i) > 0.3 * diagonal(main)))
      return refuse("NOT_A_BODY", path, "has " + std::to_string(count) + " separate parts",
                    "Join the parts to one closed body, and leave out stand and clothes.");
  }
  TriMesh kept;
  for (const Triangle& t : mesh.triangles)
    if (piece[t[0]] == static_cast<int>(main)) kept.triangles.push_back(t);
  kept.vertices = mesh.vertices;
  return weld(kept);
}

}  // namespace

Result<Mannequin> import_mannequin(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code problem;
  const fs::path file(path);
  if (!fs::is_regular_file(file, problem) || !std::ifstream(file))
    return Error{Cause::missing, "MISSING_FILE", "The mannequin " + path + " does not exist or cannot be read.",
                 "Check the path and the file's permissions.", ""};
  const std::uintmax_t bytes = fs::file_size(file, problem);
  if (problem || bytes > most_bytes) return refuse("TOO_LARGE", path, "is larger than 256 MB", "Simplify the mesh.");
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension != ".obj" && extension != ".glb" && extension != ".ply" && extension != ".dae")
    return refuse("NOT_A_MESH", path, "is not an OBJ, GLB, PLY or DAE file",
                  "Give a closed mesh as OBJ, GLB, PLY or DAE.");
  if (bytes == 0) return refuse("NOT_A_MESH", path, "is empty", "Give a closed mesh as OBJ, GLB, PLY or DAE.");
  if (extension == ".ply" && !honest_ply(path, bytes))
    return refuse("NOT_A_MESH", path, "has a broken PLY header", "Export the mesh again.");
  try {
    Result<TriMesh> read = read_mesh(path);
    if (!read) return read.error();
    Result<TriMesh> whole = body::inspect(*read).parts > 1 ? main_piece(*read, path) : std::move(read);
    if (!whole) return whole.error();
    Mannequin result;
    result.source = file.filename().string();
    result.mesh = std::move(*whole);
    const body::MeshState state = body::inspect(result.mesh);
    if (result.mesh.triangles.empty() || !state.closed())
      return refuse("NOT_WATERTIGHT", path,
                    "is not closed: " + std::to_string(state.open_edges) + " open, " +
                        std::to_string(state.crowded_edges) + " crowded, " + std::to_string(state.turned_edges) +
                        " wrongly turned edges" + first_fault(result.mesh, state),
                    "Close the holes and unify the normals in a mesh editor.");
    Box box;
    for (const Vec3& v : result.mesh.vertices) box.add(v);
    if (const Vec3 size = box.high - box.low; size.z() > 1.5 * size.y()) {
      // Z up, as Blender and CAD have it, front towards -Y.
      for (Vec3& v : result.mesh.vertices) v = Vec3(v.x(), v.z(), -v.y());
      box = {};
      for (const Vec3& v : result.mesh.vertices) box.add(v);
      result.warnings.push_back(path + " stands along +Z: turned so that +Y is up and its -Y the front");
    }
    const Vec3 size = box.high - box.low;
    const Unit unit = guess_unit(size.y());
    const double height = size.y() * unit.metres;
    if (unit.metres != 1.0) {
      char text[120];
      std::snprintf(text, sizeof text, " is %.4g units tall: taken for %s", size.y(), unit.name);
      result.warnings.push_back(path + text);
    }
    if (size.z() * 1.5 > size.y() || size.x() > 1.3 * size.y())
      return refuse("NOT_A_BODY", path, "does not stand upright: its largest extent is neither +Y nor +Z",
                    "Turn the mesh so that +Y is up and +Z is the front.");
    if (!(height >= 1.2 && height <= 2.4)) {
      char text[80];
      std::snprintf(text, sizeof text, "is %.4g units tall, which is no person's height", size.y());
      return refuse("NOT_A_BODY", path, text, "Export it in metres, centimetres, millimetres or inches.");
    }
    if (body::signed_volume(result.mesh) < 0)
      for (Triangle& t : result.mesh.triangles) std::swap(t[1], t[2]);
    for (Vec3& v : result.mesh.vertices) v = unit.metres * (v - Vec3(0, box.low.y(), 0));
    if (faces_backwards(result.mesh, height)) {
      for (Vec3& v : result.mesh.vertices) v = Vec3(-v.x(), v.y(), -v.z());
      result.warnings.push_back(path + " points its feet to the back: turned around");
    }
    const double volume = body::signed_volume(result.mesh);
    if (!(volume > 0.006 * height * height * height && volume < 0.06 * height * height * height))
      return refuse("NOT_A_BODY", path, "has a volume that no body of its height has",
                    "Give a closed body with arms and legs.");
    Result<bool> found = body::find_landmarks(result, path);
    if (!found) return found.error();
    return result;
  } catch (const std::exception& e) {
    return refuse("NOT_A_MESH", path, std::string("cannot be read (") + e.what() + ")",
                  "Give a closed mesh as OBJ, GLB, PLY or DAE.");
  }
}

}  // namespace vitrine
