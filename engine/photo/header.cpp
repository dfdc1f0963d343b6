// SPDX-License-Identifier: GPL-3.0-or-later
#include "header.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace vitrine {
namespace {

/// A view that reads 0 past its end, so that no offset in a hostile file can leave the buffer.
struct Bytes {
  std::span<const std::uint8_t> s;
  std::uint64_t size() const { return s.size(); }
  std::uint32_t u8(std::uint64_t i) const { return i < s.size() ? s[i] : 0u; }
  std::uint32_t be16(std::uint64_t i) const { return u8(i) << 8 | u8(i + 1); }
  std::uint32_t be32(std::uint64_t i) const { return be16(i) << 16 | be16(i + 2); }
  std::uint32_t le16(std::uint64_t i) const { return u8(i) | u8(i + 1) << 8; }
  std::uint32_t le24(std::uint64_t i) const { return le16(i) | u8(i + 2) << 16; }
  std::uint32_t le32(std::uint64_t i) const { return le16(i) | le16(i + 2) << 16; }
  bool starts(std::uint64_t i, const char* text) const {
    const std::uint64_t n = std::strlen(text);
    return i <= size() && n <= size() - i && std::memcmp(s.data() + i, text, n) == 0;
  }
};

/// The first directory of a TIFF stream, which is also what an EXIF block holds.
struct TiffTags {
  std::uint64_t width = 0, height = 0;
  int orientation = 1;
  bool ok = false;
  bool truncated = false;
};

TiffTags read_tiff(Bytes b) {
  TiffTags t;
  const bool little = b.starts(0, "II");
  if (!little && !b.starts(0, "MM")) return t;
  const auto u16 = [&](std::uint64_t i) { return little ? b.le16(i) : b.be16(i); };
  const auto u32 = [&](std::uint64_t i) { return little ? b.le32(i) : b.be32(i); };
  if (u16(2) != 42) return t;
  const std::uint64_t dir = u32(4);
  if (dir < 8 || dir + 2 > b.size()) {
    t.truncated = true;
    return t;
  }
  const std::uint64_t count = u16(dir);
  if (dir + 2 + 12 * count > b.size()) t.truncated = true;
  std::uint64_t offsets_at = 0, bytes_at = 0, strips = 0;
  std::uint32_t offsets_type = 0, bytes_type = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::uint64_t e = dir + 2 + 12 * k;
    if (e + 12 > b.size()) break;
    const std::uint32_t tag = u16(e), type = u16(e + 2);
    const std::uint64_t n = u32(e + 4);
    const std::uint64_t value = type == 3 ? u16(e + 8) : u32(e + 8);
    const std::uint64_t at = n * (type == 3 ? 2 : 4) <= 4 ? e + 8 : u32(e + 8);
    if (tag == 256) t.width = value;
    if (tag == 257) t.height = value;
    if (tag == 274 && value >= 1 && value <= 8) t.orientation = static_cast<int>(value);
    if (tag == 273 || tag == 324) offsets_at = at, offsets_type = type, strips = n;
    if (tag == 279 || tag == 325) bytes_at = at, bytes_type = type;
  }
  const auto item = [&](std::uint64_t at, std::uint32_t type, std::uint64_t k) -> std::uint64_t {
    return type == 3 ? u16(at + 2 * k) : u32(at + 4 * k);
  };
  if (offsets_at && bytes_at) {
    strips = std::min<std::uint64_t>(strips, b.size());
    for (std::uint64_t k = 0; k < strips && !t.truncated; ++k)
      t.truncated = item(offsets_at, offsets_type, k) + item(bytes_at, bytes_type, k) > b.size();
  }
  t.ok = t.width > 0 && t.height > 0;
  return t;
}

int exif_orientation(Bytes b) {
  return read_tiff(b).orientation;
}

void read_jpeg(Bytes b, PhotoHeader& h) {
  std::uint64_t i = 2;
  h.truncated = true;  // until the end mark is met
  while (i + 1 < b.size()) {
    if (b.u8(i) != 0xFF) {  // bytes between segments: decoders skip them too
      ++i;
      continue;
    }
    const std::uint32_t marker = b.u8(i + 1);
    if (marker == 0xFF) {
      ++i;
      continue;
    }
    if (marker == 0xD9) {
      h.truncated = false;
      return;
    }
    // Stuffed bytes and restart marks are part of the pixel data.
    if (marker == 0x00 || marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8)) {
      i += 2;
      continue;
    }
    const std::uint64_t length = b.be16(i + 2);
    if (length < 2) return;
    const bool frame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (frame && i + 9 <= b.size() && !h.valid) {
      h.height = b.be16(i + 5);
      h.width = b.be16(i + 7);
      h.valid = h.width > 0 && h.height > 0;
    }
    if (marker == 0xE1 && b.starts(i + 4, "Exif") && i + 10 < b.size()) {
      const std::uint64_t end = std::min<std::uint64_t>(i + 2 + length, b.size());
      if (end > i + 10) h.orientation = exif_orientation({b.s.subspan(i + 10, end - (i + 10))});
    }
    i += 2 + length;
  }
}

