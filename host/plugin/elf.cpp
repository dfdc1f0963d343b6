// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/host/elf.hpp"

#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstring>

namespace vitrine {

namespace {

using Bytes = std::span<const std::uint8_t>;

/// begin + length <= size, without overflow.
bool within(std::uint64_t begin, std::uint64_t length, std::uint64_t size) {
  return begin <= size && length <= size - begin;
}

/// A struct at an offset of the file; zeros where the file ends before it does.
template <class T>
T at(Bytes file, std::uint64_t offset) {
  T value{};
  if (within(offset, sizeof value, file.size())) std::memcpy(&value, file.data() + offset, sizeof value);
  return value;
}

std::vector<ElfW(Phdr)> segments_of(Bytes file) {
  const auto head = at<ElfW(Ehdr)>(file, 0);
  std::vector<ElfW(Phdr)> segments;
  for (std::uint64_t i = 0; i < head.e_phnum; ++i)
    segments.push_back(at<ElfW(Phdr)>(file, head.e_phoff + i * sizeof(ElfW(Phdr))));
  return segments;
}

/// The dynamic section, with the addresses in it turned into offsets of the file.
class Dynamic {
 public:
  explicit Dynamic(Bytes file) : file_(file), segments_(segments_of(file)) {
    for (const ElfW(Phdr) & segment : segments_) {
      if (segment.p_type != PT_DYNAMIC) continue;
      for (std::uint64_t at_byte = 0; within(at_byte, sizeof(ElfW(Dyn)), segment.p_filesz);
           at_byte += sizeof(ElfW(Dyn))) {
        const auto row = at<ElfW(Dyn)>(file_, segment.p_offset + at_byte);
        if (row.d_tag == DT_NULL) break;
        rows_.push_back(row);
      }
    }
  }
  const std::vector<ElfW(Dyn)>& rows() const { return rows_; }
  std::uint64_t value(ElfW(Sxword) tag) const {
    for (const ElfW(Dyn) & row : rows_)
      if (row.d_tag == tag) return row.d_un.d_val;
    return 0;
  }
  /// Offset in the file of what the loader finds at the address that `tag` holds; past the end when there is none.
  std::uint64_t table(ElfW(Sxword) tag) const {
    const std::uint64_t address = value(tag);
    for (const ElfW(Phdr) & segment : segments_)
      if (address != 0 && segment.p_type == PT_LOAD && address >= segment.p_vaddr &&
          address - segment.p_vaddr < segment.p_filesz)
        return segment.p_offset + (address - segment.p_vaddr);
    return file_.size();
  }
  std::string text(std::uint64_t name) const {
    const std::uint64_t begin = table(DT_STRTAB);
    std::string out;
    if (begin >= file_.size() || name >= file_.size() - begin) return out;
    for (std::uint64_t i = begin + name; i < file_.size() && file_[i] != 0; ++i) out += static_cast<char>(file_[i]);
    return out;
  }
  /// The symbol table's length stands nowhere; it ends where the table of names begins in what every linker writes, and
  /// its hash tables know the number for certain.
  std::uint64_t symbols() const {
    const std::uint64_t most = file_.size() / sizeof(ElfW(Sym));
    if (const std::uint64_t hash = table(DT_HASH); hash < file_.size())
      return std::min<std::uint64_t>(at<std::uint32_t>(file_, hash + 4), most);
    const std::uint64_t hash = table(DT_GNU_HASH);
    if (hash >= file_.size())
      return std::min<std::uint64_t>((table(DT_STRTAB) - table(DT_SYMTAB)) / sizeof(ElfW(Sym)), most);
    const std::uint64_t buckets = at<std::uint32_t>(file_, hash), first = at<std::uint32_t>(file_, hash + 4),
                        words = at<std::uint32_t>(file_, hash + 8);
    const std::uint64_t bucket = hash + 16 + words * sizeof(ElfW(Addr)), chain = bucket + 4 * buckets;
    if (!within(bucket, 4 * buckets, file_.size())) return 0;
    std::uint64_t last = 0;
    for (std::uint64_t b = 0; b < buckets; ++b)
      last = std::max<std::uint64_t>(last, at<std::uint32_t>(file_, bucket + 4 * b));
    // No exported symbol at all: what there is are the undefined ones before `first`.
    if (last < first) return std::min<std::uint64_t>(std::max<std::uint64_t>(first, 1), most);
    while (last < most && within(chain + 4 * (last - first), 4, file_.size()) &&
           (at<std::uint32_t>(file_, chain + 4 * (last - first)) & 1) == 0)
      ++last;
    return std::min(last + 1, most);
  }

