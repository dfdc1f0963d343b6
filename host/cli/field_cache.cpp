// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_cache.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "vitrine/export.hpp"

namespace vitrine::cli {
namespace {

namespace fs = std::filesystem;
static_assert(std::endian::native == std::endian::little, "the cache's files are little-endian");

constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30;

/// FNV-1a over 64-bit words: tells meshes and damaged files apart, it does not withstand an attacker.
class Hash {
 public:
  void add(const void* data, std::size_t bytes) {
    const auto* from = static_cast<const unsigned char*>(data);
    for (; bytes >= 8; bytes -= 8, from += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, from, 8);
      mix(word);
    }
    for (; bytes > 0; --bytes) mix(*from++);
  }
  std::uint64_t value() const { return value_; }

 private:
  void mix(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001b3ULL;
    value_ ^= value_ >> 29;
  }
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

/// What stands before the values. Another layout or another way to fill voxels gets another magic.
struct Header {
  char magic[8] = {'V', 'I', 'T', 'F', 'L', 'D', '0', '2'};
  std::uint64_t mesh = 0, values = 0;  ///< hashes
  double origin[3] = {0, 0, 0}, spacing = 0;
  std::int32_t size[3] = {0, 0, 0}, overlaps = 0;
};
static_assert(sizeof(Header) == 72);

std::uint64_t hash_of(const TriMesh& mesh, const VoxelOptions& options) {
  Hash hash;
  for (const Vec3& v : mesh.vertices) hash.add(v.data(), 3 * sizeof(double));
  for (const Triangle& t : mesh.triangles) hash.add(t.data(), sizeof(Triangle));
  hash.add(&options.spacing, sizeof options.spacing);
  hash.add(&options.margin, sizeof options.margin);
  return hash.value();
}

/// Over the header, whatever hash it holds already, and the values.
std::uint64_t hash_of(Header header, const std::vector<float>& values) {
  header.values = 0;
  Hash hash;
  hash.add(&header, sizeof header);
  hash.add(values.data(), values.size() * sizeof(float));
  return hash.value();
}

bool load(const fs::path& file, const TriMesh& body, std::uint64_t mesh, DistanceField& field) {
  std::error_code problem;
  const std::uintmax_t bytes = fs::file_size(file, problem);
  std::ifstream in(file, std::ios::binary);
  Header h;
  const Header fresh;
  if (problem || bytes > most_bytes || !in.read(reinterpret_cast<char*>(&h), sizeof h)) return false;
  if (std::memcmp(h.magic, fresh.magic, sizeof h.magic) != 0 || h.mesh != mesh) return false;
  // The file's own length bounds what its header may claim.
  std::uintmax_t count = 1;
  for (const std::int32_t n : h.size) {
    if (n < 2 || static_cast<std::uintmax_t>(n) > most_bytes / sizeof(float) / count) return false;
    count *= static_cast<std::uintmax_t>(n);
  }
  if (bytes != sizeof h + count * sizeof(float)) return false;
  field.values.resize(count);
  if (!in.read(reinterpret_cast<char*>(field.values.data()), static_cast<std::streamsize>(count * sizeof(float))) ||
      hash_of(h, field.values) != h.values)
    return false;
  field.origin = Vec3(h.origin[0], h.origin[1], h.origin[2]);
  field.spacing = h.spacing;
  std::copy_n(h.size, 3, field.size.begin());
  // Found again faster than read, and then never other than the mesh's.
  field.patches = find_patches(body, field, h.overlaps != 0);
  return true;
}

std::optional<Error> store(const fs::path& file, std::uint64_t mesh, const DistanceField& field) {
  Header h;
  h.mesh = mesh;
  std::copy_n(field.origin.data(), 3, h.origin);
  h.spacing = field.spacing;
  std::copy_n(field.size.begin(), 3, h.size);
  h.overlaps = field.patches.overlaps ? 1 : 0;
  h.values = hash_of(h, field.values);
  std::vector<std::uint8_t> bytes(sizeof h + field.values.size() * sizeof(float));
  std::memcpy(bytes.data(), &h, sizeof h);
  std::memcpy(bytes.data() + sizeof h, field.values.data(), field.values.size() * sizeof(float));
  return write_file(file.string(), bytes);
}

/// Another job may remove the same files at the same time: what is gone already is no error.
void keep_small(const fs::path& folder) {
  struct Entry {
    fs::file_time_type used;
    std::uintmax_t bytes;
    fs::path path;
  };
  std::vector<Entry> entries;
  std::uintmax_t total = 0;
  std::error_code gone;
  for (const auto& entry : fs::directory_iterator(folder, gone)) {
    if (entry.path().extension() != ".field") continue;
    std::error_code lost;
    const Entry e{entry.last_write_time(lost), entry.file_size(lost), entry.path()};
    if (lost) continue;
    entries.push_back(e);
    total += e.bytes;
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (const Entry& e : entries) {
    if (total <= most_bytes) return;
    fs::remove(e.path, gone);
    total -= e.bytes;
  }
}

}  // namespace

Result<DistanceField> cached_field(const TriMesh& mesh, const VoxelOptions& options, const std::string& folder) {
  if (folder.empty()) return voxelise(mesh, options);
  const std::uint64_t hash = hash_of(mesh, options);
  char name[32];
  std::snprintf(name, sizeof name, "%016llx.field", static_cast<unsigned long long>(hash));
  const fs::path file = fs::path(folder) / name;
  DistanceField found;
  std::error_code problem;
  if (load(file, mesh, hash, found)) {
    fs::last_write_time(file, fs::file_time_type::clock::now(), problem);
    return found;
  }
  Result<DistanceField> field = voxelise(mesh, options);
  if (!field) return field;
  fs::create_directories(folder, problem);
  if (auto error = store(file, hash, *field)) return *error;
  keep_small(folder);
  return field;
}

}  // namespace vitrine::cli
