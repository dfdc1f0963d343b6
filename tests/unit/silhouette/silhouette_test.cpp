// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/silhouette.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace vitrine {
namespace {

/// A drawn photo with its truth: a long-sleeved shirt whose arm gaps are closed at the cuffs.
struct Scene {
  cv::Mat rgb, truth;
};

cv::Scalar grey(int v) {
  return {static_cast<double>(v), static_cast<double>(v), static_cast<double>(v)};
}

Scene shirt(const cv::Scalar& cloth, const cv::Scalar& board, cv::Point shift = {}, double size = 1) {
  Scene s{cv::Mat(400, 400, CV_8UC3, board), cv::Mat::zeros(400, 400, CV_8U)};
  const auto at = [&](double x, double y) {
    return cv::Point(static_cast<int>(std::lround(200 + (x - 200) * size)) + shift.x,
                     static_cast<int>(std::lround(200 + (y - 200) * size)) + shift.y);
  };
  const std::vector<cv::Point> body = {at(160, 80),  at(170, 100), at(200, 110), at(230, 100), at(240, 80),
                                       at(290, 100), at(350, 290), at(318, 300), at(280, 180), at(278, 330),
                                       at(122, 330), at(120, 180), at(82, 300),  at(50, 290),  at(110, 100)};
  cv::fillPoly(s.truth, std::vector<std::vector<cv::Point>>{body}, cv::Scalar(255));
  cv::fillPoly(s.truth, std::vector<std::vector<cv::Point>>{{at(310, 280), at(345, 285), at(300, 312), at(272, 305)}},
               cv::Scalar(255));
  s.rgb.setTo(cloth, s.truth);
  return s;
}

void noise(cv::Mat& rgb, double sigma, std::uint64_t seed) {
  cv::Mat n(rgb.size(), CV_16SC3), wide;
  cv::RNG(seed).fill(n, cv::RNG::NORMAL, 0, sigma);
  rgb.convertTo(wide, CV_16SC3);
  wide += n;
  wide.convertTo(rgb, CV_8UC3);
}

void falloff(cv::Mat& rgb) {
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) rgb.at<cv::Vec3b>(y, x) *= 1.0 - 0.25 * x / rgb.cols - 0.1 * y / rgb.rows;
}

Photo photo_of(const cv::Mat& rgb) {
  Photo p;
  p.path = "drawn.png";
  p.rgb = Image(rgb.cols, rgb.rows, 3);
  for (int y = 0; y < rgb.rows; ++y) std::copy_n(rgb.ptr(y), rgb.cols * 3, p.rgb.at(0, y));
  p.source_width = rgb.cols;
  p.source_height = rgb.rows;
  return p;
}

Image grey_image(const cv::Mat& m) {
  Image i(m.cols, m.rows, 1);
  for (int y = 0; y < m.rows; ++y) std::copy_n(m.ptr(y), m.cols, i.at(0, y));
  return i;
}

double iou(const Silhouette& s, const cv::Mat& truth) {
  long both = 0, any = 0;
  for (int y = 0; y < truth.rows; ++y)
    for (int x = 0; x < truth.cols; ++x) {
      const bool a = *s.labels.at(x, y) > 0, b = truth.at<std::uint8_t>(y, x) > 0;
      both += a && b;
      any += a || b;
    }
  return static_cast<double>(both) / static_cast<double>(any);
}

std::string code(const Result<Silhouette>& r) {
  return r ? "OK" : r.error().code;
}

TEST(SilhouetteRoom, plainBoardsAreCutByTheEdgeScan) {
  for (const auto& [cloth, board] : {std::pair{grey(40), grey(235)}, std::pair{grey(225), grey(25)},
                                     std::pair{cv::Scalar(30, 60, 190), grey(255)}}) {
    Scene s = shirt(cloth, board);
    noise(s.rgb, 2, 3);
    const auto r = find_silhouette(photo_of(s.rgb));
    ASSERT_TRUE(r) << r.error().message;
    EXPECT_EQ(r->method, "sobel") << r->method_reason;
    EXPECT_TRUE(r->method_reason.empty());
    EXPECT_GT(iou(*r, s.truth), 0.98);
    EXPECT_GT(r->edge_support, 0.95);
    EXPECT_TRUE(r->warnings.empty());
  }
}

