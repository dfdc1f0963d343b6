// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "garments.hpp"
#include "spoiled_mask.hpp"
#include "vitrine/features.hpp"
#include "vitrine/photo.hpp"

namespace vitrine {
namespace {

const std::string kFolder = std::string(VITRINE_SOURCE_DIR) + "/../shared/photos/";

struct Shot {
  std::string name, file, garment, neckline;
  bool back = false;
};

std::vector<Shot> shots(const std::string& garment) {
  std::ifstream index(kFolder + "index.tsv");
  std::vector<Shot> list;
  std::string line;
  std::getline(index, line);
  while (std::getline(index, line)) {
    std::stringstream fields(line);
    Shot shot;
    std::string view;
    std::getline(fields, shot.file, '\t');
    std::getline(fields, shot.garment, '\t');
    std::getline(fields, shot.neckline, '\t');
    std::getline(fields, view, '\t');
    shot.name = shot.file.substr(0, shot.file.find('.'));
    shot.back = view == "back";
    if (garment.empty() || shot.garment == garment) list.push_back(shot);
  }
  return list;
}

using test::loaded;

/// The kinds that the index names and the plugin that each needs.
const std::map<std::string, std::string> plugin_of = {
    {"vest", "vest"},   {"longsleeve", "long_sleeve"}, {"skirt", "skirt"},  {"tshirt", "t_shirt"},
    {"dress", "dress"}, {"trousers", "trousers"},      {"shorts", "shorts"}};

/// Kinds with photos and a loaded plugin, in the index's order; the others are said.
std::vector<std::string> kinds() {
  std::vector<std::string> list;
  std::map<std::string, int> without;
  for (const Shot& shot : shots("")) {
    const auto plugin = plugin_of.find(shot.garment);
    if (plugin == plugin_of.end() || !test::shipped().find_garment(plugin->second)) {
      ++without[shot.garment];
    } else if (std::find(list.begin(), list.end(), shot.garment) == list.end()) {
      list.push_back(shot.garment);
    }
  }
  for (const auto& [kind, photos] : without) std::printf("%d photos of %s left out: no plugin\n", photos, kind.c_str());
  return list;
}

/// What the kind's plugin supplies: with sleeves and without.
std::vector<GarmentTemplate> variants_of(const std::string& kind) {
  std::vector<GarmentTemplate> variants;
  const std::string plugin = test::garment_named(plugin_of.at(kind)).plugin;
  for (const GarmentTemplate& garment : loaded())
    if (garment.plugin == plugin) variants.push_back(garment);
  return variants;
}

/// The variant that the program itself would suggest for a silhouette.
GarmentTemplate garment_for(const std::string& kind, const Image& labels) {
  return test::garment_named(suggest_garment(labels, variants_of(kind)).at(0).id);
}

/// Landmarks in the front frame: those of a back photo are mirrored with it.
std::map<std::string, Vec2> landmarks(const Shot& shot, int width) {
  const auto json = nlohmann::json::parse(std::ifstream(kFolder + shot.name + ".landmarks.json"));
  std::map<std::string, Vec2> points;
  for (const auto& [key, at] : json["points"].items()) {
    std::string name = key;
    Vec2 p(at[0].get<double>(), at[1].get<double>());
    if (shot.back) {
      p.x() = width - 1 - p.x();
      const auto left = name.find("left"), right = name.find("right");
      if (left != std::string::npos)
        name.replace(left, 4, "right");
      else if (right != std::string::npos)
        name.replace(right, 5, "left");
    }
    points[name] = p;
  }
  return points;
}

struct Seen {
  Photo photo;
  Silhouette silhouette;
  double diagonal = 1;
};

Seen see(const Shot& shot, bool keep_inside) {
  PhotoOptions options;
  options.mirror = shot.back;
  Result<Photo> photo = load_photo(kFolder + shot.file, kFolder + shot.name + ".mask.png", options);
  Seen seen;
  if (!photo) {
    ADD_FAILURE() << photo.error().message;
    return seen;
  }
  seen.photo = *photo;
  seen.silhouette.labels = seen.photo.mask;
  Image& labels = seen.silhouette.labels;
  int x0 = labels.width, x1 = 0, y0 = labels.height, y1 = 0;
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      std::uint8_t& label = *labels.at(x, y);
      if (label == label_background) continue;
      if (!keep_inside) label = label_outside;
      x0 = std::min(x0, x);
      x1 = std::max(x1, x);
      y0 = std::min(y0, y);
      y1 = std::max(y1, y);
    }
  seen.diagonal = std::hypot(x1 - x0 + 1, y1 - y0 + 1);
  return seen;
}

FeatureOptions options_for(const Shot& shot) {
  FeatureOptions options;
  options.side = shot.back ? Side::back : Side::front;
  return options;
}

void expect_ordered_contour(const Features& features, const std::string& name) {
  const int n = static_cast<int>(features.contour.size());
  ASSERT_GT(n, 50) << name;
  double area = 0;
  for (int i = 0; i < n; ++i) {
    const Vec2 &a = features.contour[i], &b = features.contour[(i + 1) % n];
    area += a.x() * b.y() - b.x() * a.y();
  }
  EXPECT_GT(area, 0) << name << ": the contour runs clockwise in the picture";
  for (std::size_t k = 1; k < features.points.size(); ++k) {
    const int first = features.points[0].contour_index;
    EXPECT_GT((features.points[k].contour_index - first + n) % n,
              (features.points[k - 1].contour_index - first + n) % n)
        << name << ": " << features.points[k].name;
  }
  for (const FeaturePoint& p : features.points) EXPECT_EQ(p.pixel, features.contour[p.contour_index]) << name;
}

class RealFeatures : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kFolder + "index.tsv")) GTEST_SKIP() << "no real photos at ../shared/photos";
  }
};

