// SPDX-License-Identifier: GPL-3.0-or-later
#include "photo_maker.hpp"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>
#include <set>

#include "sleeve_size.hpp"

using namespace vitrine;
using namespace vitrine::support;

namespace {

constexpr GarmentKind kinds[] = {GarmentKind::vest, GarmentKind::long_sleeve, GarmentKind::skirt, GarmentKind::t_shirt,
                                 GarmentKind::dress};

/// Calls `check` with the front and back photos of 5 random garments of each kind.
template <class Check>
void for_random_photos(Check check) {
  for (const GarmentKind kind : kinds)
    for (std::uint32_t seed = 1; seed <= 5; ++seed)
      for (const bool back : {false, true}) {
        const PhotoSpec spec = back ? back_of(random_spec(seed, kind)) : random_spec(seed, kind);
        SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kind)) + " seed " + std::to_string(seed) +
                     (back ? " back" : " front"));
        check(spec, make_photo(spec));
      }
}

cv::Mat labels_of(const MadePhoto& photo) {
  return cv::Mat(photo.labels.height, photo.labels.width, CV_8UC1, const_cast<std::uint8_t*>(photo.labels.data.data()));
}

/// Per pixel the distance [px] to the border of a mask.
cv::Mat distance_to_border(const cv::Mat& mask) {
  cv::Mat grown, distance;
  cv::dilate(mask, grown, cv::Mat::ones(3, 3, CV_8U));
  cv::distanceTransform(grown == mask, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance;
}

}  // namespace

TEST(PhotoMaker, draws_the_same_pixels_for_the_same_spec) {
  for (const GarmentKind kind : kinds) {
    const PhotoSpec spec = random_spec(5, kind);
    const MadePhoto a = make_photo(spec), b = make_photo(spec);
    EXPECT_EQ(a.rgb.data, b.rgb.data);
    EXPECT_EQ(a.labels.data, b.labels.data);
    PhotoSpec other = spec;
    other.seed += 1;
    EXPECT_NE(make_photo(other).rgb.data, a.rgb.data);
  }
}

TEST(PhotoMaker, every_landmark_lies_on_the_border_of_its_face) {
  for_random_photos([](const PhotoSpec& spec, const MadePhoto& photo) {
    const cv::Mat face = distance_to_border(labels_of(photo) == label_outside);
    const cv::Mat all = distance_to_border(labels_of(photo) > 0);
    for (const auto& [name, p] : photo.landmarks) {
      const cv::Point at(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
      ASSERT_TRUE(cv::Rect(0, 0, all.cols, all.rows).contains(at)) << name;
      const bool low = name == "neck_low" || name == "waist_low";
      // A gap that is narrower than a pixel, as the tip of an armpit is, does not show in the mask.
      EXPECT_LE((low ? face : all).at<float>(at), 2.5) << name << " at " << p.transpose() << " seed " << spec.seed;
    }
  });
}

TEST(PhotoMaker, names_the_landmarks_of_its_garment) {
  using ::testing::UnorderedElementsAre;
  const auto names = [](GarmentKind kind) {
    std::set<std::string> set;
    for (const auto& entry : make_photo(random_spec(2, kind)).landmarks) set.insert(entry.first);
    return set;
  };
  EXPECT_THAT(names(GarmentKind::vest),
              UnorderedElementsAre("neck_left", "neck_right", "neck_low", "shoulder_left", "shoulder_right",
                                   "armpit_left", "armpit_right", "hem_left", "hem_right"));
  EXPECT_THAT(names(GarmentKind::skirt),
              UnorderedElementsAre("waist_left", "waist_right", "waist_low", "hem_left", "hem_right"));
  for (const GarmentKind kind : {GarmentKind::long_sleeve, GarmentKind::t_shirt})
    for (const char* name :
         {"cuff_upper_left", "cuff_upper_right", "cuff_lower_left", "cuff_lower_right", "armpit_left"})
      EXPECT_EQ(names(kind).count(name), 1u) << name;
  const auto dress = names(GarmentKind::dress);
  for (const char* name : {"neck_low", "armpit_left", "waist_left", "waist_right", "hem_right"})
    EXPECT_EQ(dress.count(name), 1u) << name;
}

TEST(PhotoMaker, lays_one_whole_garment_inside_the_picture) {
  for_random_photos([](const PhotoSpec&, const MadePhoto& photo) {
    const cv::Mat all = labels_of(photo) > 0;
    cv::Mat parts;
    EXPECT_EQ(cv::connectedComponents(all, parts, 4), 2) << "background and one garment";
    const cv::Rect box = cv::boundingRect(all);
    EXPECT_GE(std::min({box.x, box.y, all.cols - box.br().x, all.rows - box.br().y}), 8);
    EXPECT_GT(cv::countNonZero(all), all.rows * all.cols / 6);
  });
}

TEST(PhotoMaker, shows_the_inside_above_the_front_neckline_only) {
  for_random_photos([](const PhotoSpec& spec, const MadePhoto& photo) {
    const cv::Mat inside = labels_of(photo) == label_inside;
    const int count = cv::countNonZero(inside);
    if (spec.side == Side::back) {
      EXPECT_EQ(count, 0);
      return;
    }
    EXPECT_GT(count, 50);
    const Vec2 low = photo.landmarks.at(spec.garment == GarmentKind::skirt ? "waist_low" : "neck_low");
    EXPECT_LE(cv::boundingRect(inside).br().y, low.y() + 3);
  });
}

TEST(PhotoMaker, keeps_long_sleeves_clear_of_the_body) {
  for (std::uint32_t seed = 1; seed <= 8; ++seed)
    for (const bool back : {false, true}) {
      const PhotoSpec front = random_spec(seed, GarmentKind::long_sleeve);
      const MadePhoto photo = make_photo(back ? back_of(front) : front);
      for (const std::string side : {"left", "right"}) {
        const Vec2 armpit = photo.landmarks.at("armpit_" + side), cuff = photo.landmarks.at("cuff_lower_" + side);
        const Vec2 hem = photo.landmarks.at("hem_" + side);
        const double t = std::min(1.0, (cuff.y() - armpit.y()) / (hem.y() - armpit.y()));
        const Vec2 body = armpit + t * (hem - armpit), gap = 0.5 * (cuff + body);
        EXPECT_EQ(*photo.labels.at(static_cast<int>(gap.x()), static_cast<int>(gap.y())), label_background)
            << seed << side;
      }
    }
}

TEST(PhotoMaker, long_sleeves_fit_an_arm_and_taper_to_the_cuff) {
  for (std::uint32_t seed = 1; seed <= 8; ++seed)
    for (const bool back : {false, true}) {
      const PhotoSpec front = random_spec(seed, GarmentKind::long_sleeve);
      for (const SleeveSize& sleeve : sleeves_of(make_photo(back ? back_of(front) : front))) {
        SCOPED_TRACE(seed);
        EXPECT_NEAR(sleeve.armpit / front.chest, 0.355, 0.035);
        EXPECT_NEAR(sleeve.cuff / front.chest, 0.20, 0.02);
        EXPECT_GT(sleeve.armpit, sleeve.elbow + 2);
        EXPECT_GT(sleeve.elbow, sleeve.cuff + 1.5);
        EXPECT_NEAR(sleeve.under, 42.5, 4);
        EXPECT_NEAR(sleeve.upper, 60, 6);
      }
    }
}

TEST(PhotoMaker, front_and_back_are_the_same_garment_mirrored) {
  for (const GarmentKind kind : kinds)
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
      PhotoSpec front = random_spec(seed, kind);
      front.tilt = 0;
      const MadePhoto a = make_photo(front), b = make_photo(back_of(front));
      cv::Mat mirrored;
      cv::flip(labels_of(b) > 0, mirrored, 1);
      const cv::Mat all = labels_of(a) > 0;
      const double both = cv::countNonZero(all & mirrored), either = cv::countNonZero(all | mirrored);
      EXPECT_GT(both / either, 0.95) << seed;
      EXPECT_NEAR(a.pixels_per_cm, b.pixels_per_cm, 0.02 * a.pixels_per_cm);
    }
}

