// SPDX-License-Identifier: GPL-3.0-or-later
#include <opencv2/core.hpp>

#include "vitrine/photo.hpp"

namespace vitrine {

Image turned(const Image& image, int quarter_turns) {
  const int turns = ((quarter_turns % 4) + 4) % 4;
  if (turns == 0 || image.empty()) return image;
  const bool lying = turns != 2;
  Image result(lying ? image.height : image.width, lying ? image.width : image.height, image.channels);
  const cv::Mat from(image.height, image.width, CV_8UC(image.channels), const_cast<std::uint8_t*>(image.data.data()));
  cv::Mat to(result.height, result.width, CV_8UC(image.channels), result.data.data());
  cv::rotate(from, to,
             turns == 1   ? cv::ROTATE_90_COUNTERCLOCKWISE
             : turns == 2 ? cv::ROTATE_180
                          : cv::ROTATE_90_CLOCKWISE);
  return result;
}

void turn_photo(Photo& photo, int quarter_turns) {
  for (Image* image : {&photo.rgb, &photo.alpha, &photo.mask}) *image = turned(*image, quarter_turns);
  photo.quarter_turns = (((photo.quarter_turns + quarter_turns) % 4) + 4) % 4;
}

}  // namespace vitrine
