// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "evidence.hpp"
#include "legs.hpp"

namespace vitrine::features_detail {
namespace {

// Means of adults as shares of the stature (the ANSUR II survey, as in the mannequin room): rough, and compared with
// wide limits only.
struct Share {
  std::string_view name;
  double value;
};
constexpr std::array heights = {Share{"neck", 0.845}, Share{"shoulder", 0.820},   Share{"armpit", 0.760},
                                Share{"bust", 0.720}, Share{"under_bust", 0.680}, Share{"waist", 0.620},
                                Share{"hip", 0.510},  Share{"crotch", 0.460},     Share{"thigh", 0.448},
                                Share{"knee", 0.276}, Share{"ankle", 0.040}};
/// Where the next kind of garment begins that hangs lower: a top's hem and that of shorts above the knee, a skirt's
/// above the floor.
constexpr std::array borders = {0.820, 0.620, 0.276, 0.0};
/// What hangs from the shoulders is a top or a dress. Its drop from there says which, in statures, and a hem that
/// stands out beyond the bust adds to it: what flares is a skirt. Between the two it may be either.
constexpr double kTopSurely = 0.64, kTopHardly = 0.78, kDressHardly = 0.46, kDressSurely = 0.62, kFlare = 0.25;
constexpr double kDressHem = 0.45;  ///< [-] a hem that the template means to lie below this is a dress's
/// A dress goes around the hips, however much it stretches: its hem's girth in hip girths.
constexpr double kHemHardly = 0.92, kHemSurely = 1.04;
/// Flat width below the armholes for reckoning in statures, whatever ease the plugin sells: half the bust and a
/// twelfth.
constexpr double kEase = 1.09;
/// Length of sleeves in statures. A short sleeve ends above the elbow, a long one below it.
constexpr double kLongHardly = 0.117, kLongSurely = 0.184, kShortEnds = 0.21, kShortEnded = 0.29;
/// Sleeves stand off the body: how far their cuffs reach out beyond the line of the side seam, as the mean of both. A
/// bite in a side makes a notch like an armpit's, but nothing that stands out.
constexpr double kOffHardly = 0.012, kOffSurely = 0.028;
/// Rise against what the waist's width lets expect; elastic draws a waist in by a third.
constexpr double kRiseSurely = 1.9, kRiseHardly = 2.4;
constexpr double kForearm = 0.25;  ///< a chain that is longer reaches past the elbow
constexpr std::array girths = {Share{"bust", 0.56},  Share{"under_bust", 0.49}, Share{"waist", 0.47},
                               Share{"hip", 0.60},   Share{"neck_base", 0.24},  Share{"biceps", 0.19},
                               Share{"wrist", 0.10}, Share{"thigh", 0.37}};
/// Along an arm from the acromion, and along a leg from the top of the thigh.
constexpr std::array along_limb = {Share{"shoulder", 0.0}, Share{"biceps", 0.09}, Share{"elbow", 0.185},
                                   Share{"wrist", 0.335},  Share{"thigh", 0.0},   Share{"knee", 0.172},
                                   Share{"ankle", 0.408}};

template <std::size_t N>
std::optional<double> share_of(const std::array<Share, N>& list, std::string_view landmark) {
  for (const std::string_view side : {"_left", "_right", "_front", "_back"})
    if (landmark.ends_with(side)) landmark.remove_suffix(side.size());
  for (const Share& s : list)
    if (s.name == landmark) return s.value;
  return std::nullopt;
}

double falling(double x, double from, double to) {
  return std::clamp((to - x) / (to - from), 0.0, 1.0);
}

double rising(double x, double from, double to) {
  return 1 - falling(x, from, to);
}

/// Of a garment that hangs from the shoulders, `length` and flare of the hem in statures.
double drop_reach(double bottom, double length, double flare, double hem_girth) {
  const double drop = length + kFlare * flare;
  if (bottom > kDressHem) return falling(drop, kTopSurely, kTopHardly);
  return rising(drop, kDressHardly, kDressSurely) * rising(hem_girth, kHemHardly, kHemSurely) *
         falling(length / 0.845, 1.2, 1.45);
}

/// Width [px] of what hangs from the shoulders where it is widest above its hem: a bib is narrower than the bust that
/// it covers, and the cloth below it is not.
double body_width(const GarmentTemplate& garment, const std::vector<Vec2>& at) {
  double widest = 0;
  for (int f = 0; f < static_cast<int>(at.size()); ++f) {
    const int partner = garment.features[f].mirror;
    if (partner < 0 || f == garment.scale.bottom || partner == garment.scale.bottom) continue;
    if (std::any_of(garment.limbs.begin(), garment.limbs.end(),
                    [&](const TemplateLimb& limb) { return f == limb.tip_a || f == limb.tip_b; }))
      continue;
    widest = std::max(widest, (at[f] - at[partner]).norm());
  }
  return widest;
}

/// How far [px] the cuff of a sleeve reaches out beyond the line of the side seam, 0 where that is not known.
double stands_off(const GarmentTemplate& garment, const TemplateLimb& limb, const std::vector<Vec2>& at) {
  const int bottom = garment.scale.bottom, partner = garment.features[bottom].mirror;
  if (partner < 0) return 0;
  const auto from_hem = [&](int f) { return std::min((at[f] - at[bottom]).norm(), (at[f] - at[partner]).norm()); };
  const Vec2& armpit = at[from_hem(limb.root_a) < from_hem(limb.root_b) ? limb.root_a : limb.root_b];
  const bool near = (armpit - at[bottom]).norm() < (armpit - at[partner]).norm();
  const Vec2 &hem = at[near ? bottom : partner], &other = at[near ? partner : bottom];
  const Vec2 up = (armpit - hem).normalized();
  Vec2 out(-up.y(), up.x());
  if (out.dot(other - hem) > 0) out = -out;
  return std::max({0.0, out.dot(at[limb.tip_a] - armpit), out.dot(at[limb.tip_b] - armpit)});
}

/// Where legs part: a crotch lies below the waist as far as a body's does, or the notch in a hem is taken for one.
double rise_reach(const GarmentTemplate& garment, const std::vector<Vec2>& at) {
  const ScaleRule& rule = garment.scale;
  const int crotch = crotch_of(garment);
  if (crotch < 0) return 1;
  const double wanted = expected_drop(garment, rule.top, crotch, (at[rule.feature_a] - at[rule.feature_b]).norm());
  const double rise = ((at[rule.feature_a] + at[rule.feature_b]) / 2 - at[crotch]).norm();
  return wanted > 0 ? falling(rise / wanted, kRiseSurely, kRiseHardly) : 1;
}

}  // namespace

double expected_drop(const GarmentTemplate& garment, int top, int bottom, double width) {
  const auto height = [&](int f) {
    return f >= 0 && f < static_cast<int>(garment.features.size()) ? share_of(heights, garment.features[f].landmark)
                                                                   : std::nullopt;
  };
  const auto girth = share_of(girths, garment.scale.girth), from = height(top), to = height(bottom);
  if (!girth || !from || !to || garment.scale.ease <= 0) return 0;
  return std::max(0.0, *from - *to) * width / (*girth * garment.scale.ease / 2);
}

double body_reach(const GarmentTemplate& garment, const std::vector<Vec2>& at) {
  const int count = static_cast<int>(at.size());
  const auto known = [&](int f) { return f >= 0 && f < count; };
  const ScaleRule& rule = garment.scale;
  const std::optional<double> girth = share_of(girths, rule.girth);
  if (!girth || !known(rule.feature_a) || !known(rule.feature_b) || rule.feature_a == rule.feature_b || rule.ease <= 0)
    return 1;
  double width = (at[rule.feature_a] - at[rule.feature_b]).norm();
  if (width < 1) return 1;
  double reach = 1, unit = *girth * rule.ease / 2 / width;  // statures per pixel
  if (known(rule.top) && known(rule.bottom) && rule.top != rule.bottom) {
    const auto top = share_of(heights, garment.features[rule.top].landmark);
    const auto bottom = share_of(heights, garment.features[rule.bottom].landmark);
    if (top && *top > *share_of(heights, "armpit")) {
      width = body_width(garment, at);
      unit = *share_of(girths, "bust") * kEase / 2 / width;
    }
    if (top && bottom && *top > *bottom) {
      const double length = unit * (at[rule.top] - at[rule.bottom]).norm();
      const int partner = garment.features[rule.bottom].mirror;
      if (*top > *share_of(heights, "armpit") && known(partner)) {
        const double hem = (at[rule.bottom] - at[partner]).norm();
        reach = drop_reach(*bottom, length, hem / width - 1, 2 * unit * hem / *share_of(girths, "hip"));
      } else {
        const double border = *std::find_if(borders.begin(), borders.end(), [&](double b) { return b < *bottom; });
        reach = falling(length / (*top - border), 1.2, 1.45);
      }
    }
  }
  // The longer of the limbs: a sleeve may be folded over.
  double longest = -1, meant = 0, off = 0;
  int sleeves = 0;
  bool arms = false;
  for (const TemplateLimb& limb : garment.limbs) {
    if (limb.chain.size() < 2 || !known(limb.root_a) || !known(limb.root_b) || !known(limb.tip_a) || !known(limb.tip_b))
      continue;
    const auto from = share_of(along_limb, limb.chain.front()), to = share_of(along_limb, limb.chain.back());
    if (!from || !to || *to <= *from) continue;
    const double length = (at[limb.root_a] + at[limb.root_b] - at[limb.tip_a] - at[limb.tip_b]).norm() / 2;
    longest = std::max(longest, unit * length);
    off += unit * stands_off(garment, limb, at);
    ++sleeves;
    meant = *to - *from;
    arms = limb.chain.front().starts_with("shoulder");
  }
  if (longest < 0) return reach;
  if (!arms) return reach * rising(longest / meant, 0.35, 0.55) * rise_reach(garment, at);
  reach *= rising(off / sleeves, kOffHardly, kOffSurely);
  return reach *
         (meant > kForearm ? rising(longest, kLongHardly, kLongSurely) : falling(longest, kShortEnds, kShortEnded));
}

}  // namespace vitrine::features_detail
