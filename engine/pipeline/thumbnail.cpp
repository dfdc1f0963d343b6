// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "vitrine/pipeline.hpp"

namespace vitrine {

Result<Bytes> thumbnail_of(const Image& picture) {
  constexpr double most_width = 320, most_height = 220;
  constexpr int quality = 80;
  if (picture.empty())
    return Error{Cause::internal, "NO_PICTURE", "there is no picture to make smaller", "", "preview"};
  const double scale = std::min({1.0, most_width / picture.width, most_height / picture.height});
  Image small(std::max(1, static_cast<int>(std::lround(picture.width * scale))),
              std::max(1, static_cast<int>(std::lround(picture.height * scale))), picture.channels, 0);
  const cv::Mat from(picture.height, picture.width, CV_8UC(picture.channels),
                     const_cast<std::uint8_t*>(picture.data.data()));
  cv::Mat to(small.height, small.width, CV_8UC(small.channels), small.data.data());
  cv::resize(from, to, to.size(), 0, 0, cv::INTER_AREA);
  return encode_jpeg(small, quality);
}

}  // namespace vitrine
