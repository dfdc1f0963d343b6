// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>

#include "vitrine/pipeline.hpp"

namespace vitrine {

std::optional<Error> write_conversion(const ConvertRequest& request, const Conversion& item,
                                      const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed || !fs::is_directory(folder, failed))
    return Error{Cause::unwritable, "CANNOT_WRITE",
                 folder + ": the output folder cannot be made" + (failed ? " (" + failed.message() + ")" : ""),
                 "name a folder that you may write to with --out", "export"};
  const std::string base = folder + "/";
  // A refusal must not leave the pictures of an earlier, accepted run beside its report.
  for (const char* name : {"garment.glb", "dressed.glb", "preview.png", "garment-page.glb", "dressed-page.glb"})
    if (item.garment_glb.empty()) fs::remove(base + name, failed);

  if (request.debug_images) {
    const auto picture = [&](const Image& image, const std::string& name) -> std::optional<Error> {
      if (image.empty()) return std::nullopt;
      auto png = encode_png(image);
      if (!png) return png.error();
      return write_file(base + name, *png);
    };
    if (auto e = picture(draw_view(view_of(request, Side::front), item.front), "debug-front.png")) return e;
    if (auto e = picture(draw_view(view_of(request, Side::back), item.back), "debug-back.png")) return e;
    for (std::size_t i = 0; i < item.pattern.meshes.size(); ++i)
      if (auto e = picture(draw_mesh(item.pattern.meshes[i]), i == 0 ? "debug-mesh-front.png" : "debug-mesh-back.png"))
        return e;
  }
  if (!item.garment_glb.empty()) {
    if (auto e = write_file(base + "garment.glb", item.garment_glb)) return e;
    if (auto e = write_file(base + "dressed.glb", item.dressed_glb)) return e;
    if (auto e = write_file(base + "preview.png", item.preview_png)) return e;
    if (!item.garment_page.empty()) {
      if (auto e = write_file(base + "garment-page.glb", item.garment_page)) return e;
      if (auto e = write_file(base + "dressed-page.glb", item.dressed_page)) return e;
    }
    if (!item.thumbnail.empty())
      if (auto e = write_file(base + "thumb.jpg", item.thumbnail)) return e;
    for (const NamedFile& picture : item.pictures)
      if (auto e = write_file(base + picture.name, picture.bytes)) return e;
    for (const MeshFormat format : request.formats)
      if (auto e = write_meshes(std::span(&item.garment, 1), format, folder, "garment")) return e;
  }
  // Last, so that a report beside the files means that they are all there.
  return write_file(base + "report.json", report_json(request, item));
}

}  // namespace vitrine
