// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures.hpp"

#include <opencv2/imgproc.hpp>

#include "vitrine/export.hpp"
#include "vitrine/photo.hpp"

namespace vitrine::showroom {

std::optional<Error> write_poster(const std::filesystem::path& preview, const std::filesystem::path& out, int width,
                                  int quality) {
  const auto picture = load_photo(preview.string(), "");
  if (!picture) return picture.error();
  const Image& all = picture->rgb;
  // A preview is three views side by side, each 2 wide to 3 high; the page shows 3 to 4, so a ninth of the height goes,
  // most of it below the feet.
  const int view = all.width == 2 * all.height ? all.width / 3 : all.width;
  const int high = std::min(all.height, view * 4 / 3), top = (all.height - high) / 3;
  const cv::Mat whole(all.height, all.width, CV_8UC3, const_cast<std::uint8_t*>(all.data.data()));
  Image small(width, width * high / view, 3);
  cv::Mat target(small.height, small.width, CV_8UC3, small.data.data());
  cv::resize(whole(cv::Rect(0, top, view, high)), target, target.size(), 0, 0,
             width < view ? cv::INTER_AREA : cv::INTER_CUBIC);
  const auto bytes = encode_webp(small, quality);
  if (!bytes) return bytes.error();
  return write_file(out.string(), *bytes);
}

std::optional<Error> write_photo(const std::filesystem::path& photo, const std::filesystem::path& out) {
  PhotoOptions options;
  options.max_side = 1200;
  const auto picture = load_photo(photo.string(), "", options);
  if (!picture) return picture.error();
  const auto bytes = encode_jpeg(picture->rgb, 82);
  if (!bytes) return bytes.error();
  return write_file(out.string(), *bytes);
}

}  // namespace vitrine::showroom