struct Tally {
  std::vector<double> distances;  // [%] of the diagonal
  int tops = 0, necklines_right = 0, refused = 0;
};

void measure(const std::string& garment, bool keep_inside, Tally& tally) {
  const std::vector<NecklineTemplate> necklines = test::necklines();
  for (const Shot& shot : shots(garment)) {
    const Seen seen = see(shot, keep_inside);
    const GarmentTemplate pattern = garment_for(garment, seen.silhouette.labels);
    const Result<Features> found = find_features(seen.photo, seen.silhouette, pattern, necklines, options_for(shot));
    if (!found) {
      std::printf("%-20s refused: %s\n", shot.name.c_str(), found.error().message.c_str());
      ++tally.refused;
      continue;
    }
    expect_ordered_contour(*found, shot.name);
    const std::map<std::string, Vec2> truth = landmarks(shot, seen.photo.rgb.width);
    std::printf("%-20s %-15s score %.2f neckline %-11s ratio %.2f |", shot.name.c_str(), found->pose.c_str(),
                found->score, found->neckline.id.c_str(), found->neckline.ratio);
    for (const FeaturePoint& p : found->points) {
      const auto at = truth.find(p.name);
      if (at == truth.end()) continue;
      const double distance = 100 * (p.pixel - at->second).norm() / seen.diagonal;
      std::printf(" %s %.1f", p.name.c_str(), distance);
      tally.distances.push_back(distance);
    }
    std::printf("\n");
    if (pattern.neck_edge() < 0) continue;
    ++tally.tops;
    const std::string wanted = shot.neckline == "U" ? "neck_u" : shot.neckline == "V" ? "neck_v" : "neck_square";
    tally.necklines_right += found->neckline.id == wanted;
  }
}

double share(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(q * static_cast<double>(values.size())))];
}

TEST_F(RealFeatures, LieOnTheirLandmarks) {
  Tally tally;
  for (const std::string& kind : kinds()) measure(kind, false, tally);
  ASSERT_FALSE(tally.distances.empty());
  std::printf("%zu points: median %.2f %%, 90th percentile %.2f %% of the diagonal; necklines %d of %d\n",
              tally.distances.size(), share(tally.distances, 0.5), share(tally.distances, 0.9), tally.necklines_right,
              tally.tops);
  EXPECT_EQ(tally.refused, 0);
  EXPECT_LE(share(tally.distances, 0.5), 0.5);
  EXPECT_LE(share(tally.distances, 0.9), 2.5);
  EXPECT_GE(tally.necklines_right, 0.8 * tally.tops);
}

TEST_F(RealFeatures, LieOnTheirLandmarksWhenTheShopMarksTheInside) {
  Tally tally;
  for (const std::string& kind : kinds()) measure(kind, true, tally);
  ASSERT_FALSE(tally.distances.empty());
  EXPECT_LE(tally.refused, 1);
  EXPECT_LE(share(tally.distances, 0.5), 0.5);
  EXPECT_LE(share(tally.distances, 0.9), 2.5);
  EXPECT_GE(tally.necklines_right, 0.85 * tally.tops);
}

TEST_F(RealFeatures, FindTheInsideOfTheBackOnMostFronts) {
  int shown = 0, found_most = 0;
  for (const std::string& garment : kinds())
    for (const Shot& shot : shots(garment)) {
      const Seen truth = see(shot, true), seen = see(shot, false);
      const GarmentTemplate pattern = garment_for(garment, seen.silhouette.labels);
      if (pattern.neck_edge() < 0) continue;
      const Result<Features> found =
          find_features(seen.photo, seen.silhouette, pattern, test::necklines(), options_for(shot));
      if (!found) continue;
      int both = 0, either = 0, marked = 0;
      for (std::size_t i = 0; i < found->labels.data.size(); ++i) {
        const bool a = truth.silhouette.labels.data[i] == label_inside, b = found->labels.data[i] == label_inside;
        marked += a;
        both += a && b;
        either += a || b;
      }
      if (marked < 1000) continue;
      ++shown;
      found_most += both > 0.7 * either;
      std::printf("%-20s inside overlap %.2f\n", shot.name.c_str(), 1.0 * both / either);
    }
  EXPECT_GE(found_most, 0.5 * shown);
}

