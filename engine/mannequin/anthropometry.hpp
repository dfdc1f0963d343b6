// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "vitrine/mannequin.hpp"

namespace vitrine::body {

/// Sizes of a person that the eight measurements do not give [m], predicted from them by regression on the ANSUR II
/// survey (Gordon et al., NATICK/TR-15/007, 2014; 1,986 women and 4,082 men).
struct BodyPlan {
  double c7_height = 0, suprasternal_height = 0, acromion_height = 0, axilla_height = 0, bust_height = 0;
  double rib_height = 0, iliac_height = 0, hip_height = 0, knee_height = 0;
  double biacromial = 0, hip_breadth = 0, hip_depth = 0, waist_breadth = 0, waist_depth = 0;
  double neck_girth = 0, biceps_girth = 0, forearm_girth = 0, wrist_girth = 0;
  double thigh_girth = 0, lower_thigh_girth = 0, calf_girth = 0, ankle_girth = 0;
  double hand_length = 0, hand_breadth = 0, foot_length = 0, foot_breadth = 0, head_breadth = 0, head_depth = 0;
  double waist_height() const { return 0.5 * (rib_height + iliac_height); }  ///< ISO 8559-1: midway rib to iliac crest
};

/// Girth at the navel, where the survey took the waist [m]: more than the natural waist of a body whose hips are wider.
double navel_girth(const Measurements& m);

BodyPlan plan_body(const Measurements& m);

/// Refuses what no mannequin can be: IMPLAUSIBLE_MEASUREMENTS naming the measurement and the range that would work.
Result<bool> check_measurements(const Measurements& m);

}  // namespace vitrine::body
