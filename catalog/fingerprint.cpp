// SPDX-License-Identifier: GPL-3.0-or-later
#include "fingerprint.hpp"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <memory>
#include <vector>

namespace vitrine {
namespace {

using Digest = std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)>;

Digest begin() {
  Digest digest(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  if (digest && EVP_DigestInit_ex(digest.get(), EVP_sha256(), nullptr) != 1) digest.reset();
  return digest;
}

std::string hex_of(EVP_MD_CTX* digest) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
  unsigned size = 0;
  if (EVP_DigestFinal_ex(digest, bytes.data(), &size) != 1) return {};
  std::string hex;
  for (unsigned i = 0; i < size; ++i)
    for (const int nibble : {bytes[i] >> 4, bytes[i] & 15}) hex += "0123456789abcdef"[nibble];
  return hex;
}

std::int64_t nanoseconds(const timespec& t) {
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

/// File times move in steps of up to two seconds (FAT, some network file systems).
constexpr std::int64_t coarsest_step = 2'000'000'000;

}  // namespace

std::string sha256_of(std::string_view text) {
  const Digest digest = begin();
  if (!digest || EVP_DigestUpdate(digest.get(), text.data(), text.size()) != 1) return {};
  return hex_of(digest.get());
}

std::string sha256_of_file(const std::filesystem::path& file) {
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) return {};
  const Digest digest = begin();
  struct stat s;
  // A pipe or device would never end.
  bool well = digest && ::fstat(fd, &s) == 0 && S_ISREG(s.st_mode);
  static thread_local std::vector<char> buffer(std::size_t{1} << 18);
  while (well) {
    const ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) break;
    well = n > 0 && EVP_DigestUpdate(digest.get(), buffer.data(), static_cast<std::size_t>(n)) == 1;
  }
  ::close(fd);
  return well ? hex_of(digest.get()) : std::string();
}

std::optional<FileStamp> stamp_of(const std::filesystem::path& file) {
  struct stat s;
  if (::stat(file.c_str(), &s) != 0 || !S_ISREG(s.st_mode)) return {};
  return FileStamp{s.st_size, nanoseconds(s.st_mtim), nanoseconds(s.st_ctim), s.st_ino};
}

Fingerprint fingerprint(const std::filesystem::path& file, const Fingerprint* known, bool checksum) {
  const std::optional<FileStamp> stamp = stamp_of(file);
  if (!stamp) return {"missing", {}};
  if (!checksum && known != nullptr && known->stamp == stamp) return *known;
  timespec now;
  ::clock_gettime(CLOCK_REALTIME, &now);
  Fingerprint print{sha256_of_file(file), {}};
  if (print.sha256.empty()) return {"missing", {}};
  const std::int64_t youngest = std::max(stamp->modified, stamp->changed);
  // Written to while it was read: what was read is neither the old nor the new file, and the stamp is not kept.
  if (stamp_of(file) == stamp && nanoseconds(now) - youngest > coarsest_step) print.stamp = stamp;
  return print;
}

Fingerprint own_fingerprint(const std::filesystem::path& file) {
  const std::optional<FileStamp> stamp = stamp_of(file);
  std::string sha256 = stamp ? sha256_of_file(file) : std::string();
  if (sha256.empty()) return {"missing", {}};
  return {std::move(sha256), stamp};
}

nlohmann::json to_json(const Fingerprints& files) {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [name, print] : files) {
    json[name] = nlohmann::json::array({print.sha256});
    if (const auto& s = print.stamp) {
      json[name].push_back(s->size);
      json[name].push_back(s->modified);
      json[name].push_back(s->changed);
      json[name].push_back(s->inode);
    }
  }
  return json;
}

bool from_json(const nlohmann::json& json, bool trusted, Fingerprints& files) {
  if (!json.is_object()) return false;
  for (const auto& [name, value] : json.items()) {
    if (!value.is_array() || value.empty() || !value[0].is_string()) return false;
    Fingerprint print{value[0].get<std::string>(), {}};
    if (value.size() == 5) {
      for (std::size_t i = 1; i < 5; ++i)
        if (!value[i].is_number_integer()) return false;
      if (trusted)
        print.stamp = FileStamp{value[1].get<std::int64_t>(), value[2].get<std::int64_t>(),
                                value[3].get<std::int64_t>(), value[4].get<std::uint64_t>()};
    }
    files[name] = std::move(print);
  }
  return true;
}

}  // namespace vitrine