TEST(SilhouetteRoom, lightFalloffOverTheBoardIsFollowed) {
  Scene s = shirt({150, 40, 50}, grey(240));
  falloff(s.rgb);
  noise(s.rgb, 2, 5);
  const auto r = find_silhouette(photo_of(s.rgb));
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_GT(iou(*r, s.truth), 0.98);
}

TEST(SilhouetteRoom, roughGroundHandsOverToTheColourModelAndSaysWhy) {
  Scene s = shirt({40, 70, 160}, {150, 140, 120});
  cv::Mat rough(s.rgb.size(), CV_8UC3, cv::Scalar(150, 140, 120));
  noise(rough, 40, 9);
  rough.copyTo(s.rgb, ~s.truth);
  const auto r = find_silhouette(photo_of(s.rgb));
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_EQ(r->method, "colour");
  EXPECT_FALSE(r->method_reason.empty());
  EXPECT_GT(iou(*r, s.truth), 0.96);
}

TEST(SilhouetteRoom, armGapStaysOpen) {
  const Scene s = shirt({30, 60, 190}, grey(250));
  ASSERT_EQ(s.truth.at<std::uint8_t>(260, 290), 0);
  const auto r = find_silhouette(photo_of(s.rgb));
  ASSERT_TRUE(r);
  EXPECT_EQ(int(*r->labels.at(290, 260)), label_background);
  EXPECT_EQ(int(*r->labels.at(108, 260)), label_background);
}

TEST(SilhouetteRoom, printInTheBoardsColourStaysGarment) {
  Scene s = shirt({30, 60, 190}, grey(250));
  cv::rectangle(s.rgb, {175, 150}, {225, 230}, grey(250), cv::FILLED);
  const auto r = find_silhouette(photo_of(s.rgb));
  ASSERT_TRUE(r);
  EXPECT_EQ(int(*r->labels.at(200, 190)), label_outside);
  EXPECT_GT(iou(*r, s.truth), 0.98);
}

TEST(SilhouetteRoom, threadAndSoftShadowAreNotGarment) {
  Scene s = shirt({170, 40, 40}, grey(235));
  cv::Mat shade, dark;
  cv::Mat moved = cv::Mat::zeros(s.truth.size(), CV_8U);
  s.truth(cv::Rect(0, 0, 392, 392)).copyTo(moved(cv::Rect(8, 8, 392, 392)));
  cv::GaussianBlur(moved, shade, {}, 5);
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x)
      if (!s.truth.at<std::uint8_t>(y, x)) s.rgb.at<cv::Vec3b>(y, x) *= 1 - 0.25 * shade.at<std::uint8_t>(y, x) / 255.0;
  cv::line(s.rgb, {200, 330}, {215, 380}, {170, 40, 40}, 2);
  noise(s.rgb, 1.5, 13);
  const auto r = find_silhouette(photo_of(s.rgb));
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_GT(iou(*r, s.truth), 0.97);
  EXPECT_EQ(int(*r->labels.at(213, 372)), label_background);
}

TEST(SilhouetteRoom, shopMaskIsTakenOverWithItsInside) {
  Scene s = shirt(grey(200), grey(200));
  cv::rectangle(s.truth, {185, 112}, {215, 125}, cv::Scalar(128), cv::FILLED);
  Photo p = photo_of(s.rgb);
  p.mask = grey_image(s.truth);
  const auto r = find_silhouette(p);
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_EQ(r->method, "mask");
  EXPECT_EQ(r->labels.data, p.mask.data);
}

TEST(SilhouetteRoom, transparencyStandsAboveThePicture) {
  Scene s = shirt(grey(60), grey(60));
  Photo p = photo_of(s.rgb);
  p.alpha = grey_image(s.truth);
  const auto r = find_silhouette(p);
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_EQ(r->method, "alpha");
  EXPECT_GT(iou(*r, s.truth), 0.995);
}

TEST(SilhouetteRoom, transparencyThatHidesNothingIsIgnored) {
  Scene s = shirt(grey(40), grey(240));
  Photo p = photo_of(s.rgb);
  p.alpha = Image(400, 400, 1, 255);
  *p.alpha.at(0, 0) = 160;
  const auto r = find_silhouette(p);
  ASSERT_TRUE(r);
  EXPECT_EQ(r->method, "sobel");
}

TEST(SilhouetteRoom, sameInputGivesSameBytes) {
  Scene s = shirt({90, 90, 60}, {150, 140, 120});
  noise(s.rgb, 25, 17);
  const auto a = find_silhouette(photo_of(s.rgb)), b = find_silhouette(photo_of(s.rgb));
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->labels.data, b->labels.data);
}

