// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/photo.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace vitrine {
namespace {

using Bytes = std::vector<std::uint8_t>;

void put(Bytes& b, const std::string& text) {
  b.insert(b.end(), text.begin(), text.end());
}
void put_be(Bytes& b, std::uint64_t v, int bytes) {
  for (int k = bytes - 1; k >= 0; --k) b.push_back(static_cast<std::uint8_t>(v >> (8 * k) & 255));
}
void put_le(Bytes& b, std::uint64_t v, int bytes) {
  for (int k = 0; k < bytes; ++k) b.push_back(static_cast<std::uint8_t>(v >> (8 * k) & 255));
}

class PhotoRoom : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ("vitrine_photo_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string save(const std::string& name, const Bytes& bytes) {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path;
  }
  static Bytes encode(const char* kind, const cv::Mat& m) {
    Bytes bytes;
    EXPECT_TRUE(cv::imencode(kind, m, bytes));
    return bytes;
  }
  static std::string code(const Result<Photo>& r) { return r ? "OK" : r.error().code; }

  std::filesystem::path folder_;
};

/// Four colours, one a quarter, so that every orientation can be told: red, green / blue, white.
cv::Mat quarters(int w, int h) {
  cv::Mat m(h, w, CV_8UC3, cv::Scalar(255, 255, 255));
  m(cv::Rect(0, 0, w / 2, h / 2)).setTo(cv::Scalar(0, 0, 255));
  m(cv::Rect(w / 2, 0, w - w / 2, h / 2)).setTo(cv::Scalar(0, 255, 0));
  m(cv::Rect(0, h / 2, w / 2, h - h / 2)).setTo(cv::Scalar(255, 0, 0));
  return m;
}

char colour(const Photo& p, bool right, bool low) {
  const std::uint8_t* c =
      p.rgb.at(p.rgb.width / 4 + (right ? p.rgb.width / 2 : 0), p.rgb.height / 4 + (low ? p.rgb.height / 2 : 0));
  const bool r = c[0] > 128, g = c[1] > 128, b = c[2] > 128;
  return r && g && b ? 'w' : r ? 'r' : g ? 'g' : b ? 'b' : '?';
}
std::string layout(const Photo& p) {
  return {colour(p, false, false), colour(p, true, false), colour(p, false, true), colour(p, true, true)};
}

Bytes with_exif(const Bytes& jpeg, int orientation) {
  Bytes out(jpeg.begin(), jpeg.begin() + 2), block;
  put(block, std::string("Exif\0\0MM\0*", 10));
  put_be(block, 8, 4);
  put_be(block, 1, 2);
  put_be(block, 0x0112, 2);
  put_be(block, 3, 2);
  put_be(block, 1, 4);
  put_be(block, static_cast<std::uint32_t>(orientation), 2);
  put_be(block, 0, 2);
  put_be(block, 0, 4);
  put_be(out, 0xFFE1, 2);
  put_be(out, static_cast<std::uint32_t>(block.size() + 2), 2);
  out.insert(out.end(), block.begin(), block.end());
  out.insert(out.end(), jpeg.begin() + 2, jpeg.end());
  return out;
}

TEST_F(PhotoRoom, readsEveryKindOfFileIntoRgb) {
  for (const char* kind : {".jpg", ".png", ".webp", ".bmp", ".tiff"}) {
    const auto photo = load_photo(save(std::string("a") + kind, encode(kind, quarters(120, 80))), "");
    ASSERT_TRUE(photo) << kind << ": " << photo.error().message;
    EXPECT_EQ(layout(*photo), "rgbw") << kind;
    EXPECT_EQ(photo->source_width, 120);
    EXPECT_EQ(photo->rgb.channels, 3);
    EXPECT_TRUE(photo->alpha.empty());
  }
}

TEST_F(PhotoRoom, missingFileAndFolderAreMissing) {
  for (const std::string& path : {(folder_ / "none.jpg").string(), folder_.string()}) {
    const auto photo = load_photo(path, "");
    ASSERT_FALSE(photo);
    EXPECT_EQ(photo.error().cause, Cause::missing);
    EXPECT_FALSE(photo.error().remedy.empty());
  }
}

TEST_F(PhotoRoom, emptyAndTextFilesAreNotImages) {
  EXPECT_EQ(code(load_photo(save("empty.jpg", {}), "")), "NOT_AN_IMAGE");
  Bytes text;
  put(text, "This is a letter, not a photo. Kind regards.");
  EXPECT_EQ(code(load_photo(save("text.png", text), "")), "NOT_AN_IMAGE");
}

