// SPDX-License-Identifier: GPL-3.0-or-later
#include "model_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "../input/folder_name.hpp"
#include "../input/json_text.hpp"

namespace vitrine::feed {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::uintmax_t max_bytes = 512u << 20;

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  return value;
}

Error no_model(const fs::path& file, const std::string& what) {
  return Error{Cause::unusable, "MODEL_FILE", file.string() + ": " + what, "Run the catalogue again with --force.",
               "catalog"};
}

/// The box of all accessors that are positions of a mesh.
bool box_of(const json& gltf, ModelFile& model) {
  model.low.fill(std::numeric_limits<double>::infinity());
  model.high.fill(-std::numeric_limits<double>::infinity());
  const auto meshes = gltf.find("meshes");
  const auto accessors = gltf.find("accessors");
  if (meshes == gltf.end() || accessors == gltf.end() || !meshes->is_array() || !accessors->is_array()) return false;
  for (const json& mesh : *meshes)
    for (const json& primitive : mesh.value("primitives", json::array())) {
      const std::size_t index = primitive.at("attributes").at("POSITION").get<std::size_t>();
      const json& accessor = accessors->at(index);
      for (std::size_t k = 0; k < 3; ++k) {
        model.low[k] = std::min(model.low[k], accessor.at("min").at(k).get<double>());
        model.high[k] = std::max(model.high[k], accessor.at("max").at(k).get<double>());
      }
    }
  return std::isfinite(model.low[0]) && std::isfinite(model.high[0]);
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
    if (!entry->is_symlink(failed)) names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Folders of a run's own, and what was refused, are no items.
bool is_item(const std::string& folder) {
  return folder[0] != '.' && folder != "quarantine" && folder != "shards";
}

/// The picture that goes before the model: the first view of those that a run can make.
void find_poster(const fs::path& root, const std::string& folder, ItemFolder& item) {
  for (const char* name : {"front", "preview"})
    for (const char* kind : {".webp", ".jpg", ".png"}) {
      const std::string path = folder + name + kind;
      std::error_code failed;
      if (!item.poster.empty() || !fs::is_regular_file(root / path, failed)) continue;
      item.poster = path;
      item.poster_bytes = fs::file_size(root / path, failed);
    }
}

}  // namespace

Result<ModelFile> read_model(const fs::path& root, const std::string& path) {
  const fs::path file = root / path;
  std::error_code failed;
  ModelFile model;
  model.path = path;
  model.name = file.stem().string();
  model.bytes = fs::file_size(file, failed);
  if (failed) return no_model(file, failed.message());
  if (model.bytes > max_bytes) return no_model(file, "the file has more than 512 MB");
  std::string bytes(model.bytes, '\0');
  std::ifstream(file, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (bytes.size() < 20 || bytes.compare(0, 4, "glTF") != 0 || word(bytes, 4) != 2 || word(bytes, 8) != bytes.size() ||
      bytes.compare(16, 4, "JSON") != 0 || word(bytes, 12) > bytes.size() - 20)
    return no_model(file, "this is not a whole GLB");
  model.sha256 = input::sha256_hex(bytes);
  const auto gltf = input::parse_json(std::string_view(bytes).substr(20, word(bytes, 12)), file.string(), "MODEL_FILE");
  if (!gltf) return gltf.error();
  try {
    if (!box_of(*gltf, model)) return no_model(file, "no mesh in it has positions");
  } catch (const json::exception&) {
    return no_model(file, "its positions have no box");
  }
  return model;
}

Result<std::vector<ItemFolder>> scan(const std::string& out_dir, std::vector<Error>& left_out) {
  const fs::path root = out_dir;
  std::error_code failed;
  if (!fs::is_directory(root, failed))
    return Error{Cause::missing, "OUT_DIR", out_dir + ": there is no such folder",
                 "Give the folder that vitrine catalog run wrote with --out.", "catalog"};
  std::vector<ItemFolder> items;
  const auto take = [&](ItemFolder& item, const std::string& folder, const std::string& size) {
    for (const std::string& name : names_in(root / folder)) {
      if (!ends_with(name, ".glb")) continue;
      Result<ModelFile> model = read_model(root, folder + name);
      if (!model) {
        left_out.push_back(model.error());
        continue;
      }
      model->size = size;
      item.models.push_back(std::move(*model));
    }
  };
  for (const std::string& sku : names_in(root)) {
    if (!is_item(sku) || !fs::is_directory(root / sku, failed)) continue;
    ItemFolder item;
    item.sku = sku;
    take(item, sku + "/", "");
    find_poster(root, sku + "/", item);
    for (const std::string& size : names_in(root / sku)) {
      if (!is_item(size) || !fs::is_directory(root / sku / size, failed)) continue;
      take(item, sku + "/" + size + "/", size);
      if (item.poster.empty()) find_poster(root, sku + "/" + size + "/", item);
    }
    if (!item.models.empty()) items.push_back(std::move(item));
  }
  return items;
}

}  // namespace vitrine::feed
