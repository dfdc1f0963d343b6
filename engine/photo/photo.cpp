// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/photo.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>

#include "header.hpp"

namespace vitrine {
namespace {

Error unusable(std::string code, std::string message, std::string remedy) {
  return {Cause::unusable, std::move(code), std::move(message), std::move(remedy), "photo"};
}

std::string size_text(std::uint64_t w, std::uint64_t h) {
  return std::to_string(w) + " x " + std::to_string(h);
}

Result<std::vector<std::uint8_t>> read_file(const std::string& path, const PhotoOptions& options) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    return Error{Cause::missing, "MISSING_FILE", path + ": there is no such file.",
                 "Check the file name and that the file was copied completely.", "photo"};
  if (!std::filesystem::is_regular_file(path, error))
    return Error{Cause::missing, "MISSING_FILE", path + ": this is a folder or a device, not a picture file.",
                 "Name the picture file itself.", "photo"};
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : -1;
  if (size < 0)
    return Error{Cause::missing, "MISSING_FILE", path + ": the file cannot be read.",
                 "Check that you may read this file.", "photo"};
  if (static_cast<std::uint64_t>(size) > options.max_bytes)
    return unusable("TOO_LARGE",
                    path + ": the file has " + std::to_string(size) + " bytes; the limit is " +
                        std::to_string(options.max_bytes) + ".",
                    "Save the photo as a JPEG of a few thousand pixels a side.");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  in.seekg(0);
  if (size > 0 && !in.read(reinterpret_cast<char*>(bytes.data()), size))
    return Error{Cause::missing, "MISSING_FILE", path + ": the file cannot be read to its end.",
                 "Copy the file again; the disk or the network dropped it.", "photo"};
  return bytes;
}

/// EXIF 2.3, tag 0x0112: which way the stored rows and columns run.
void orient(cv::Mat& m, int orientation) {
  if (orientation >= 5) cv::transpose(m, m);
  switch (orientation) {
    case 2:
    case 6:
      cv::flip(m, m, 1);
      break;
    case 3:
    case 7:
      cv::flip(m, m, -1);
      break;
    case 4:
    case 8:
      cv::flip(m, m, 0);
      break;
    default:
      break;
  }
}

Result<cv::Mat> decode(const std::string& path, const PhotoOptions& options) {
  Result<std::vector<std::uint8_t>> bytes = read_file(path, options);
  if (!bytes) return bytes.error();
  const PhotoHeader header = read_header(*bytes);
  const std::string again = "Export the photo again as JPEG or PNG.";
  if (bytes->empty()) return unusable("NOT_AN_IMAGE", path + ": the file is empty.", "Copy the photo again.");
  if (header.kind == PhotoHeader::Kind::unknown)
    return unusable("NOT_AN_IMAGE", path + ": this is not a JPEG, PNG, WebP, TIFF or BMP picture.", again);
  // The declared size comes first: nothing of an oversized picture is ever decoded.
  if (header.valid) {
    if (header.width > options.max_pixels || header.height > options.max_pixels ||
        header.width * header.height > options.max_pixels)
      return unusable("TOO_LARGE",
                      path + ": the picture is " + size_text(header.width, header.height) + " px; the limit is " +
                          std::to_string(options.max_pixels) + " px in all.",
                      "Reduce the photo to a few thousand pixels a side.");
  }
  if (header.truncated)
    return unusable("TRUNCATED", path + ": the file stops before the picture is complete.",
                    "Copy or upload the photo again; this copy was cut off.");
  if (!header.valid)
    return unusable("NOT_AN_IMAGE", path + ": the picture's header is damaged, it states no size.", again);
  if (header.width < static_cast<std::uint64_t>(options.min_side) ||
      header.height < static_cast<std::uint64_t>(options.min_side))
    return unusable("TOO_SMALL",
                    path + ": the picture is " + size_text(header.width, header.height) +
                        " px; each side needs at least " + std::to_string(options.min_side) + " px.",
                    "Use the photo as it came from the camera, not a thumbnail.");
  cv::Mat m;
  try {
    m = cv::imdecode(*bytes, cv::IMREAD_UNCHANGED | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const std::exception&) {
    m.release();
  }
  if (m.empty())
    return unusable("NOT_AN_IMAGE", path + ": the picture's contents are damaged and cannot be decoded.", again);
  if (static_cast<std::uint64_t>(m.cols) != header.width || static_cast<std::uint64_t>(m.rows) != header.height)
    return unusable("NOT_AN_IMAGE", path + ": the picture's contents do not have the size its header states.", again);
  if (m.depth() == CV_16U) m.convertTo(m, CV_8U, 1.0 / 257.0);
  if (m.depth() != CV_8U)
    return unusable("NOT_AN_IMAGE", path + ": pictures with floating-point pixels are not supported.",
                    "Export the photo with 8 or 16 bits per colour.");
  orient(m, header.orientation);
  return m;
}

Image to_image(const cv::Mat& m) {
  Image image(m.cols, m.rows, m.channels());
  const std::size_t row = static_cast<std::size_t>(m.cols) * m.channels();
  for (int y = 0; y < m.rows; ++y) std::memcpy(image.data.data() + y * row, m.ptr(y), row);
  return image;
}

/// Splits a decoded picture into RGB and, where it is not opaque everywhere, alpha.
bool split_channels(const cv::Mat& m, cv::Mat& rgb, cv::Mat& alpha) {
  switch (m.channels()) {
    case 1:
      cv::cvtColor(m, rgb, cv::COLOR_GRAY2RGB);
      return true;
    case 3:
      cv::cvtColor(m, rgb, cv::COLOR_BGR2RGB);
      return true;
    case 2:
    case 4: {
      cv::extractChannel(m, alpha, m.channels() - 1);
      if (m.channels() == 4) {
        cv::cvtColor(m, rgb, cv::COLOR_BGRA2RGB);
      } else {
        cv::Mat grey;
        cv::extractChannel(m, grey, 0);
        cv::cvtColor(grey, rgb, cv::COLOR_GRAY2RGB);
      }
      double least = 0;
      cv::minMaxLoc(alpha, &least);
      if (least >= 255) alpha.release();
      return true;
    }
    default:
      return false;
  }
}

/// Area-averaged reduction. Colours are weighted by alpha, so that what lies under transparent pixels (black, in most
/// exports) does not darken the garment's rim.
void reduce(cv::Mat& rgb, cv::Mat& alpha, cv::Size to) {
  if (alpha.empty()) {
    cv::resize(rgb, rgb, to, 0, 0, cv::INTER_AREA);
    return;
  }
  cv::Mat weight, wide, colour, small_weight;
  alpha.convertTo(weight, CV_32F, 1.0 / 255.0, 1e-4);
  cv::merge(std::vector<cv::Mat>{weight, weight, weight}, wide);
  rgb.convertTo(colour, CV_32FC3);
  cv::multiply(colour, wide, colour);
  cv::resize(colour, colour, to, 0, 0, cv::INTER_AREA);
  cv::resize(wide, small_weight, to, 0, 0, cv::INTER_AREA);
  cv::divide(colour, small_weight, colour);
  colour.convertTo(rgb, CV_8UC3);
  cv::resize(alpha, alpha, to, 0, 0, cv::INTER_AREA);
}

/// Reduction of labels by majority: first garment or not, then which side of it.
void reduce_labels(cv::Mat& labels, cv::Size to) {
  cv::Mat garment, inside;
  cv::resize(labels > 0, garment, to, 0, 0, cv::INTER_AREA);
  cv::resize(labels == label_inside, inside, to, 0, 0, cv::INTER_AREA);
  labels.create(to, CV_8U);
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x) {
      const int g = garment.at<std::uint8_t>(y, x), i = inside.at<std::uint8_t>(y, x);
      labels.at<std::uint8_t>(y, x) = g < 128 ? label_background : 2 * i >= g ? label_inside : label_outside;
    }
}

Result<cv::Mat> load_mask(const std::string& mask_path, const std::string& path, cv::Size size,
                          const PhotoOptions& options) {
  Result<cv::Mat> decoded = decode(mask_path, options);
  if (!decoded) return decoded.error();
  if (decoded->size() != size)
    return unusable("MASK_SIZE",
                    mask_path + ": the mask is " + size_text(decoded->cols, decoded->rows) + " px, but the photo " +
                        path + " shows " + size_text(size.width, size.height) + " px.",
                    "Draw the mask on the photo itself, upright as it is displayed, without cropping or scaling.");
  cv::Mat rgb, alpha, grey, labels(size, CV_8U);
  if (!split_channels(*decoded, rgb, alpha))
    return unusable("NOT_AN_IMAGE", mask_path + ": the mask has an unknown kind of pixels.",
                    "Save the mask as an 8-bit grey PNG.");
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  // A mask that went through a JPEG or a resize has values in between: the nearest of the three labels counts.
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const int v = grey.at<std::uint8_t>(y, x);
      labels.at<std::uint8_t>(y, x) = v < 64 ? label_background : v < 192 ? label_inside : label_outside;
    }
  if (cv::countNonZero(labels == label_outside) == 0)
    return unusable("EMPTY_MASK", mask_path + ": no pixel of the mask is marked as garment.",
                    "Paint the garment white (255), the inside of its back grey (128) and the rest black (0).");
  return labels;
}

