// SPDX-License-Identifier: GPL-3.0-or-later
#include "anthropometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace vitrine::body {

namespace {

/// y [mm] = c0 + sum of c_i * measurement [mm], kept within 3.5 standard deviations of the survey's mean share of the
/// stature: a linear rule says little far from the people it was taken from.
struct Rule {
  std::array<double, 8> coefficient;  ///< 1, stature, bust, waist (navel), hip, inside leg, arm, neck base
  double mean, deviation;             ///< [-] of y / stature
};

struct Row {
  double BodyPlan::*size;
  Rule woman, man;
};

// clang-format off
const Row rows[] = {
    {&BodyPlan::c7_height, {{-62, 0.794, -0.005, 0.014, 0.004, 0.175, 0.025, 0.007}, 0.8570, 0.0068}, {{-66, 0.763, 0, 0.039, -0.008, 0.174, 0.081, 0.045}, 0.8639, 0.0066}},
    {&BodyPlan::suprasternal_height, {{-60, 0.73, 0.041, 0.001, 0.028, 0.214, 0.017, -0.117}, 0.8164, 0.0071}, {{-87, 0.767, 0.04, 0.034, -0, 0.151, 0.015, -0.076}, 0.8191, 0.0071}},
    {&BodyPlan::acromion_height, {{-68, 0.762, 0.059, 0.008, 0.001, 0.151, 0.065, -0.15}, 0.8198, 0.0087}, {{-112, 0.74, 0.033, 0.063, -0.035, 0.162, 0.118, -0.029}, 0.8203, 0.0096}},
    {&BodyPlan::axilla_height, {{-70, 0.711, 0.038, -0.017, 0.003, 0.248, -0.01, -0.169}, 0.7607, 0.0092}, {{-91, 0.694, -0.013, 0.037, -0.025, 0.227, 0.06, -0.049}, 0.7567, 0.0090}},
    {&BodyPlan::bust_height, {{-39, 0.585, -0.023, -0.035, 0.008, 0.312, 0.106, -0}, 0.7194, 0.0140}, {{-38, 0.581, 0.046, -0.026, 0.03, 0.324, 0.028, -0.082}, 0.7351, 0.0105}},
    {&BodyPlan::rib_height, {{-56, 0.443, -0.011, 0.015, 0.035, 0.432, 0.062, -0.053}, 0.6485, 0.0111}, {{-71, 0.372, -0.021, 0.042, 0.032, 0.455, 0.192, -0.027}, 0.6380, 0.0120}},
    {&BodyPlan::iliac_height, {{-47, 0.348, -0.019, 0.032, 0.038, 0.544, 0.091, -0.127}, 0.6113, 0.0129}, {{-58, 0.347, -0.03, 0.043, -0.037, 0.492, 0.165, 0.06}, 0.6044, 0.0128}},
    {&BodyPlan::hip_height, {{-6, 0.108, 0.013, 0.077, -0.043, 0.742, 0.128, -0.06}, 0.5118, 0.0156}, {{-32, 0.107, -0.002, 0.056, -0.082, 0.774, 0.138, 0.065}, 0.5054, 0.0164}},
    {&BodyPlan::knee_height, {{-37, 0.058, 0.001, 0.018, -0.002, 0.416, 0.078, 0.024}, 0.2756, 0.0090}, {{-39, 0.054, 0.008, 0.027, -0.018, 0.422, 0.106, -0.006}, 0.2780, 0.0092}},
    {&BodyPlan::biacromial, {{64, 0.111, 0.006, -0.01, 0.004, -0.026, 0.099, 0.227}, 0.2244, 0.0111}, {{63, 0.084, 0.105, -0.082, 0.051, -0.03, 0.105, 0.191}, 0.2368, 0.0108}},
    {&BodyPlan::hip_breadth, {{-4, 0.082, -0.005, -0.003, 0.345, -0.086, -0.023, -0.109}, 0.2174, 0.0166}, {{18, 0.063, -0.022, 0.022, 0.288, -0.06, 0.012, -0.071}, 0.1970, 0.0137}},
    {&BodyPlan::hip_depth, {{9, -0.109, 0.011, 0.052, 0.222, 0.118, -0.003, 0.075}, 0.1431, 0.0147}, {{-14, -0.03, 0.007, 0.073, 0.208, 0.03, -0.048, 0.063}, 0.1401, 0.0148}},
    {&BodyPlan::waist_breadth, {{-32, 0.101, 0.008, 0.295, 0.023, -0.098, -0.035, -0.06}, 0.1842, 0.0203}, {{-5, 0.062, 0.029, 0.251, 0.061, -0.053, -0.034, -0.095}, 0.1860, 0.0200}},
    {&BodyPlan::waist_depth, {{16, -0.124, 0.001, 0.286, 0.008, 0.11, 0.051, 0.078}, 0.1309, 0.0191}, {{2, -0.05, -0.021, 0.334, -0.047, 0.038, 0.032, 0.065}, 0.1355, 0.0199}},
    {&BodyPlan::neck_girth, {{50, -0.034, 0.036, 0.027, 0.003, 0.018, 0.003, 0.699}, 0.2027, 0.0117}, {{45, -0.055, 0.04, 0.015, 0.014, 0.028, 0.021, 0.788}, 0.2267, 0.0148}},
    {&BodyPlan::biceps_girth, {{-12, -0.102, 0.085, 0.035, 0.193, 0.131, -0.049, 0.269}, 0.1878, 0.0190}, {{-21, -0.096, 0.247, -0.127, 0.224, 0.139, -0.102, 0.278}, 0.2041, 0.0200}},
    {&BodyPlan::forearm_girth, {{18, -0.025, 0.035, 0.004, 0.096, 0.07, -0.015, 0.283}, 0.1623, 0.0117}, {{-0, -0.017, 0.13, -0.076, 0.114, 0.058, -0.022, 0.28}, 0.1767, 0.0125}},
    {&BodyPlan::wrist_girth, {{16, 0.046, 0.011, -0, 0.018, -0.008, -0.004, 0.117}, 0.0951, 0.0049}, {{19, 0.048, 0.022, -0.008, 0.028, -0.023, 0.016, 0.091}, 0.1002, 0.0051}},
    {&BodyPlan::thigh_girth, {{-20, -0.14, -0.016, 0.006, 0.707, 0.158, -0.005, 0.084}, 0.3785, 0.0344}, {{-16, -0.132, 0.043, -0.037, 0.748, 0.138, -0.053, 0.035}, 0.3562, 0.0331}},
    {&BodyPlan::lower_thigh_girth, {{-3, -0.045, -0.021, -0.029, 0.402, 0.122, -0.102, 0.189}, 0.2462, 0.0215}, {{23, 0.01, 0.034, -0.01, 0.331, 0.013, -0.045, 0.046}, 0.2332, 0.0182}},
    {&BodyPlan::calf_girth, {{17, 0.038, 0.016, -0.041, 0.275, 0.004, -0.07, 0.182}, 0.2293, 0.0178}, {{46, 0.01, 0.081, -0.039, 0.262, -0.019, -0.011, 0.081}, 0.2235, 0.0171}},
    {&BodyPlan::ankle_girth, {{29, 0.092, 0, -0.014, 0.094, -0.042, -0.079, 0.08}, 0.1326, 0.0092}, {{28, 0.056, 0.028, -0.034, 0.125, -0.016, -0.047, 0.044}, 0.1307, 0.0086}},
    {&BodyPlan::hand_length, {{21, 0.003, 0.002, -0.009, 0.017, 0.085, 0.095, 0.071}, 0.1112, 0.0061}, {{18, 0.031, 0.009, -0.009, 0.007, 0.048, 0.087, 0.05}, 0.1101, 0.0057}},
    {&BodyPlan::hand_breadth, {{22, 0.016, 0.007, -0.006, 0.005, -0.006, 0.02, 0.048}, 0.0480, 0.0025}, {{20, 0.019, 0.014, -0.01, 0.01, -0.002, 0.01, 0.033}, 0.0503, 0.0023}},
    {&BodyPlan::foot_length, {{20, 0.043, 0.004, -0.01, 0.025, 0.089, 0.072, 0.072}, 0.1513, 0.0074}, {{20, 0.057, 0.017, -0.027, 0.039, 0.069, 0.068, 0.047}, 0.1544, 0.0074}},
    {&BodyPlan::foot_breadth, {{32, 0.013, 0.003, -0.002, 0.012, 0.009, 0.002, 0.052}, 0.0570, 0.0031}, {{26, 0.014, 0.014, -0.016, 0.03, 0.007, 0.01, 0.018}, 0.0580, 0.0028}},
    {&BodyPlan::head_breadth, {{115, 0.014, -0.002, 0.005, -0.005, -0.017, 0.006, 0.061}, 0.0909, 0.0031}, {{121, 0, 0.012, -0.012, 0.015, -0.01, 0.001, 0.053}, 0.0880, 0.0034}},
    {&BodyPlan::head_depth, {{116, 0.009, -0, -0.008, 0.018, 0.031, 0.008, 0.055}, 0.1167, 0.0043}, {{116, 0.034, 0.009, -0.008, 0.013, -0.004, -0.008, 0.04}, 0.1137, 0.0040}},};
// clang-format on

Error implausible(const std::string& name, double value, double low, double high, const char* what) {
  char text[200];
  // A slip of the unit is seen by its digits: 1.68 mm, not 2 mm.
  const bool usual = value >= 0.1 && value < 100;
  std::snprintf(text, sizeof text,
                usual ? "%s of %.0f mm is outside %.0f to %.0f mm" : "%s of %.4g mm is outside %.0f to %.0f mm",
                name.c_str(), value * 1e3, low * 1e3, high * 1e3);
  return Error{Cause::unusable, "IMPLAUSIBLE_MEASUREMENTS", std::string(text) + what + ".",
               "Give " + name + " within that range, in the unit the setting asks for.", ""};
}

}  // namespace

