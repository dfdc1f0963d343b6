// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/features.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drawn_garment.hpp"

namespace vitrine::test {
namespace {

using testing::HasSubstr;

FeatureOptions on_the_back() {
  FeatureOptions options;
  options.side = Side::back;  // the silhouette's own top edge is the neckline
  return options;
}

void expect_corners(const Features& features, const Drawing& drawing, double tolerance) {
  for (const auto& [name, at] : drawing.corners)
    EXPECT_LT((point(features, name).pixel - at - Vec2(40, 20)).norm(), tolerance) << name;
}

bool crosses(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto side = [](const Vec2& p, const Vec2& q, const Vec2& r) {
    return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

void expect_simple_clockwise_and_ordered(const Features& features) {
  const int n = static_cast<int>(features.contour.size());
  ASSERT_GT(n, 50);
  double area = 0;
  for (int i = 0; i < n; ++i) {
    const Vec2 &a = features.contour[i], &b = features.contour[(i + 1) % n];
    area += a.x() * b.y() - b.x() * a.y();
    for (int j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      ASSERT_FALSE(crosses(a, b, features.contour[j], features.contour[(j + 1) % n])) << i << " " << j;
    }
  }
  EXPECT_GT(area, 0);
  const int first = features.points[0].contour_index;
  int before = -1;
  for (const FeaturePoint& p : features.points) {
    const int along = (p.contour_index - first + n) % n;
    EXPECT_GT(along, before) << p.name;
    before = along;
    EXPECT_EQ(p.pixel, features.contour[p.contour_index]) << p.name;
  }
}

TEST(Features, FindTheCornersAndTheCrotchOfTrousers) {
  for (const double gap : {8.0, 30.0, 80.0}) {
    const Drawing drawing = draw_trousers(gap);
    const auto features = features_of(filled(drawing.outline), trousers(), on_the_back());
    ASSERT_TRUE(features) << gap << ": " << features.error().message;
    expect_corners(*features, drawing, gap < 20 ? 12 : 7);
    expect_simple_clockwise_and_ordered(*features);
    EXPECT_THAT(features->warnings, testing::IsEmpty());
  }
}

TEST(Features, PutTheCrotchOfLegsThatLieOnEachOtherWhereABodyHasIt) {
  const Drawing drawing = draw_trousers(20, 340);  // the notch is far below the crotch
  const auto features = features_of(filled(drawing.outline), trousers(), on_the_back());
  ASSERT_TRUE(features) << features.error().message;
  EXPECT_THAT(features->warnings, testing::Contains("LEGS_TOGETHER"));
  const FeaturePoint& crotch = point(*features, "crotch");
  EXPECT_NEAR(crotch.pixel.y(), 20 + 130 + 110, 35);
  EXPECT_EQ(crotch.origin, "template");
  EXPECT_LE(crotch.confidence, 0.35);
  expect_simple_clockwise_and_ordered(*features);
}

TEST(Features, RefuseLegsThatShowNoGap) {
  Drawing drawing = draw_trousers(30);
  drawing.outline.erase(drawing.outline.begin() + 3, drawing.outline.begin() + 6);
  const auto features = features_of(filled(drawing.outline), trousers(), on_the_back());
  ASSERT_FALSE(features);
  EXPECT_EQ(features.error().code, "LEGS_TOGETHER");
  EXPECT_THAT(features.error().remedy, HasSubstr("apart"));
}

TEST(Features, PartHemsThatTouchBelowAnOpenGap) {
  const Drawing drawing = draw_trousers(40);
  Image labels = filled(drawing.outline);
  for (int y = 472; y < 484; ++y)
    for (int x = 40 + 170; x < 40 + 230; ++x) *labels.at(x, y) = label_outside;
  const auto features = features_of(labels, trousers(), on_the_back());
  ASSERT_TRUE(features) << features.error().message;
  EXPECT_LT((point(*features, "crotch").pixel - Vec2(240, 20 + 240)).norm(), 8);
}

TEST(Features, FindTheCornersOfAVest) {
  const Drawing drawing = draw_vest();
  const auto features = features_of(filled(drawing.outline), vest(), on_the_back());
  ASSERT_TRUE(features) << features.error().message;
  expect_corners(*features, drawing, 4);
  expect_simple_clockwise_and_ordered(*features);
  EXPECT_EQ(features->pose, "flat");
  for (const FeaturePoint& p : features->points) EXPECT_EQ(p.origin, "candidate") << p.name;
}

TEST(Features, FindTheCornersOfASkirtWithoutANeckline) {
  const Drawing drawing = draw_skirt();
  const auto features = features_of(filled(drawing.outline), skirt());
  ASSERT_TRUE(features) << features.error().message;
  expect_corners(*features, drawing, 4);
  EXPECT_EQ(features->neckline.id, "");
}

TEST(Features, FindTheCornersOfALongSleeveAndPlaceItsRoundShoulder) {
  const Drawing drawing = draw_long_sleeve();
  const auto features = features_of(filled(drawing.outline), long_sleeve(), on_the_back());
  ASSERT_TRUE(features) << features.error().message;
  expect_corners(*features, drawing, 5);
  expect_simple_clockwise_and_ordered(*features);
}

class Tilted : public testing::TestWithParam<double> {};

TEST_P(Tilted, GarmentsKeepTheirCornersAndTellTheirTilt) {
  for (const Drawing& drawing : {turned(draw_vest(), GetParam()), turned(draw_vest(60, v_depth), GetParam())}) {
    const auto features = features_of(filled(drawing.outline), vest(), on_the_back());
    ASSERT_TRUE(features) << features.error().message;
    expect_corners(*features, drawing, 6);
    EXPECT_NEAR(features->tilt_deg, GetParam(), 1.5);
  }
}
INSTANTIATE_TEST_SUITE_P(UpToTwentyDegrees, Tilted, testing::Values(-20, -15, -10, -5, 0, 5, 10, 15, 20));

TEST(Features, OfAMirroredPictureAreMirrored) {
  Drawing drawing = draw_vest();
  for (Vec2& p : drawing.outline) p.x() += 0.1 * (p.y() - 60);  // not symmetric itself
  const Image labels = filled(drawing.outline);
  const auto plain = features_of(labels, vest(), on_the_back());
  const auto flipped = features_of(mirrored(labels), vest(), on_the_back());
  ASSERT_TRUE(plain && flipped);
  for (std::size_t i = 0; i < plain->points.size(); ++i) {
    const FeaturePoint& partner = flipped->points[vest().features[i].mirror];
    const Vec2 expected(labels.width - 1 - plain->points[i].pixel.x(), plain->points[i].pixel.y());
    EXPECT_LT((partner.pixel - expected).norm(), 3.5) << plain->points[i].name;
  }
}

TEST(Features, AreTheSameBytesTwice) {
  const Image labels = filled(draw_vest().outline);
  const auto one = features_of(labels, vest()), two = features_of(labels, vest());
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->contour, two->contour);
}

struct NeckCase {
  const char* id;
  double (*shape)(double);
  double ratio, tolerance;
};
class NeckRatio : public testing::TestWithParam<NeckCase> {};

TEST_P(NeckRatio, ChoosesTheNecklineOfThePaper) {
  const NeckCase c = GetParam();
  const Drawing drawing = draw_vest(80, c.shape);
  const auto features = features_of(filled(drawing.outline), vest(), on_the_back());
  ASSERT_TRUE(features) << features.error().message;
  EXPECT_NEAR(features->neckline.ratio, c.ratio, c.tolerance);
  EXPECT_EQ(features->neckline.id, c.id);
  EXPECT_NEAR(features->neckline.low.y(), 60 + 80 + 20, 3);
  EXPECT_FALSE(features->neckline.forced);
}
INSTANTIATE_TEST_SUITE_P(OfExactShapes, NeckRatio,
                         testing::Values(NeckCase{"neck_v", v_depth, 1.0, 0.12},
                                         NeckCase{"neck_u", u_depth, 0.273, 0.07},
                                         NeckCase{"neck_square", square_depth, 0.0, 0.06}));

TEST(Features, TakeTheNecklineThatTheUserNames) {
  FeatureOptions options = on_the_back();
  options.neckline = "neck_square";
  const auto features = features_of(filled(draw_vest().outline), vest(), options);
  ASSERT_TRUE(features) << features.error().message;
  EXPECT_EQ(features->neckline.id, "neck_square");
  EXPECT_TRUE(features->neckline.forced);
}

TEST(Features, NameTheNecklinesWhenTheOneAskedForIsUnknown) {
  FeatureOptions options;
  options.neckline = "neck_halter";
  const auto features = features_of(filled(draw_vest().outline), vest(), options);
  ASSERT_FALSE(features);
  EXPECT_EQ(features.error().cause, Cause::usage);
  EXPECT_THAT(features.error().remedy, HasSubstr("neck_u, neck_v, neck_square"));
}

TEST(Features, RefuseAnotherGarment) {
  const Image of_vest = filled(draw_vest().outline), of_skirt = filled(draw_skirt().outline),
              of_sleeves = filled(draw_long_sleeve().outline);
  const std::vector<std::pair<const Image*, GarmentTemplate>> wrong = {
      {&of_vest, skirt()},        {&of_vest, long_sleeve()}, {&of_skirt, vest()},
      {&of_skirt, long_sleeve()}, {&of_sleeves, vest()},     {&of_sleeves, skirt()}};
  for (const auto& [labels, garment] : wrong) {
    const auto features = features_of(*labels, garment, on_the_back());
    ASSERT_FALSE(features) << garment.id << " " << features->score;
    EXPECT_EQ(features.error().code, "NOT_THIS_GARMENT");
    EXPECT_EQ(features.error().cause, Cause::unusable);
  }
}

/// The drawing with square bites cut into its side seams, alternately left and right.
Image bitten(const Drawing& drawing, double deep, double tall, double apart) {
  Image labels = filled(drawing.outline);
  for (int y = 0; y < labels.height; ++y) {
    const double v = y - 20 - 225;
    if (v < 0 || v > 190 || std::fmod(v, apart) > tall) continue;
    const bool left = static_cast<int>(v / apart) % 2 == 0;
    int first = 0, last = labels.width - 1;
    while (first < last && !*labels.at(first, y)) ++first;
    while (last > first && !*labels.at(last, y)) --last;
    for (int k = 0; k < deep; ++k) *labels.at(left ? first + k : last - k, y) = label_background;
  }
  return labels;
}

TEST(Features, TakeBitesOfOneAndAHalfPercentOfTheDiagonalForNoise) {
  const Drawing drawing = draw_vest();
  const double diagonal = std::hypot(270, 380);
  for (const double share : {0.005, 0.01, 0.015}) {
    const double size = share * diagonal;
    const auto features = features_of(bitten(drawing, size, size, 6 * size), vest(), on_the_back());
    ASSERT_TRUE(features) << share << ": " << features.error().message;
    EXPECT_GT(features->score, 0.6) << share;
    expect_corners(*features, drawing, 6);
  }
}

TEST(Features, LetABiteSpeakAgainstTheGarmentByItsSize) {
  double before = 2;
  for (const double deep : {5.0, 25.0, 60.0}) {
    const auto features = features_of(bitten(draw_vest(), deep, deep, 400), vest(), on_the_back());
    const double score = features ? features->score : 0;
    EXPECT_LE(score, before) << deep;
    before = score;
  }
  EXPECT_LT(before, 0.7);
}

TEST(Features, UseTheInsideThatTheShopMarked) {
  Drawing back = draw_vest(12);  // the back's neckline is high
  Image labels = filled(back.outline);
  const Image front = filled(draw_vest(90, v_depth).outline);
  for (std::size_t i = 0; i < labels.data.size(); ++i)
    if (labels.data[i] && !front.data[i]) labels.data[i] = label_inside;
  const auto features = features_of(labels, vest());
  ASSERT_TRUE(features) << features.error().message;
  EXPECT_TRUE(features->neckline.inside_found);
  EXPECT_EQ(features->neckline.id, "neck_v");
  EXPECT_NEAR(features->neckline.low.y(), 60 + 90 + 20, 3);
  EXPECT_EQ(features->labels.data, labels.data);
}

TEST(Features, FindAFrontNecklineThatOnlyShadingShows) {
  const Image labels = filled(draw_vest(12).outline), front = filled(draw_vest(90).outline);
  Photo photo;
  photo.rgb = Image(labels.width, labels.height, 3, 240);
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x)
      for (int c = 0; c < 3; ++c)
        if (*labels.at(x, y)) photo.rgb.at(x, y)[c] = *front.at(x, y) ? 120 : 100;
  Silhouette silhouette;
  silhouette.labels = labels;
  const auto features = find_features(photo, silhouette, vest(), necklines(), {});
  ASSERT_TRUE(features) << features.error().message;
  EXPECT_TRUE(features->neckline.inside_found);
  EXPECT_NEAR(features->neckline.low.y(), 60 + 90 + 20, 5);
  long wrong = 0, inside = 0;
  for (std::size_t i = 0; i < labels.data.size(); ++i) {
    const bool truth = labels.data[i] && !front.data[i];
    inside += truth;
    wrong += truth != (features->labels.data[i] == label_inside);
  }
  EXPECT_LT(wrong, inside / 8);
  expect_simple_clockwise_and_ordered(*features);
  const auto back = find_features(photo, silhouette, vest(), necklines(), on_the_back());
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_FALSE(back->neckline.inside_found) << "nothing is cut off a back";
}

TEST(Features, CutASleeveFreeWhoseCuffLiesOnTheBody) {
  Drawing drawing = draw_long_sleeve();
  Image labels = filled(drawing.outline);
  const std::vector<Vec2> bridge = {
      {270, 330}, {345, 330}, {352, 400}, {280, 415}};  // closes the right gap at the cuff
  const Image cuff = filled(bridge);
  for (std::size_t i = 0; i < labels.data.size(); ++i)
    if (cuff.data[i]) labels.data[i] = label_outside;
  const auto features = features_of(labels, long_sleeve(), on_the_back());
  ASSERT_TRUE(features) << features.error().message;
  expect_simple_clockwise_and_ordered(*features);
  EXPECT_LT((point(*features, "armpit_right").pixel - Vec2(332, 220)).norm(), 6);
  EXPECT_LT((point(*features, "hem_right").pixel - Vec2(330, 460)).norm(), 6);
}

TEST(Features, CutASleeveAtTheTemplateWhereNoGapIsSeen) {
  Image labels = filled(draw_long_sleeve().outline);
  const Image touching = filled({{285, 190}, {292, 199}, {332, 409}, {285, 414}});
  for (std::size_t i = 0; i < labels.data.size(); ++i)
    if (touching.data[i]) labels.data[i] = label_outside;
  const auto features = features_of(labels, long_sleeve(), on_the_back());
  ASSERT_TRUE(features) << features.error().message;
  EXPECT_THAT(features->warnings, testing::Contains("SLEEVE_ON_BODY"));
  expect_simple_clockwise_and_ordered(*features);
  EXPECT_LT((point(*features, "armpit_right").pixel - Vec2(332, 220)).norm(), 25);
  EXPECT_LT((point(*features, "hem_right").pixel - Vec2(330, 460)).norm(), 6);
}

TEST(Features, RefuseEmptyAndMalformedInput) {
  EXPECT_EQ(features_of(Image(480, 540, 1), vest()).error().code, "NO_OUTLINE");
  GarmentTemplate broken = vest();
  broken.poses.clear();
  EXPECT_EQ(features_of(filled(draw_vest().outline), broken).error().cause, Cause::plugin);
  broken = vest();
  broken.edges[2].from = 99;
  EXPECT_EQ(features_of(filled(draw_vest().outline), broken).error().cause, Cause::plugin);
}

TEST(Features, SurviveAGarmentThatFillsThePicture) {
  Image labels(200, 200, 1, label_outside);
  const auto features = features_of(labels, skirt());
  if (features) expect_simple_clockwise_and_ordered(*features);
}

}  // namespace
}  // namespace vitrine::test
