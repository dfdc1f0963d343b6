// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_people.hpp"

#include <cmath>
#include <numbers>

namespace vitrine::bench {
namespace {

/// Box-Muller on splitmix64: the standard library's normal distribution differs between libraries.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed) {}
  double normal() {
    const double u = uniform(), v = uniform();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
  }

 private:
  double uniform() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return (static_cast<double>((z ^ (z >> 31)) >> 11) + 0.5) * 0x1.0p-53;
  }
  std::uint64_t state_;
};

/// 1 %, middle, 99 %; the deviation follows from the percentiles where the survey's tables give none.
struct Spread {
  double low, middle, high;
  bool holds(double x) const { return x >= low && x <= high; }
  double drawn(Draw& draw) const { return middle + (high - low) / 4.653 * draw.normal(); }
};

struct Population {
  const char* sex;
  double height, height_sd, bust, bust_sd;                 // [mm]
  Spread heights, busts, waists, hips, legs, arms, necks;  // [mm]
  Spread bust_waist, hip_bust, hip_waist, bust_under;      // differences [mm]
  Spread leg_share, arm_share, neck_share;                 // of the height
};

const Population women{"woman",
                       1628,
                       64,
                       947,
                       83,
                       {1483, 1628, 1778},
                       {784, 947, 1160},
                       {665, 861, 1115},
                       {867, 1021, 1206},
                       {685, 782, 888},
                       {478, 544, 611},
                       {329, 371, 423},
                       {-49, 87, 203},
                       {-68, 77, 209},
                       {9, 164, 289},
                       {40, 125, 260},
                       {0.447, 0.480, 0.515},
                       {0.310, 0.333, 0.361},
                       {0.204, 0.227, 0.260}};
const Population men{"man",
                     1756,
                     69,
                     1059,
                     87,
                     {1602, 1756, 1927},
                     {873, 1059, 1276},
                     {725, 941, 1214},
                     {862, 1020, 1218},
                     {747, 846, 960},
                     {523, 593, 670},
                     {381, 435, 502},
                     {-16, 119, 233},
                     {-160, -37, 71},
                     {-63, 82, 193},
                     {0, 55, 120},
                     {0.450, 0.481, 0.519},
                     {0.313, 0.337, 0.363},
                     {0.214, 0.247, 0.286}};

Measurements draw_one(const Population& p, Draw& draw) {
  for (;;) {
    const double height = p.height + p.height_sd * draw.normal(), bust = p.bust + p.bust_sd * draw.normal();
    const double waist = bust - p.bust_waist.drawn(draw), hip = bust + p.hip_bust.drawn(draw);
    const double under = bust - p.bust_under.drawn(draw), leg = height * p.leg_share.drawn(draw);
    const double arm = height * p.arm_share.drawn(draw), neck = height * p.neck_share.drawn(draw);
    const bool usual =
        p.heights.holds(height) && p.busts.holds(bust) && p.waists.holds(waist) && p.hips.holds(hip) &&
        p.legs.holds(leg) && p.arms.holds(arm) && p.necks.holds(neck) && p.bust_waist.holds(bust - waist) &&
        p.hip_bust.holds(hip - bust) && p.hip_waist.holds(hip - waist) && p.bust_under.holds(bust - under) &&
        p.leg_share.holds(leg / height) && p.arm_share.holds(arm / height) && p.neck_share.holds(neck / height);
    if (!usual) continue;
    return {p.sex,      height * 1e-3, bust * 1e-3, under * 1e-3, waist * 1e-3,
            hip * 1e-3, leg * 1e-3,    arm * 1e-3,  neck * 1e-3};
  }
}

}  // namespace

std::vector<Measurements> draw_people(int count, std::uint64_t seed) {
  Draw draw(seed);
  std::vector<Measurements> people;
  for (int i = 0; i < count; ++i) people.push_back(draw_one(i % 2 == 0 ? women : men, draw));
  return people;
}

std::vector<Measurements> corner_people(const char* sex, bool accepted) {
  std::vector<Measurements> people;
  for (unsigned corner = 0; corner < 256; ++corner) {
    const auto end = [corner](int bit, double low, double high) { return (corner >> bit & 1) != 0 ? high : low; };
    const double height = accepted ? end(0, 1.4, 2.1) : end(0, 1.3, 2.2);
    people.push_back(
        {sex, height, accepted ? end(1, 0.7, 1.5) : end(1, 0.65, 1.6), accepted ? end(2, 0.6, 1.3) : end(2, 0.56, 1.45),
         accepted ? end(3, 0.55, 1.45) : end(3, 0.5, 1.6), accepted ? end(4, 0.78, 1.5) : end(4, 0.7, 1.65),
         (accepted ? end(5, 0.41, 0.53) : end(5, 0.38, 0.56)) * height,
         (accepted ? end(6, 0.28, 0.39) : end(6, 0.25, 0.42)) * height,
         accepted ? end(7, 0.30, 0.56) : end(7, 0.27, 0.62)});
  }
  return people;
}

}  // namespace vitrine::bench