Result<Photo> load(const std::string& path, const std::string& mask_path, const PhotoOptions& options) {
  Result<cv::Mat> decoded = decode(path, options);
  if (!decoded) return decoded.error();
  Photo photo;
  photo.path = path;
  photo.source_width = decoded->cols;
  photo.source_height = decoded->rows;
  photo.mirrored = options.mirror;
  cv::Mat rgb, alpha, mask;
  if (!split_channels(*decoded, rgb, alpha))
    return unusable("NOT_AN_IMAGE", path + ": the picture has an unknown kind of pixels.",
                    "Export the photo again as JPEG or PNG.");
  decoded->release();
  if (!mask_path.empty()) {
    Result<cv::Mat> labels = load_mask(mask_path, path, rgb.size(), options);
    if (!labels) return labels.error();
    mask = *labels;
  }
  const int longest = std::max(rgb.cols, rgb.rows);
  if (options.max_side > 0 && longest > options.max_side) {
    photo.scale = static_cast<double>(options.max_side) / longest;
    const cv::Size to(std::max(1, static_cast<int>(std::lround(rgb.cols * photo.scale))),
                      std::max(1, static_cast<int>(std::lround(rgb.rows * photo.scale))));
    if (!mask.empty()) reduce_labels(mask, to);
    reduce(rgb, alpha, to);
  }
  if (options.mirror) {
    cv::flip(rgb, rgb, 1);
    if (!alpha.empty()) cv::flip(alpha, alpha, 1);
    if (!mask.empty()) cv::flip(mask, mask, 1);
  }
  photo.rgb = to_image(rgb);
  if (!alpha.empty()) photo.alpha = to_image(alpha);
  if (!mask.empty()) photo.mask = to_image(mask);
  return photo;
}

}  // namespace

Result<Photo> load_photo(const std::string& path, const std::string& mask_path, const PhotoOptions& options) {
  try {
    cv::setNumThreads(1);  // the host forks workers; a thread pool would not survive it
    return load(path, mask_path, options);
  } catch (const std::exception& e) {
    return Error{Cause::internal, "PHOTO_FAILED", path + ": the photo could not be prepared (" + e.what() + ").",
                 "Reduce the photo's size and try again.", "photo"};
  }
}

}  // namespace vitrine