TEST(PhotoMaker, the_drawn_size_is_the_size_asked_for) {
  PhotoSpec spec = random_spec(3, GarmentKind::vest);
  spec.tilt = 0;
  spec.asymmetry = 0;
  const MadePhoto photo = make_photo(spec);
  const auto& p = photo.landmarks;
  EXPECT_NEAR((p.at("armpit_right") - p.at("armpit_left")).norm() / photo.pixels_per_cm, spec.chest, 0.01);
  EXPECT_NEAR((p.at("hem_right") - p.at("hem_left")).norm() / photo.pixels_per_cm, spec.hem, 0.01);
  EXPECT_NEAR((p.at("neck_low").y() - p.at("neck_left").y()) / photo.pixels_per_cm, spec.neck_depth, 0.01);
}

TEST(PhotoMaker, random_garments_contrast_with_their_board) {
  for (const GarmentKind kind : kinds)
    for (std::uint32_t seed = 1; seed <= 200; ++seed) EXPECT_GE(contrast(random_spec(seed, kind)), 70);
}

TEST(PhotoMaker, the_board_far_from_the_garment_has_the_colour_and_noise_asked_for) {
  PhotoSpec spec = random_spec(4, GarmentKind::vest);
  spec.falloff = spec.grain = spec.shadow = 0;
  spec.board = {120, 130, 140};
  for (const double noise : {0.0, 4.0}) {
    spec.noise = noise;
    const MadePhoto photo = make_photo(spec);
    const cv::Mat rgb(photo.rgb.height, photo.rgb.width, CV_8UC3, const_cast<std::uint8_t*>(photo.rgb.data.data()));
    cv::Scalar mean, deviation;
    cv::meanStdDev(rgb, mean, deviation, labels_of(photo) == 0);
    for (int c = 0; c < 3; ++c) {
      // Anti-aliased pixels at the garment's border are part of the background's label.
      EXPECT_NEAR(mean[c], spec.board[c], 1.5);
      EXPECT_NEAR(deviation[c], noise, noise == 0 ? 6 : 3);
    }
  }
}