 private:
  Bytes file_;
  std::vector<ElfW(Phdr)> segments_;
  std::vector<ElfW(Dyn)> rows_;
};

void read_symbols(Bytes file, const Dynamic& dynamic, ElfFacts& facts) {
  const std::uint64_t table = dynamic.table(DT_SYMTAB), versions = dynamic.table(DT_VERSYM);
  for (std::uint64_t i = 1, count = dynamic.symbols(); i < count; ++i) {
    const auto symbol = at<ElfW(Sym)>(file, table + i * sizeof(ElfW(Sym)));
    const unsigned binding = ELF64_ST_BIND(symbol.st_info), visibility = ELF64_ST_VISIBILITY(symbol.st_other);
    if (symbol.st_shndx != SHN_UNDEF) {
      const bool open = visibility == STV_DEFAULT || visibility == STV_PROTECTED;
      if (binding != STB_LOCAL && open) facts.exported.push_back(dynamic.text(symbol.st_name));
    } else if (binding != STB_WEAK) {
      // A version names the library that a symbol comes from; all of libc, libm, libgcc and libstdc++ are versioned.
      const auto version = versions < file.size() ? at<std::uint16_t>(file, versions + 2 * i) & 0x7fff : VER_NDX_GLOBAL;
      if (version <= VER_NDX_GLOBAL) facts.unanswered.push_back(dynamic.text(symbol.st_name));
    }
  }
}

}  // namespace

std::string elf_problem(Bytes file) {
  const auto head = at<ElfW(Ehdr)>(file, 0);
  if (file.size() < sizeof head || std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0) return "it is not a shared library";
  const int word = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  if (head.e_ident[EI_CLASS] != word || head.e_type != ET_DYN || head.e_phentsize != sizeof(ElfW(Phdr)))
    return "it is not a shared library for this machine";
  if (!within(head.e_phoff, std::uint64_t{head.e_phnum} * sizeof(ElfW(Phdr)), file.size())) return "it is cut off";
  for (const ElfW(Phdr) & segment : segments_of(file))
    if (segment.p_type == PT_LOAD && !within(segment.p_offset, segment.p_filesz, file.size())) return "it is cut off";
  return {};
}

ElfFacts elf_facts(Bytes file) {
  ElfFacts facts;
  facts.executable_stack = true;
  for (const ElfW(Phdr) & segment : segments_of(file)) {
    if (segment.p_type == PT_GNU_STACK) facts.executable_stack = (segment.p_flags & PF_X) != 0;
    if (segment.p_type != PT_LOAD) continue;
    facts.writable_code = facts.writable_code || ((segment.p_flags & PF_W) != 0 && (segment.p_flags & PF_X) != 0);
    facts.image_bytes += segment.p_memsz;
  }
  const Dynamic dynamic(file);
  for (const ElfW(Dyn) & row : dynamic.rows()) {
    if (row.d_tag == DT_NEEDED) facts.needed.push_back(dynamic.text(row.d_un.d_val));
    if (row.d_tag == DT_RPATH || row.d_tag == DT_RUNPATH) facts.search.push_back(dynamic.text(row.d_un.d_val));
    if (row.d_tag == DT_TEXTREL || (row.d_tag == DT_FLAGS && (row.d_un.d_val & DF_TEXTREL) != 0))
      facts.writable_code = true;
  }
  read_symbols(file, dynamic, facts);
  for (auto* names : {&facts.exported, &facts.unanswered, &facts.needed, &facts.search})
    std::sort(names->begin(), names->end());
  return facts;
}

}  // namespace vitrine
