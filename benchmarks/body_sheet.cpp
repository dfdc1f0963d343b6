// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "body_people.hpp"
#include "vitrine/export.hpp"
#include "vitrine/preview.hpp"
#include "vitrine/texture.hpp"

namespace vitrine::bench {

std::optional<Error> draw_sheet(const std::string& path) {
  const char* names[] = {"woman-xs", "woman-m", "woman-xxl", "man-m", "man-l"};
  const PreviewOptions options{.turns_deg = {0, 90, 180}, .view_width = 270, .view_height = 405};
  constexpr int columns = 2;
  const int wide = 3 * options.view_width, rows = (static_cast<int>(std::size(names)) + columns - 1) / columns;
  Image sheet(columns * wide, rows * options.view_height, 3);
  std::fill(sheet.data.begin(), sheet.data.end(), std::uint8_t{222});
  for (std::size_t i = 0; i < std::size(names); ++i) {
    const auto m = preset_measurements(names[i]);
    if (!m) return m.error();
    const auto body = build_mannequin(*m);
    if (!body) return body.error();
    const RenderMesh mesh = assemble_mannequin(body->mesh);
    const auto picture = render_preview(std::span(&mesh, 1), options);
    if (!picture) return picture.error();
    const int left = static_cast<int>(i) % columns * wide, top = static_cast<int>(i) / columns * options.view_height;
    for (int y = 0; y < picture->height; ++y)
      std::copy_n(&picture->data[static_cast<std::size_t>(y) * wide * 3], wide * 3, sheet.at(left, top + y));
  }
  const auto jpeg = encode_jpeg(sheet, 90);
  if (!jpeg) return jpeg.error();
  return write_file(path, *jpeg);
}

}  // namespace vitrine::bench