struct Ranking {
  int all = 0, suggested_right = 0, right_refused = 0, wrong_accepted = 0;
};

/// What each loaded garment says to each photo that one of them describes.
Ranking rank(const std::function<Image(const Image&)>& spoil) {
  Ranking ranking;
  for (const std::string& garment : kinds())
    for (const Shot& shot : shots(garment)) {
      Seen seen = see(shot, false);
      seen.silhouette.labels = spoil(seen.silhouette.labels);
      const GarmentTemplate right = garment_for(garment, seen.silhouette.labels);
      const std::vector<GarmentFit> fits = suggest_garment(seen.silhouette.labels, loaded());
      ++ranking.all;
      ranking.suggested_right += fits[0].id == right.id;
      if (fits[0].id != right.id)
        std::printf("%s: %s %.2f, %s %.2f\n", shot.name.c_str(), fits[0].id.c_str(), fits[0].score, fits[1].id.c_str(),
                    fits[1].score);
      for (const GarmentTemplate& asked : loaded()) {
        if (asked.plugin == right.plugin && asked.id != right.id) continue;  // with sleeves or without: not wrong
        // What three others fit better is refused for them.
        const auto rank_of =
            std::find_if(fits.begin(), fits.end(), [&](const auto& fit) { return fit.id == asked.id; });
        if (asked.id != right.id && rank_of - fits.begin() > 2) continue;
        FeatureOptions options = options_for(shot);
        options.others = loaded();
        const Result<Features> found = find_features(seen.photo, seen.silhouette, asked, test::necklines(), options);
        if (static_cast<bool>(found) == (asked.id == right.id)) continue;
        ++(found ? ranking.wrong_accepted : ranking.right_refused);
        std::printf("%s as %s: %s\n", shot.name.c_str(), asked.id.c_str(),
                    found ? "accepted" : found.error().message.c_str());
      }
    }
  std::printf("garment suggested right on %d of %d photos, %d right ones refused, %d wrong ones accepted\n",
              ranking.suggested_right, ranking.all, ranking.right_refused, ranking.wrong_accepted);
  return ranking;
}

TEST_F(RealFeatures, AreFoundForTheRightGarmentOnly) {
  const Ranking ranking = rank([](const Image& labels) { return labels; });
  EXPECT_EQ(ranking.suggested_right, ranking.all);
  EXPECT_EQ(ranking.right_refused, 0);
  EXPECT_EQ(ranking.wrong_accepted, 0);
}

TEST_F(RealFeatures, AreFoundForTheRightGarmentWhenTheOutlineIsRoughOrBitten) {
  const Ranking rough = rank([](const Image& labels) { return test::roughened(labels, 0.003, 0.004, 1); });
  const Ranking bitten = rank([](const Image& labels) { return test::bitten(labels, 0.02, 4, 1); });
  for (const Ranking& ranking : {rough, bitten}) {
    EXPECT_GE(ranking.suggested_right, 0.9 * ranking.all);
    EXPECT_LE(ranking.right_refused, 0.1 * ranking.all);
    // A vest on a hanger with a bite in its armholes is a pair of shorts upside down.
    EXPECT_LE(ranking.wrong_accepted, 0.1 * ranking.all);
  }
}

TEST_F(RealFeatures, NameTheGarmentThatFitsWhenTheyRefuse) {
  for (const Shot& shot : shots("skirt")) {
    const Seen seen = see(shot, false);
    FeatureOptions options;
    options.others = loaded();
    const auto found =
        find_features(seen.photo, seen.silhouette, test::garment_named("vest"), test::necklines(), options);
    ASSERT_FALSE(found) << shot.name;
    EXPECT_EQ(found.error().code, "NOT_THIS_GARMENT");
    EXPECT_NE(found.error().remedy.find("skirt"), std::string::npos) << found.error().remedy;
  }
}

TEST_F(RealFeatures, AreRefusedOnGarmentsThatNoPluginDescribes) {
  // A pair of shorts with its legs together is a skirt's outline, so that only the others have to be refused.
  for (const Shot& shot : shots("")) {
    const auto plugin = plugin_of.find(shot.garment);
    if (plugin != plugin_of.end() && test::shipped().find_garment(plugin->second)) continue;
    const Seen seen = see(shot, false);
    std::printf("%-16s", shot.name.c_str());
    for (const GarmentFit& fit : suggest_garment(seen.silhouette.labels, loaded())) {
      std::printf(" %s %.2f", fit.id.c_str(), fit.score);
      if (shot.garment != "shorts") {
        EXPECT_LT(fit.score, 0.3) << shot.name << fit.id;
      }
    }
    std::printf("\n");
  }
}

}  // namespace
}  // namespace vitrine