void read_png(Bytes b, PhotoHeader& h) {
  if (b.size() < 33 || !b.starts(12, "IHDR")) {
    h.truncated = b.size() < 33;
    return;
  }
  h.width = b.be32(16);
  h.height = b.be32(20);
  h.valid = h.width > 0 && h.height > 0;
  h.truncated = true;
  for (std::uint64_t i = 8; i + 12 <= b.size();) {
    const std::uint64_t length = b.be32(i);
    if (i + 12 + length > b.size()) return;
    if (b.starts(i + 4, "eXIf")) h.orientation = exif_orientation({b.s.subspan(i + 8, length)});
    if (b.starts(i + 4, "IEND")) {
      h.truncated = false;
      return;
    }
    i += 12 + length;
  }
}

void read_webp(Bytes b, PhotoHeader& h) {
  h.truncated = b.size() < 30 || 8 + static_cast<std::uint64_t>(b.le32(4)) > b.size();
  for (std::uint64_t i = 12; i + 8 <= b.size();) {
    const std::uint64_t length = b.le32(i + 4), data = i + 8;
    if (b.starts(i, "VP8X")) {
      h.width = b.le24(data + 4) + 1;
      h.height = b.le24(data + 7) + 1;
    } else if (b.starts(i, "VP8L") && h.width == 0) {
      const std::uint32_t bits = b.le32(data + 1);
      h.width = (bits & 0x3FFF) + 1;
      h.height = (bits >> 14 & 0x3FFF) + 1;
    } else if (b.starts(i, "VP8 ") && h.width == 0) {
      h.width = b.le16(data + 6) & 0x3FFF;
      h.height = b.le16(data + 8) & 0x3FFF;
    } else if (b.starts(i, "EXIF") && data + length <= b.size()) {
      const std::uint64_t skip = b.starts(data, "Exif") ? 6 : 0;
      if (length > skip) h.orientation = exif_orientation({b.s.subspan(data + skip, length - skip)});
    }
    i = data + length + (length & 1);
  }
  h.valid = h.width > 0 && h.height > 0;
}

void read_bmp(Bytes b, PhotoHeader& h) {
  const std::uint64_t info = b.le32(14);
  if (info == 12) {
    h.width = b.le16(18);
    h.height = b.le16(20);
  } else {
    const auto magnitude = [](std::uint32_t v) {  // a negative height means rows stand top to bottom
      return static_cast<std::uint64_t>(std::llabs(static_cast<long long>(static_cast<std::int32_t>(v))));
    };
    h.width = magnitude(b.le32(18));
    h.height = magnitude(b.le32(22));
    const std::uint64_t bits = b.le16(28);
    const bool raw = b.le32(30) == 0 || b.le32(30) == 3;
    const std::uint64_t row = (h.width * bits + 31) / 32 * 4;
    h.truncated = raw && b.le32(10) + row * h.height > b.size();
  }
  h.truncated = h.truncated || b.size() < 26;
  h.valid = h.width > 0 && h.height > 0;
}

}  // namespace

PhotoHeader read_header(std::span<const std::uint8_t> file) {
  const Bytes b{file};
  PhotoHeader h;
  if (b.starts(0, "\xFF\xD8\xFF")) {
    h.kind = PhotoHeader::Kind::jpeg;
    read_jpeg(b, h);
  } else if (b.starts(0, "\x89PNG\r\n\x1a\n")) {
    h.kind = PhotoHeader::Kind::png;
    read_png(b, h);
  } else if (b.starts(0, "RIFF") && b.starts(8, "WEBP")) {
    h.kind = PhotoHeader::Kind::webp;
    read_webp(b, h);
  } else if (b.starts(0, "BM") && b.size() >= 18) {
    h.kind = PhotoHeader::Kind::bmp;
    read_bmp(b, h);
  } else if (b.starts(0, "II*") || (b.starts(0, "MM") && b.be16(2) == 42)) {
    h.kind = PhotoHeader::Kind::tiff;
    const TiffTags t = read_tiff(b);
    h.width = t.width;
    h.height = t.height;
    h.orientation = t.orientation;
    h.valid = t.ok;
    h.truncated = t.truncated;
  }
  return h;
}

}  // namespace vitrine
