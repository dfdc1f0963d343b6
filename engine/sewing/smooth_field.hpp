// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "vitrine/model/body.hpp"

namespace vitrine::sewing {

/// Distance [m] and its exact gradient from quadratic B-splines over 27 voxels: the slope is continuous. With the
/// trilinear field a node that slides without friction is caught for ever in the creases between voxels. Outside the
/// grid and in its outermost voxels: the trilinear field.
double smooth_distance(const DistanceField& field, const Vec3& p, Vec3& gradient);

}  // namespace vitrine::sewing
