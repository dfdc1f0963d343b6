// SPDX-License-Identifier: GPL-3.0-or-later
#include "elf.hpp"

#include <elf.h>
#include <link.h>

#include <cstring>
#include <fstream>
#include <vector>

namespace vitrine {

namespace {

/// begin + length <= size, without overflow.
bool within(std::uint64_t begin, std::uint64_t length, std::uint64_t size) {
  return begin <= size && length <= size - begin;
}

}  // namespace

std::string elf_problem(const std::filesystem::path& file) {
  std::error_code failed;
  const std::uint64_t size = std::filesystem::file_size(file, failed);
  std::ifstream in(file, std::ios::binary);
  if (failed || !in) return "it cannot be read";
  ElfW(Ehdr) head;
  if (size < sizeof head || !in.read(reinterpret_cast<char*>(&head), sizeof head) ||
      std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0)
    return "it is not a shared library";
  if (head.e_type != ET_DYN || head.e_phentsize != sizeof(ElfW(Phdr)))
    return "it is not a shared library for this machine";
  if (!within(head.e_phoff, std::uint64_t{head.e_phnum} * sizeof(ElfW(Phdr)), size)) return "it is cut off";
  std::vector<ElfW(Phdr)> segments(head.e_phnum);
  in.seekg(static_cast<std::streamoff>(head.e_phoff));
  if (!segments.empty() && !in.read(reinterpret_cast<char*>(segments.data()),
                                    static_cast<std::streamsize>(segments.size() * sizeof(ElfW(Phdr)))))
    return "it cannot be read";
  for (const ElfW(Phdr) & segment : segments)
    if (segment.p_type == PT_LOAD && !within(segment.p_offset, segment.p_filesz, size)) return "it is cut off";
  return {};
}

}  // namespace vitrine
