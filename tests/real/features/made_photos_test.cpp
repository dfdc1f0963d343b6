// SPDX-License-Identifier: GPL-3.0-or-later
// Photos of the generator, whose points are known exactly, with the shipped garment tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "garments.hpp"
#include "photo_maker.hpp"
#include "spoiled_mask.hpp"
#include "vitrine/features.hpp"

namespace vitrine {
namespace {

using support::GarmentKind;
using test::loaded;

constexpr GarmentKind kinds[] = {GarmentKind::vest, GarmentKind::long_sleeve, GarmentKind::skirt, GarmentKind::t_shirt,
                                 GarmentKind::dress};
constexpr int count = std::size(kinds);

struct Made {
  support::MadePhoto photo;
  Image labels;  // the whole garment
};

Made make(std::uint32_t seed, GarmentKind kind) {
  Made made;
  made.photo = support::make_photo(support::random_spec(seed, kind));
  made.labels = made.photo.labels;
  for (auto& label : made.labels.data)
    if (label) label = label_outside;
  return made;
}

Result<Features> features_of(const Made& made, const Image& labels, const GarmentTemplate& garment) {
  Photo photo;
  photo.rgb = made.photo.rgb;
  Silhouette silhouette;
  silhouette.labels = labels;
  FeatureOptions options;
  options.side = Side::back;  // the outline's own top edge: what is measured here is the outline
  options.others = loaded();
  return find_features(photo, silhouette, garment, test::necklines(), options);
}

double share(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(q * static_cast<double>(values.size())))];
}

TEST(MadePhotos, KeepTheirPointsAndTheirGarmentOnARoughOutline) {
  std::vector<double> distances;
  int right = 0, accepted = 0;
  for (const GarmentKind kind : kinds)
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
      const Made made = make(seed, kind);
      const GarmentTemplate& garment = test::garment_named(support::id_of(kind));
      const Image rough = test::roughened(made.labels, 0.003, 0.004, seed);
      right += suggest_garment(rough, loaded())[0].id == garment.id;
      const Result<Features> found = features_of(made, rough, garment);
      if (!found) {
        std::printf("%s %u: %s\n", garment.id.c_str(), seed, found.error().message.c_str());
        continue;
      }
      ++accepted;
      const double diagonal = test::box_of(made.labels).diagonal();
      for (const FeaturePoint& p : found->points) {
        const auto truth = made.photo.landmarks.find(p.name);
        if (truth != made.photo.landmarks.end()) distances.push_back(100 * (p.pixel - truth->second).norm() / diagonal);
      }
    }
  std::printf("%zu points: median %.2f %%, 90th percentile %.2f %% of the diagonal\n", distances.size(),
              share(distances, 0.5), share(distances, 0.9));
  std::printf("%d of %d suggested right, %d accepted\n", right, 20 * count, accepted);
  EXPECT_GE(right, 0.97 * 20 * count);
  EXPECT_GE(accepted, 0.97 * 20 * count);
  EXPECT_LE(share(distances, 0.5), 0.8);
  EXPECT_LE(share(distances, 0.9), 3);
}

TEST(MadePhotos, AreRefusedWhenAnotherGarmentIsAskedFor) {
  for (const GarmentKind kind : kinds)
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
      const Made made = make(seed, kind);
      const std::string id = support::id_of(kind);
      for (const GarmentTemplate& asked : loaded()) {
        const Result<Features> found = features_of(made, made.labels, asked);
        EXPECT_EQ(static_cast<bool>(found), asked.id == id)
            << id << " " << seed << " as " << asked.id << ": " << (found ? "accepted" : found.error().message);
        if (asked.id == id || found) continue;
        EXPECT_EQ(found.error().code, "NOT_THIS_GARMENT");
        EXPECT_NE(found.error().remedy.find(id), std::string::npos) << found.error().remedy;
      }
    }
}

TEST(MadePhotos, KeepTheirGarmentWhenTheirOutlineIsBitten) {
  int right = 0, accepted = 0;
  for (const GarmentKind kind : kinds)
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
      const Made made = make(seed, kind);
      const GarmentTemplate& garment = test::garment_named(support::id_of(kind));
      const Image bitten = test::bitten(made.labels, 0.02, 4, seed);
      const GarmentFit best = suggest_garment(bitten, loaded())[0];
      const Result<Features> found = features_of(made, bitten, garment);
      right += best.id == garment.id;
      accepted += static_cast<bool>(found);
      if (best.id != garment.id || !found)
        std::printf("%s %u: %s %.2f; %s\n", garment.id.c_str(), seed, best.id.c_str(), best.score,
                    found ? "accepted" : found.error().message.c_str());
    }
  std::printf("%d of %d suggested right, %d accepted\n", right, 10 * count, accepted);
  EXPECT_GE(right, 0.9 * 10 * count);
  EXPECT_GE(accepted, 0.9 * 10 * count);
}

TEST(MadePhotos, AreTurnedUprightWhicheverWayTheyLie) {
  for (const GarmentKind kind : kinds)
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
      const Made made = make(seed, kind);
      const GarmentTemplate& garment = test::garment_named(support::id_of(kind));
      const Result<Features> upright = features_of(made, made.labels, garment);
      ASSERT_TRUE(upright) << upright.error().message;
      for (int lies = 0; lies < 4; ++lies) {
        const Image given = turned(made.labels, lies);
        const int turns = turns_to_upright(given, garment);
        ASSERT_EQ(turns, (4 - lies) % 4) << garment.id << " " << seed << " turned " << lies << " times";
        const Result<Features> found = features_of(made, turned(given, turns), garment);
        ASSERT_TRUE(found) << found.error().message;
        for (std::size_t i = 0; i < found->points.size(); ++i)
          EXPECT_EQ(found->points[i].pixel, upright->points[i].pixel) << found->points[i].name;
      }
    }
}

TEST(MadePhotos, LyingOnTheirSideAreTheSamePictureAfterFourTurns) {
  Photo photo;
  photo.rgb = make(1, GarmentKind::vest).photo.rgb;
  photo.mask = make(1, GarmentKind::vest).labels;
  Photo lying = photo;
  turn_photo(lying, 1);
  EXPECT_EQ(lying.quarter_turns, 1);
  EXPECT_EQ(lying.rgb.width, photo.rgb.height);
  // Counter-clockwise: what was the right end of the top row is the top of the left column.
  EXPECT_EQ(*lying.rgb.at(0, 0), *photo.rgb.at(photo.rgb.width - 1, 0));
  turn_photo(lying, 3);
  EXPECT_EQ(lying.quarter_turns, 0);
  EXPECT_EQ(lying.rgb.data, photo.rgb.data);
  EXPECT_EQ(lying.mask.data, photo.mask.data);
}

}  // namespace
}  // namespace vitrine
