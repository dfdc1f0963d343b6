// SPDX-License-Identifier: GPL-3.0-or-later
#include "digest.hpp"

#include <openssl/evp.h>

#include <vector>

namespace vitrine {

std::string sha256_hex(const void* data, std::size_t size) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned length = 0;
  if (EVP_Digest(data, size, digest, &length, EVP_sha256(), nullptr) != 1) return {};
  std::string hex;
  for (unsigned i = 0; i < length; ++i)
    for (const int nibble : {digest[i] >> 4, digest[i] & 15}) hex += "0123456789abcdef"[nibble];
  return hex;
}

std::string hash_of(const TriMesh& mesh) {
  std::vector<float> numbers;  // as the models hold them
  numbers.reserve(3 * (mesh.vertices.size() + mesh.triangles.size()));
  for (const Vec3& p : mesh.vertices)
    for (int i = 0; i < 3; ++i) numbers.push_back(static_cast<float>(p[i]));
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) numbers.push_back(static_cast<float>(v));
  return sha256_hex(numbers.data(), numbers.size() * sizeof(float));
}

}  // namespace vitrine
