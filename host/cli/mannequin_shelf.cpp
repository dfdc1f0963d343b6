// SPDX-License-Identifier: GPL-3.0-or-later
#include "mannequin_shelf.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>

namespace vitrine::cli {
namespace {

constexpr const char* sizes[] = {"XS", "S", "M", "L", "XL", "XXL"};

/// In capitals, or empty when the name is no size.
std::string size_of(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return std::find(std::begin(sizes), std::end(sizes), name) != std::end(sizes) ? name : "";
}

}  // namespace

std::string hash_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> digest(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  if (!in || !digest || EVP_DigestInit_ex(digest.get(), EVP_sha256(), nullptr) != 1) return {};
  std::vector<char> buffer(std::size_t{1} << 18);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0)
    EVP_DigestUpdate(digest.get(), buffer.data(), static_cast<std::size_t>(in.gcount()));
  unsigned char bytes[EVP_MAX_MD_SIZE];
  unsigned size = 0;
  if (EVP_DigestFinal_ex(digest.get(), bytes, &size) != 1) return {};
  std::string hex;
  for (unsigned i = 0; i < size; ++i)
    for (const int nibble : {bytes[i] >> 4, bytes[i] & 15}) hex += "0123456789abcdef"[nibble];
  return hex;
}

MannequinOptions MannequinShelf::named(const std::string& name) const {
  MannequinOptions options = options_;
  options.file = name;
  if (std::string size = size_of(name); !size.empty()) {
    std::transform(size.begin(), size.end(), size.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    options.file = (options_.sex.empty() ? "woman-" : options_.sex + "-") + size;
    options.sex.clear();
  }
  return options;
}

const std::string& MannequinShelf::identity(const std::string& name) {
  const auto [place, fresh] = identities_.emplace(name, "");
  if (!fresh) return place->second;
  const MannequinOptions options = named(name);
  std::string& text = place->second;
  text = options.file + " " + options.sex;
  for (const auto& [key, value] : options.millimetres)
    if (value) {
      char number[48];
      std::snprintf(number, sizeof number, "%.17g", *value);
      text += " " + key + "=" + number;
    }
  std::error_code failed;
  if (std::filesystem::is_regular_file(options.file, failed)) text += " " + hash_of_file(options.file);
  return text;
}

Result<std::shared_ptr<const Body>> MannequinShelf::make(const std::string& name) {
  if (const auto found = bodies_.find(name); found != bodies_.end()) return found->second;
  return bodies_.emplace(name, named(name).make_body()).first->second;
}

std::string MannequinShelf::folder_of(const std::string& name) {
  const std::string size = size_of(name);
  return size.empty() ? std::filesystem::path(name).stem().string() : size;
}

std::optional<Error> MannequinShelf::check_run(const std::vector<std::string>& names) {
  std::set<std::string> folders;
  for (const std::string& name : names) {
    const std::string folder = folder_of(name);
    const bool plain = !folder.empty() && folder[0] != '.' && folder[0] != '-' && folder != "quarantine" &&
                       std::all_of(folder.begin(), folder.end(),
                                   [](unsigned char c) { return std::isalnum(c) || c == '.' || c == '_' || c == '-'; });
    if (!plain || !folders.insert(folder).second)
      return Error{Cause::usage, "MANNEQUIN_NAME",
                   "mannequin \"" + name + "\" of a size run: \"" + folder + "\" " +
                       (plain ? "is another one's folder too" : "cannot be the name of a folder"),
                   "give each mannequin of a size run a name of its own, of letters, digits, '.', '_' and '-'",
                   "mannequin"};
  }
  return std::nullopt;
}

}  // namespace vitrine::cli
