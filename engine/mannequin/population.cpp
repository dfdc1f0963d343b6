// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstdio>
#include <optional>

#include "anthropometry.hpp"
#include "vitrine/mannequin.hpp"

namespace vitrine {

namespace {

struct Preset {
  const char* name;
  double mm[8];  ///< height, bust, under_bust, waist, hip, inside_leg, arm, neck_base
};

// Girths step like shops' size tables (EN 13402-3); lengths and neck follow them as in the ANSUR II survey.
const Preset woman[] = {
    {"xs", {1640, 800, 690, 650, 880, 785, 545, 345}},   {"s", {1660, 850, 730, 695, 930, 795, 552, 353}},
    {"m", {1680, 900, 770, 745, 980, 805, 560, 362}},    {"l", {1690, 980, 840, 830, 1055, 808, 566, 374}},
    {"xl", {1700, 1070, 920, 930, 1135, 810, 572, 388}}, {"xxl", {1705, 1170, 1010, 1040, 1225, 812, 577, 403}}};
const Preset man[] = {
    {"xs", {1700, 860, 825, 720, 870, 815, 572, 395}},     {"s", {1730, 920, 880, 780, 925, 830, 582, 410}},
    {"m", {1770, 990, 945, 850, 990, 852, 597, 426}},      {"l", {1800, 1070, 1018, 940, 1050, 866, 608, 442}},
    {"xl", {1815, 1160, 1100, 1040, 1115, 872, 614, 460}}, {"xxl", {1825, 1260, 1190, 1150, 1190, 875, 618, 480}}};

/// 1 % and 99 % of the people in the survey, and what the figure is called.
struct Usual {
  const char* what;
  double value;  ///< [mm], or [-] for a share of the height
  double low, high;
};

std::string sentence(const Usual& u, const char* people) {
  char text[200];
  if (u.high < 1.0)
    std::snprintf(text, sizeof text, "%s is %.3f of the height; 98 %% of %s have %.3f to %.3f", u.what, u.value, people,
                  u.low, u.high);
  else
    std::snprintf(text, sizeof text, "%s is %.0f mm; 98 %% of %s have %.0f to %.0f mm", u.what, u.value, people, u.low,
                  u.high);
  return text;
}

}  // namespace

Result<Measurements> preset_measurements(const std::string& name) {
  for (const char* sex : {"woman", "man"})
    for (const Preset& p : std::string(sex) == "woman" ? woman : man)
      if (name == std::string(sex) + "-" + p.name)
        return Measurements{sex,
                            p.mm[0] * 1e-3,
                            p.mm[1] * 1e-3,
                            p.mm[2] * 1e-3,
                            p.mm[3] * 1e-3,
                            p.mm[4] * 1e-3,
                            p.mm[5] * 1e-3,
                            p.mm[6] * 1e-3,
                            p.mm[7] * 1e-3};
  return Error{Cause::usage, "UNKNOWN_PRESET", "There is no mannequin preset \"" + name + "\".",
               "Choose woman- or man- with xs, s, m, l, xl or xxl, for instance woman-m.", ""};
}

std::vector<std::string> unusual_measurements(const Measurements& m) {
  const bool w = m.sex == "woman";
  const double h = m.height, navel = body::navel_girth(m);
  const auto pick = [w](double woman_low, double woman_high, double man_low, double man_high) {
    return w ? std::array{woman_low, woman_high} : std::array{man_low, man_high};
  };
  const auto mm = [](const char* what, double metres, std::array<double, 2> range) {
    return Usual{what, metres * 1e3, range[0], range[1]};
  };
  const auto share = [h](const char* what, double metres, std::array<double, 2> range) {
    return Usual{what, metres / h, range[0], range[1]};
  };
  const Usual rows[] = {
      mm("height", h, pick(1483, 1778, 1602, 1927)),
      mm("bust", m.bust, pick(784, 1160, 873, 1276)),
      mm("waist (at the navel)", navel, pick(665, 1115, 725, 1214)),
      mm("hip", m.hip, pick(867, 1206, 862, 1218)),
      mm("neck_base", m.neck_base, pick(329, 423, 381, 502)),
      share("inside_leg", m.inside_leg, pick(0.447, 0.515, 0.450, 0.519)),
      share("arm", m.arm, pick(0.310, 0.361, 0.313, 0.363)),
      share("neck_base", m.neck_base, pick(0.204, 0.260, 0.214, 0.286)),
      mm("bust minus under_bust", m.bust - m.under_bust, pick(40, 260, 0, 120)),
      mm("bust minus waist (at the navel)", m.bust - navel, pick(-49, 203, -16, 233)),
      mm("hip minus bust", m.hip - m.bust, pick(-68, 209, -160, 71)),
      mm("hip minus waist (at the navel)", m.hip - navel, pick(9, 289, -63, 193)),
  };
  std::vector<std::string> unusual;
  for (const Usual& row : rows) {
    const double grace = row.high < 1.0 ? 5e-4 : 0.5;  // as many digits as the sentence shows
    if (row.value < row.low - grace || row.value > row.high + grace)
      unusual.push_back(sentence(row, w ? "women" : "men"));
  }
  return unusual;
}

}  // namespace vitrine