TEST_F(PhotoRoom, hugeHeadersAreRefusedBeforeDecoding) {
  Bytes png;
  put(png, "\x89PNG\r\n\x1a\n");
  put_be(png, 13, 4);
  put(png, "IHDR");
  put_be(png, 30000, 4);
  put_be(png, 30000, 4);
  put_be(png, 0x08020000, 4);
  put_be(png, 0, 5);
  EXPECT_EQ(code(load_photo(save("bomb.png", png), "")), "TOO_LARGE");

  Bytes jpeg;
  put_be(jpeg, 0xFFD8, 2);
  put_be(jpeg, 0xFFC0, 2);
  put_be(jpeg, 17, 2);
  put_be(jpeg, 8, 1);
  put_be(jpeg, 30000, 2);
  put_be(jpeg, 30000, 2);
  jpeg.resize(jpeg.size() + 10, 1);
  EXPECT_EQ(code(load_photo(save("bomb.jpg", jpeg), "")), "TOO_LARGE");

  Bytes bmp;
  put(bmp, "BM");
  put_le(bmp, 54, 4);
  put_le(bmp, 0, 4);
  put_le(bmp, 54, 4);
  put_le(bmp, 40, 4);
  put_le(bmp, 0x7FFFFFFF, 4);
  put_le(bmp, 0x80000000u, 4);
  put_le(bmp, 1 | 24 << 16, 4);
  bmp.resize(64, 0);
  EXPECT_EQ(code(load_photo(save("bomb.bmp", bmp), "")), "TOO_LARGE");

  Bytes webp;
  put(webp, "RIFF");
  put_le(webp, 22, 4);
  put(webp, "WEBPVP8X");
  put_le(webp, 10, 4);
  put_le(webp, 0, 4);
  put_le(webp, 16000000, 3);
  put_le(webp, 16000000, 3);
  EXPECT_EQ(code(load_photo(save("bomb.webp", webp), "")), "TOO_LARGE");

  Bytes tiff;
  put(tiff, std::string("II*\0", 4));
  put_le(tiff, 8, 4);
  put_le(tiff, 2, 2);
  for (std::uint32_t tag : {256u, 257u}) {
    put_le(tiff, tag | 4u << 16, 4);
    put_le(tiff, 1, 4);
    put_le(tiff, 30000, 4);
  }
  put_le(tiff, 0, 4);
  EXPECT_EQ(code(load_photo(save("bomb.tif", tiff), "")), "TOO_LARGE");
}

TEST_F(PhotoRoom, everyTruncatedFileIsRefused) {
  for (const char* kind : {".jpg", ".png", ".webp", ".bmp", ".tiff"}) {
    cv::Mat noise(120, 160, CV_8UC3);
    cv::RNG rng(7);
    rng.fill(noise, cv::RNG::UNIFORM, 0, 256);
    const Bytes whole = encode(kind, noise);
    ASSERT_TRUE(load_photo(save(std::string("whole") + kind, whole), "")) << kind;
    for (double share : {0.01, 0.3, 0.5, 0.9, 0.99}) {
      const Bytes part(whole.begin(), whole.begin() + static_cast<long>(share * static_cast<double>(whole.size())));
      const auto photo = load_photo(save(std::string("part") + kind, part), "");
      ASSERT_FALSE(photo) << kind << " at " << share;
      EXPECT_EQ(photo.error().cause, Cause::unusable);
    }
  }
}

TEST_F(PhotoRoom, randomDamageNeverThrowsOrCrashes) {
  cv::RNG rng(11);
  for (const char* kind : {".jpg", ".png", ".webp", ".bmp", ".tiff"}) {
    const Bytes whole = encode(kind, quarters(90, 70));
    for (int trial = 0; trial < 40; ++trial) {
      Bytes b = whole;
      for (int k = 0; k < 6; ++k) b[rng.uniform(0, static_cast<int>(b.size()))] = static_cast<std::uint8_t>(rng.next());
      PhotoOptions options;
      options.max_pixels = 1'000'000;
      const auto photo = load_photo(save(std::string("broken") + kind, b), "", options);
      if (photo) {
        EXPECT_EQ(photo->rgb.data.size(), static_cast<std::size_t>(photo->rgb.width) * photo->rgb.height * 3);
      }
    }
  }
}

TEST_F(PhotoRoom, singlePixelIsTooSmallAndBigFileTooLarge) {
  EXPECT_EQ(code(load_photo(save("dot.png", encode(".png", quarters(1, 1))), "")), "TOO_SMALL");
  PhotoOptions options;
  options.max_bytes = 100;
  EXPECT_EQ(code(load_photo(save("big.bmp", encode(".bmp", quarters(80, 80))), "", options)), "TOO_LARGE");
}

