// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "evidence.hpp"

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
                                Share{"hip", 0.510},  Share{"crotch", 0.460},     Share{"knee", 0.276},
                                Share{"ankle", 0.040}};
/// Where the next kind of garment begins that hangs lower: a skirt's hem ends above the floor.
constexpr std::array borders = {0.820, 0.620, 0.276, 0.0};
/// What hangs from the shoulders is a top or a dress. Its drop from there says which, in statures, and a hem that
/// stands out beyond the bust adds to it: what flares is a skirt. Between the two it may be either.
constexpr double kTopSurely = 0.64, kTopHardly = 0.78, kDressHardly = 0.46, kDressSurely = 0.62, kFlare = 0.25;
constexpr double kDressHem = 0.45;  ///< [-] a hem that the template means to lie below this is a dress's
/// A dress goes around the hips, however much it stretches: its hem's girth in hip girths.
constexpr double kHemHardly = 0.92, kHemSurely = 1.04;
/// A sleeve's length in statures: surely none at the first pair, surely a long one and no short one at the second.
constexpr double kShortHardly = 0.030, kShortSurely = 0.070, kLongHardly = 0.117, kLongSurely = 0.184;
constexpr double kShortEnds = 0.21, kShortEnded = 0.29, kForearm = 0.25;
constexpr std::array girths = {Share{"bust", 0.56},  Share{"under_bust", 0.49}, Share{"waist", 0.47},
                               Share{"hip", 0.60},   Share{"neck_base", 0.24},  Share{"biceps", 0.19},
                               Share{"wrist", 0.10}, Share{"thigh", 0.37}};
/// Along an arm from the acromion.
constexpr std::array along_arm = {Share{"shoulder", 0.0}, Share{"biceps", 0.09}, Share{"elbow", 0.185},
                                  Share{"wrist", 0.335}};

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

}  // namespace

double body_reach(const GarmentTemplate& garment, const std::vector<Vec2>& at) {
  const int count = static_cast<int>(at.size());
  const auto known = [&](int f) { return f >= 0 && f < count; };
  const ScaleRule& rule = garment.scale;
  const std::optional<double> girth = share_of(girths, rule.girth);
  if (!girth || !known(rule.feature_a) || !known(rule.feature_b) || rule.feature_a == rule.feature_b || rule.ease <= 0)
    return 1;
  const double width = (at[rule.feature_a] - at[rule.feature_b]).norm();
  if (width < 1) return 1;
  const double unit = *girth * rule.ease / 2 / width;  // statures per pixel
  double reach = 1;
  if (known(rule.top) && known(rule.bottom) && rule.top != rule.bottom) {
    const auto top = share_of(heights, garment.features[rule.top].landmark);
    const auto bottom = share_of(heights, garment.features[rule.bottom].landmark);
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
  double longest = -1, meant = 0;
  bool arms = false;
  for (const TemplateLimb& limb : garment.limbs) {
    if (limb.chain.size() < 2 || !known(limb.root_a) || !known(limb.root_b) || !known(limb.tip_a) || !known(limb.tip_b))
      continue;
    const auto from = share_of(along_arm, limb.chain.front()), to = share_of(along_arm, limb.chain.back());
    if (!from || !to || *to <= *from) continue;
    const double length = (at[limb.root_a] + at[limb.root_b] - at[limb.tip_a] - at[limb.tip_b]).norm() / 2;
    longest = std::max(longest, unit * length);
    meant = *to - *from;
    arms = limb.chain.front().starts_with("shoulder");
  }
  if (longest < 0) return reach;
  if (!arms) return reach * rising(longest / meant, 0.35, 0.55);
  if (meant > kForearm) return reach * rising(longest, kLongHardly, kLongSurely);
  return reach * rising(longest, kShortHardly, kShortSurely) * falling(longest, kShortEnds, kShortEnded);
}

}  // namespace vitrine::features_detail
