// SPDX-License-Identifier: GPL-3.0-or-later
#include "folder_name.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "text.hpp"
#include "vitrine/sku.hpp"

namespace vitrine::input {
namespace {

constexpr std::size_t digits = 16;

bool is_hex(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
}

bool ends_like_ours(std::string_view id) {
  if (id.size() < digits + 2) return false;
  const std::string_view tail = id.substr(id.size() - digits - 2);
  return tail.substr(0, 2) == "-x" && std::all_of(tail.begin() + 2, tail.end(), is_hex);
}

/// What a run leaves beside the items' folders.
bool is_reserved(const std::string& id) {
  for (const char* file : {"report", "timings", "summary", "junit", "journal", "items", "quarantine", "shards"})
    if (lower(id) == file || lower(id).rfind(std::string(file) + ".", 0) == 0) return true;
  return false;
}

}  // namespace

std::string sha256_hex(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("OpenSSL has no SHA-256");
  std::string hex;
  for (unsigned i = 0; i < size; ++i) {
    hex += "0123456789abcdef"[digest[i] >> 4];
    hex += "0123456789abcdef"[digest[i] & 15];
  }
  return hex;
}

std::string folder_name(std::string_view id) {
  const std::string plain(id);
  if (is_safe_sku(plain) && !ends_like_ours(plain) && !is_reserved(plain)) return plain;
  std::string name;
  for (const char c : plain.substr(0, 60)) {
    const bool keep =
        (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_';
    if (keep && !(name.empty() && (c == '.' || c == '-')))
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  if (name.empty()) name = "item";
  return name + "-x" + sha256_hex(plain).substr(0, digits);
}

}  // namespace vitrine::input