TEST_F(PhotoRoom, everyExifOrientationIsUndone) {
  // What the viewer shows for stored "rgbw" (top left, top right, bottom left, bottom right).
  const char* shown[] = {"rgbw", "grwb", "wbgr", "bwrg", "rbgw", "brwg", "wgbr", "gwrb"};
  const Bytes jpeg = encode(".jpg", quarters(128, 80));
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const auto photo = load_photo(save("o.jpg", with_exif(jpeg, orientation)), "");
    ASSERT_TRUE(photo);
    EXPECT_EQ(layout(*photo), shown[orientation - 1]) << orientation;
    EXPECT_EQ(photo->rgb.width, orientation < 5 ? 128 : 80) << orientation;
  }
}

TEST_F(PhotoRoom, sixteenBitGreyBecomesEightBitRgb) {
  cv::Mat deep(70, 70, CV_16UC1, cv::Scalar(0x8080));
  const auto grey = load_photo(save("deep.png", encode(".png", deep)), "");
  ASSERT_TRUE(grey);
  EXPECT_EQ(grey->rgb.channels, 3);
  EXPECT_EQ(int(grey->rgb.at(5, 5)[1]), 0x80);
}

TEST_F(PhotoRoom, alphaIsKeptOnlyWhereItHidesSomething) {
  cv::Mat m(80, 100, CV_8UC4, cv::Scalar(10, 20, 30, 255));
  const auto opaque = load_photo(save("opaque.png", encode(".png", m)), "");
  ASSERT_TRUE(opaque);
  EXPECT_TRUE(opaque->alpha.empty());
  m(cv::Rect(0, 0, 50, 80)).setTo(cv::Scalar(0, 0, 0, 0));
  PhotoOptions options;
  options.max_side = 50;
  const auto cut = load_photo(save("cut.png", encode(".png", m)), "", options);
  ASSERT_TRUE(cut);
  ASSERT_EQ(cut->alpha.width, 50);
  EXPECT_EQ(int(*cut->alpha.at(2, 2)), 0);
  EXPECT_EQ(int(*cut->alpha.at(48, 2)), 255);
  EXPECT_EQ(int(cut->rgb.at(48, 2)[0]), 30);
}

TEST_F(PhotoRoom, maskIsReducedAndMirroredWithThePhoto) {
  cv::Mat labels(80, 128, CV_8UC1, cv::Scalar(0));
  labels(cv::Rect(0, 0, 64, 80)).setTo(255);
  labels(cv::Rect(0, 0, 64, 20)).setTo(128);
  const std::string photo_path = save("p.png", encode(".png", quarters(128, 80)));
  const std::string mask_path = save("m.png", encode(".png", labels));
  PhotoOptions options;
  options.max_side = 64;
  options.mirror = true;
  const auto photo = load_photo(photo_path, mask_path, options);
  ASSERT_TRUE(photo) << photo.error().message;
  EXPECT_EQ(layout(*photo), "grwb");
  EXPECT_TRUE(photo->mirrored);
  EXPECT_DOUBLE_EQ(photo->scale, 0.5);
  EXPECT_EQ(photo->source_width, 128);
  ASSERT_EQ(photo->mask.width, 64);
  EXPECT_EQ(int(*photo->mask.at(60, 2)), label_inside);
  EXPECT_EQ(int(*photo->mask.at(60, 30)), label_outside);
  EXPECT_EQ(int(*photo->mask.at(4, 30)), label_background);
}

TEST_F(PhotoRoom, maskHasTheSizeOfThePhotoAsDisplayed) {
  const std::string turned = save("t.jpg", with_exif(encode(".jpg", quarters(128, 80)), 6));
  EXPECT_TRUE(load_photo(turned, save("up.png", encode(".png", cv::Mat(128, 80, CV_8UC1, cv::Scalar(255))))));
  EXPECT_EQ(code(load_photo(turned, save("lying.png", encode(".png", cv::Mat(80, 128, CV_8UC1, cv::Scalar(255)))))),
            "MASK_SIZE");
}

TEST_F(PhotoRoom, maskWithoutGarmentIsRefused) {
  const std::string path = save("p.png", encode(".png", quarters(128, 80)));
  EXPECT_EQ(code(load_photo(path, save("m.png", encode(".png", cv::Mat(80, 128, CV_8UC1, cv::Scalar(0)))))),
            "EMPTY_MASK");
}

}  // namespace
}  // namespace vitrine
