// SPDX-License-Identifier: GPL-3.0-or-later
#include <exception>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "vitrine/export.hpp"

namespace vitrine {
namespace {

Error bad_image(const std::string& message) {
  return {Cause::internal, "BAD_IMAGE", message, "Report this with the input that caused it.", "export"};
}

Result<Bytes> encode(const Image& image, const char* extension, const std::vector<int>& parameters) {
  const bool channels = image.channels == 1 || image.channels == 3 || image.channels == 4;
  if (!channels || image.width <= 0 || image.height <= 0 || image.width > 65'500 || image.height > 65'500 ||
      image.data.size() != static_cast<std::size_t>(image.width) * image.height * image.channels)
    return bad_image("A picture to be written is not whole.");
  try {
    // OpenCV's own order is BGR.
    const cv::Mat view(image.height, image.width, CV_8UC(image.channels), const_cast<std::uint8_t*>(image.data.data()));
    cv::Mat turned;  // of its own: sharing the view's memory would turn the caller's picture as well
    if (image.channels == 1) turned = view;
    if (image.channels == 3) cv::cvtColor(view, turned, cv::COLOR_RGB2BGR);
    if (image.channels == 4) cv::cvtColor(view, turned, cv::COLOR_RGBA2BGRA);
    Bytes bytes;
    if (!cv::imencode(extension, turned, bytes, parameters)) return bad_image("A picture could not be encoded.");
    return bytes;
  } catch (const std::exception& e) {
    return bad_image(std::string("A picture could not be encoded: ") + e.what());
  }
}

}  // namespace

Result<Bytes> encode_png(const Image& image) {
  // Runs are all that there is to find in lit pictures and masks: the full search takes twice as long for 1 % less.
  return encode(image, ".png",
                {cv::IMWRITE_PNG_COMPRESSION, 6, cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_RLE});
}

Result<Bytes> encode_jpeg(const Image& image, int quality) {
  if (quality < 1 || quality > 100)
    return Error{Cause::usage, "BAD_QUALITY", "JPEG quality " + std::to_string(quality) + " is out of range.",
                 "Use 1 to 100.", "export"};
  if (image.channels == 4) return bad_image("A JPEG has no alpha channel.");
  return encode(image, ".jpg", {cv::IMWRITE_JPEG_QUALITY, quality, cv::IMWRITE_JPEG_OPTIMIZE, 1});
}

Result<Bytes> encode_webp(const Image& image, int quality) {
  if (quality < 1 || quality > 100)
    return Error{Cause::usage, "BAD_QUALITY", "WebP quality " + std::to_string(quality) + " is out of range.",
                 "Use 1 to 100.", "export"};
  if (image.width > 16'383 || image.height > 16'383)
    return Error{Cause::usage, "PICTURE_TOO_LARGE", "A WebP picture has at most 16,383 pixels on a side.",
                 "Ask for fewer or smaller views, or for PNG.", "export"};
  return encode(image, ".webp", {cv::IMWRITE_WEBP_QUALITY, quality});
}

}  // namespace vitrine
