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
  const double width = (at[rule.feature_a] - at[rule.feature_b]).norm();
  if (width < 1) return 1;
  const double unit = *girth * rule.ease / 2 / width;  // statures per pixel
  double reach = 1;
  if (known(rule.top) && known(rule.bottom) && rule.top != rule.bottom) {
    const auto top = share_of(heights, garment.features[rule.top].landmark);
    const auto bottom = share_of(heights, garment.features[rule.bottom].landmark);
    if (top && bottom && *top > *bottom) {
      const double border = *std::find_if(borders.begin(), borders.end(), [&](double b) { return b < *bottom; });
      const double length = unit * (at[rule.top] - at[rule.bottom]).norm();
      reach = falling(length / (*top - border), 1.2, 1.45);
    }
  }
  // The longer of the limbs: a sleeve may be folded over.
  double longest = -1;
  for (const TemplateLimb& limb : garment.limbs) {
    if (limb.chain.size() < 2 || !known(limb.root_a) || !known(limb.root_b) || !known(limb.tip_a) || !known(limb.tip_b))
      continue;
    const auto from = share_of(along_limb, limb.chain.front()), to = share_of(along_limb, limb.chain.back());
    if (!from || !to || *to <= *from) continue;
    const double length = (at[limb.root_a] + at[limb.root_b] - at[limb.tip_a] - at[limb.tip_b]).norm() / 2;
    longest = std::max(longest, unit * length / (*to - *from));
  }
  return longest < 0 ? reach : reach * (1 - falling(longest, 0.35, 0.55));
}

}  // namespace vitrine::features_detail