TEST(SilhouetteRoom, garmentLikeItsGroundIsRefusedAsLowContrast) {
  for (const Scene& base : {shirt(grey(200), grey(200)), shirt(grey(128), grey(129))}) {
    Scene s = base;
    noise(s.rgb, 3, 19);
    const auto r = find_silhouette(photo_of(s.rgb));
    EXPECT_EQ(code(r), "LOW_CONTRAST");
    if (!r) {
      EXPECT_NE(r.error().remedy.find("board"), std::string::npos);
    }
  }
}

TEST(SilhouetteRoom, garmentCutByTheFrameIsRefused) {
  Scene s = shirt({40, 60, 150}, grey(235), {0, 120});
  noise(s.rgb, 2, 23);
  EXPECT_EQ(code(find_silhouette(photo_of(s.rgb))), "TOUCHES_FRAME");
}

TEST(SilhouetteRoom, garmentThatGrazesTheFrameIsOnlyWarnedAbout) {
  Scene s = shirt({40, 60, 150}, grey(235), {52, 0});
  noise(s.rgb, 2, 29);
  const auto r = find_silhouette(photo_of(s.rgb));
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_EQ(r->warnings, std::vector<std::string>{"TOUCHES_FRAME"});
  EXPECT_GT(iou(*r, s.truth), 0.96);
}

TEST(SilhouetteRoom, twoGarmentsAreRefused) {
  Scene s = shirt({40, 60, 150}, grey(235), {-100, 0}, 0.5);
  const Scene other = shirt({40, 60, 150}, grey(235), {100, 0}, 0.5);
  s.rgb.setTo(cv::Scalar(150, 60, 40), other.truth);
  noise(s.rgb, 2, 31);
  EXPECT_EQ(code(find_silhouette(photo_of(s.rgb))), "SEVERAL_GARMENTS");
}

TEST(SilhouetteRoom, picturesOfNothingAreRefusedWhateverTheirShape) {
  for (const cv::Size size : {cv::Size(64, 64), cv::Size(2400, 64), cv::Size(64, 1200), cv::Size(500, 400)}) {
    cv::Mat flat(size, CV_8UC3, grey(200)), noisy = flat.clone(), ramp = flat.clone();
    noise(noisy, 40, 5);
    falloff(ramp);
    for (const cv::Mat& picture : {flat, cv::Mat(flat * 0), noisy, ramp}) {
      const auto r = find_silhouette(photo_of(picture));
      if (!r) {
        EXPECT_EQ(r.error().exit_code(), 65) << r.error().message;
      }
    }
    EXPECT_FALSE(find_silhouette(photo_of(flat)));
  }
}

TEST(SilhouetteRoom, blurIsWarnedAboutAndThenRefused) {
  Scene s = shirt({170, 40, 40}, grey(235));
  const auto blurred = [&](double sigma) {
    cv::Mat soft;
    cv::GaussianBlur(s.rgb, soft, {}, sigma);
    noise(soft, 1.5, 17);
    return find_silhouette(photo_of(soft));
  };
  const auto sharp = blurred(0.4), soft = blurred(1.9), hopeless = blurred(4.5);
  ASSERT_TRUE(sharp) << sharp.error().message;
  EXPECT_TRUE(sharp->warnings.empty());
  ASSERT_TRUE(soft) << soft.error().message;
  EXPECT_EQ(soft->warnings, std::vector<std::string>{"BLURRED"});
  EXPECT_EQ(code(hopeless), "BLURRED");
}

TEST(SilhouetteRoom, roughlyDrawnMaskOnASharpPhotoIsNotCalledBlurred) {
  Scene s = shirt({170, 40, 40}, grey(235));
  cv::Mat drawn;
  cv::dilate(s.truth, drawn, cv::getStructuringElement(cv::MORPH_ELLIPSE, {13, 13}));
  Photo photo = photo_of(s.rgb);
  photo.mask = grey_image(drawn);
  const auto r = find_silhouette(photo);
  ASSERT_TRUE(r) << r.error().message;
  EXPECT_TRUE(r->warnings.empty());
}

TEST(SilhouetteRoom, tinyGarmentIsRefused) {
  Scene s = shirt({40, 60, 150}, grey(235), {}, 0.2);
  noise(s.rgb, 1, 37);
  EXPECT_EQ(code(find_silhouette(photo_of(s.rgb))), "TOO_SMALL");
}

}  // namespace
}  // namespace vitrine
