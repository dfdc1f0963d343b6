// SPDX-License-Identifier: GPL-3.0-or-later
// Photos at the extremes: what comes from a broken camera, a wrong crop or a wrong file.
#include <algorithm>
#include <cmath>

#include "extremes.hpp"
#include "noise.hpp"

namespace vitrine::bench {
namespace {

using support::GarmentKind;
using support::PhotoSpec;

PhotoSpec vest_spec() {
  PhotoSpec spec;
  spec.garment = GarmentKind::vest;
  return spec;
}

/// The picture at another size, each pixel the nearest one's.
Image resized(const Image& from, int width, int height) {
  Image to(width, height, from.channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      std::copy_n(from.at(x * from.width / width, y * from.height / height), from.channels, to.at(x, y));
  return to;
}

Image cropped(const Image& from, int left, int top, int width, int height) {
  Image to(width, height, from.channels);
  for (int y = 0; y < height; ++y) std::copy_n(from.at(left, top + y), width * from.channels, to.at(0, y));
  return to;
}

Image noise_picture(int width, int height) {
  Image picture(width, height, 3);
  for (std::size_t i = 0; i < picture.data.size(); ++i)
    picture.data[i] = static_cast<std::uint8_t>(support::hash(static_cast<std::int32_t>(i), 0, 5));
  return picture;
}

}  // namespace

void Extremes::photos(const Take& take) const {
  /// Both photos alike through the whole pipeline at draft quality; a mask may be given to the front.
  const auto convert = [this](const std::string& name, const Image& picture, const Image& mask) {
    ConvertRequest request;
    request.name = name;
    request.front = write_png(folder_, "extreme", picture);
    if (!mask.empty()) request.front_mask = write_png(folder_, "extreme-mask", mask);
    request.mirror_back = true;
    request.garment = vest_.garment;
    request.necklines = registry_.necklines();
    request.others = registry_.garments();
    request.quality = Quality::draft;
    request.body = woman_;
    const Conversion made = cut_and_sew(request);
    if (made.drape.positions.empty() && made.error) {
      Outcome refusal = outcome_of(*made.error);
      // The folder has another name in every run.
      for (std::size_t at; (at = refusal.note.find(folder_ + "/")) != std::string::npos;)
        refusal.note.erase(at, folder_.size() + 1);
      return refusal;
    }
    Outcome o = outcome_of(Result<Drape>(made.drape));
    for (const std::string& warning : made.warnings) o.note += (o.note.empty() ? "" : "; ") + warning.substr(0, 60);
    return o;
  };
  const auto plain = [&](const std::string& name, const std::function<Image()>& draw) {
    take("photo", name, [=] { return convert(name, draw(), {}); });
  };
  const auto made = [](const std::function<void(PhotoSpec&)>& change) {
    return [change] {
      PhotoSpec spec = vest_spec();
      change(spec);
      return support::make_photo(spec).rgb;
    };
  };
  plain("as it should be", made([](PhotoSpec&) {}));
  plain("64 x 64 px", [] { return resized(support::make_photo(vest_spec()).rgb, 64, 64); });
  plain("63 x 63 px", [] { return resized(support::make_photo(vest_spec()).rgb, 63, 63); });
  plain("24 megapixels", [] { return resized(support::make_photo(vest_spec()).rgb, 4432, 5416); });
  plain("90 megapixels", [] { return Image(9500, 9500, 3, 200); });
  plain("all black", [] { return Image(900, 1100, 3, 0); });
  plain("all white", [] { return Image(900, 1100, 3, 255); });
  plain("noise alone", [] { return noise_picture(600, 700); });
  plain("white on white", made([](PhotoSpec& s) {
          s.board = {250, 250, 250};
          s.colour = s.trim = {251, 251, 251};
          s.shadow = s.creases = 0;
        }));
  plain("black on black", made([](PhotoSpec& s) {
          s.board = {6, 6, 6};
          s.colour = s.trim = {5, 5, 5};
          s.shadow = s.creases = 0;
        }));
  plain("noise of 60 grey levels", made([](PhotoSpec& s) { s.noise = 60; }));
  plain("light falling off to nothing", made([](PhotoSpec& s) { s.falloff = 1; }));
  plain("garment of 3 % of the width", made([](PhotoSpec& s) { s.fill = 0.03; }));
  plain("garment cut by the border", [] {
    const Image whole = support::make_photo(vest_spec()).rgb;
    return cropped(whole, whole.width / 3, 0, whole.width / 2, whole.height);
  });
  plain("half of the garment below the border", [] {
    const Image whole = support::make_photo(vest_spec()).rgb;
    return cropped(whole, 0, 0, whole.width, whole.height / 2);
  });
  for (const int quarters : {1, 2, 3})
    plain("turned by " + std::to_string(90 * quarters) + " degrees",
          [quarters] { return turned(support::make_photo(vest_spec()).rgb, quarters); });
  plain("tilted by 45 degrees", made([](PhotoSpec& s) {
          s.tilt = 45;
          s.fill = 0.6;
        }));
  plain("twenty times as high as wide", [] { return resized(support::make_photo(vest_spec()).rgb, 100, 2000); });
  plain("twenty times as wide as high", [] { return resized(support::make_photo(vest_spec()).rgb, 2000, 100); });
  plain("another garment: trousers", made([](PhotoSpec& s) { s = support::random_spec(7, GarmentKind::trousers); }));
  const auto masked = [&](const std::string& name, const std::function<void(Image&)>& change) {
    take("mask", name, [=] {
      const auto photo = support::make_photo(vest_spec());
      Image mask = photo.labels;
      change(mask);
      return convert(name, photo.rgb, mask);
    });
  };
  masked("as it should be", [](Image&) {});
  masked("empty", [](Image& m) { std::fill(m.data.begin(), m.data.end(), std::uint8_t{0}); });
  masked("one pixel", [](Image& m) {
    std::fill(m.data.begin(), m.data.end(), std::uint8_t{0});
    *m.at(m.width / 2, m.height / 2) = label_outside;
  });
  masked("the whole picture", [](Image& m) { std::fill(m.data.begin(), m.data.end(), std::uint8_t{label_outside}); });
  masked("all inside of the back", [](Image& m) {
    for (auto& v : m.data) v = v ? std::uint8_t{label_inside} : std::uint8_t{0};
  });
  masked("huge holes", [](Image& m) {
    for (int y = 0; y < m.height; ++y)
      for (int x = 0; x < m.width; ++x)
        if (std::hypot(x - m.width * 0.4, y - m.height * 0.5) < 0.12 * m.width ||
            std::hypot(x - m.width * 0.6, y - m.height * 0.7) < 0.1 * m.width)
          *m.at(x, y) = 0;
  });
  masked("every other pixel", [](Image& m) {
    for (int y = 0; y < m.height; ++y)
      for (int x = (y & 1); x < m.width; x += 2) *m.at(x, y) = 0;
  });
  masked("two halves apart", [](Image& m) {
    for (int y = 0; y < m.height; ++y)
      for (int x = m.width * 48 / 100; x < m.width * 52 / 100; ++x) *m.at(x, y) = 0;
  });
  masked("of half the size", [](Image& m) { m = resized(m, m.width / 2, m.height / 2); });
  masked("noise", [](Image& m) {
    for (std::size_t i = 0; i < m.data.size(); ++i)
      m.data[i] = support::hash(static_cast<std::int32_t>(i), 1, 3) & 1 ? std::uint8_t{label_outside} : std::uint8_t{0};
  });
}

}  // namespace vitrine::bench
