// SPDX-License-Identifier: GPL-3.0-or-later
// The rooms after the cloth has come to rest: texture, export, preview.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "digest.hpp"
#include "rooms.hpp"

namespace vitrine {
namespace {

constexpr int kWebpQuality = 86, kJpegQuality = 90;

/// The box of the body, which sets up every picture's camera and scale.
SubjectBox box_of(const TriMesh& mesh) {
  SubjectBox box{Vec3::Constant(1e30), Vec3::Constant(-1e30)};
  for (const Vec3& p : mesh.vertices) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

Result<Bytes> encode_picture(const Image& image, PictureFormat format) {
  switch (format) {
    case PictureFormat::jpeg:
      return encode_jpeg(image, kJpegQuality);
    case PictureFormat::png:
      return encode_png(image);
    case PictureFormat::webp:
      break;
  }
  return encode_webp(image, kWebpQuality);
}

const char* ending(PictureFormat format) {
  return format == PictureFormat::jpeg ? ".jpg" : format == PictureFormat::png ? ".png" : ".webp";
}

/// Flat measurements of the front panel [mm], as the scale rule names them.
nlohmann::json flat_measurements(const GarmentTemplate& garment, const Panel& front) {
  const ScaleRule& rule = garment.scale;
  const auto at = [&](int feature) { return front.outline.at(front.corner.at(feature)); };
  const auto mm = [](double metres) { return std::round(metres * 1e4) / 10; };
  return {{"width", mm((at(rule.feature_a) - at(rule.feature_b)).norm())},
          {"length", mm(std::abs(at(rule.top).y() - at(rule.bottom).y()))}};
}

}  // namespace

Rooms::Step Rooms::texture() {
  TextureSource front{&item_.front.photo.rgb, &item_.front.features.labels, &item_.pattern.panels[0],
                      &item_.pattern.meshes[0]};
  TextureSource back{&item_.back.photo.rgb, &item_.back.features.labels, &item_.pattern.panels[1],
                     &item_.pattern.meshes[1]};
  if (request_.mirror_back) {
    back.borrowed = true;
    // The back's outline runs over what is the inside in the front's photo, the texture must not.
    const Image& labels = item_.front.features.labels;
    if (labels.width == back.rgb->width && labels.height == back.rgb->height) back.labels = &labels;
  }
  const TextureSource sources[] = {front, back};
  auto atlas = make_atlas(sources, request_.texture);
  if (!atlas) return atlas.error();
  item_.texture = atlas->panels;
  if (item_.texture.back().print_share > 0) item_.warnings.push_back("PRINT_TAKEN_OFF_BACK");
  item_.garment = assemble_garment(item_.pattern, item_.drape.positions, item_.drape.welded, *std::move(atlas));
  item_.garment.name = portable_name("garment", request_.name == "garment" ? "" : request_.name);
  item_.mannequin = assemble_mannequin(request_.body->mannequin.mesh);
  return bake_occlusion(item_.garment, item_.mannequin);
}

Rooms::Step Rooms::write_glb() {
  GlbOptions options;
  options.generator = "Vitrine" + (request_.version.empty() ? "" : " " + request_.version);
  options.copyright = request_.copyright;
  nlohmann::json extras{{"sku", request_.name},
                        {"garment", request_.garment.id},
                        {"status", item_.drape.status},
                        {"flat_mm", flat_measurements(request_.garment, item_.pattern.panels[0])},
                        {"mannequin", request_.body->mannequin.source},
                        {"mannequin_sha256", hash_of(request_.body->mannequin.mesh)},
                        {"report_sha256", report_hash(request_, item_)}};
  for (const auto& [name, girth] : request_.body->mannequin.girths)
    extras["mannequin_mm"][name] = std::round(girth * 1e4) / 10;
  options.extras_json = extras.dump();
  const RenderMesh both[] = {item_.garment, item_.mannequin};
  std::vector<GlbPictures> pictures;
  if (auto e = keep(encode_pictures(both, options), pictures)) return e;
  if (auto e = keep(encode_glb(std::span(both, 1), pictures, options), item_.garment_glb)) return e;
  if (auto e = keep(encode_glb(both, pictures, options), item_.dressed_glb)) return e;
  if (!request_.compress) return std::nullopt;
  if (auto e = keep(compress_glb(item_.garment_glb), item_.garment_page)) return e;
  return keep(compress_glb(item_.dressed_glb), item_.dressed_page);
}

Rooms::Step Rooms::check_for_shops() {
  const SubjectBox body = box_of(request_.body->mannequin.mesh);
  const CommerceScale scale{body.low, body.high};
  CommerceMemory memory;  // both files hold the garment
  if (auto e = keep(check_commerce(item_.garment_glb, scale, &memory), item_.garment_check)) return e;
  return keep(check_commerce(item_.dressed_glb, scale, &memory), item_.dressed_check);
}

Rooms::Step Rooms::take_pictures() {
  const RenderMesh both[] = {item_.garment, item_.mannequin};
  PreviewOptions options;
  options.subject = box_of(request_.body->mannequin.mesh);
  Image picture;
  if (auto e = keep(render_preview(both, options), picture)) return e;
  if (auto e = keep(encode_png(picture), item_.preview_png)) return e;
  if (request_.thumbnail)
    if (auto e = keep(thumbnail_of(picture), item_.thumbnail)) return e;

  const PictureRequest& wanted = request_.pictures;
  const auto take = [&](const std::string& name, const PreviewOptions& o) -> Step {
    if (auto e = keep(render_preview(both, o), picture)) return e;
    Bytes bytes;
    if (auto e = keep(encode_picture(picture, wanted.format), bytes)) return e;
    item_.pictures.push_back({name + ending(wanted.format), std::move(bytes)});
    return std::nullopt;
  };
  options.ground = wanted.ground;
  options.view_width = wanted.width;
  options.view_height = wanted.height;
  for (const std::string& view : wanted.views) {
    PreviewOptions o = options;
    o.turns_deg = {view == "back" ? 180.0 : view == "front" ? 0.0 : view == "detail" ? 18.0 : 35.0};
    if (view == "detail") {
      const auto frame = detail_frame(item_.garment);
      o.frame_bottom = frame[0];
      o.frame_top = frame[1];
    }
    if (auto e = take(view, o)) return e;
  }
  if (wanted.turntable > 0) {
    options.turns_deg = turntable(wanted.turntable);
    options.view_width = wanted.width / 2;
    options.view_height = wanted.height / 2;
    if (auto e = take("turntable", options)) return e;
  }
  return std::nullopt;
}

}  // namespace vitrine