double navel_girth(const Measurements& m) {
  return m.waist + std::max(0.0, (m.sex == "woman" ? 0.22 : 0.12) * (m.hip - m.waist));
}

BodyPlan plan_body(const Measurements& m) {
  const bool woman = m.sex == "woman";
  const double navel = navel_girth(m);
  const double input[8] = {1,           m.height * 1e3,     m.bust * 1e3, navel * 1e3,
                           m.hip * 1e3, m.inside_leg * 1e3, m.arm * 1e3,  m.neck_base * 1e3};
  BodyPlan plan;
  for (const Row& row : rows) {
    const Rule& rule = woman ? row.woman : row.man;
    double sum = 0;
    for (int i = 0; i < 8; ++i) sum += rule.coefficient[i] * input[i];
    const double share = sum * 1e-3 / m.height;
    plan.*row.size = m.height * std::clamp(share, rule.mean - 3.5 * rule.deviation, rule.mean + 3.5 * rule.deviation);
  }
  return plan;
}

Result<bool> check_measurements(const Measurements& m) {
  if (m.sex != "woman" && m.sex != "man")
    return Error{Cause::unusable, "IMPLAUSIBLE_MEASUREMENTS", "Sex \"" + m.sex + "\" is not one of woman, man.",
                 "Give woman or man: they differ in where landmarks lie and how girths are shaped.", ""};
  struct Range {
    const char* name;
    double value, low, high;
    const char* what;
  };
  const double h = m.height;
  const Range ranges[] = {
      {"height", h, 1.4, 2.1, ""},
      {"bust", m.bust, 0.7, 1.5, ""},
      {"under_bust", m.under_bust, 0.6, 1.3, ""},
      {"waist", m.waist, 0.55, 1.45, ""},
      {"hip", m.hip, 0.78, 1.5, ""},
      {"inside_leg", m.inside_leg, 0.41 * h, 0.53 * h, " (41 to 53 % of the height)"},
      {"arm", m.arm, 0.28 * h, 0.39 * h, " (28 to 39 % of the height)"},
      {"neck_base", m.neck_base, 0.30, 0.56, ""},
      {"under_bust", m.under_bust, std::max(0.6, m.bust - (m.sex == "woman" ? 0.40 : 0.20)),
       std::min(1.3, m.bust + 0.02), " for this bust"},
      {"waist", m.waist, std::max(0.55, m.bust - 0.45), std::min(1.45, m.bust + 0.30), " for this bust"},
      {"hip", m.hip, std::max(0.78, m.waist - 0.25), std::min(1.5, m.waist + 0.55), " for this waist"},
      {"hip", m.hip, std::max(0.78, m.bust - 0.35), std::min(1.5, m.bust + 0.45), " for this bust"},
  };
  // Half a millimetre of grace: 41 % of a height is rarely a round number.
  for (const Range& r : ranges)
    if (!(r.value >= r.low - 5e-4 && r.value <= r.high + 5e-4))
      return implausible(r.name, r.value, r.low, r.high, r.what);
  return true;
}

}  // namespace vitrine::body
