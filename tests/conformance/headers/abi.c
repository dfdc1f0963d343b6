/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "vitrine/abi.h"

/* The sizes on every 64-bit machine; the host's reader knows them as those of ABI 1.0. */
_Static_assert(sizeof(vitrine_name) == 8, "vitrine_name");
_Static_assert(sizeof(vitrine_feature) == 32, "vitrine_feature");
_Static_assert(sizeof(vitrine_pose_point) == 32, "vitrine_pose_point");
_Static_assert(sizeof(vitrine_pose) == 24, "vitrine_pose");
_Static_assert(sizeof(vitrine_edge) == 32, "vitrine_edge");
_Static_assert(sizeof(vitrine_seam) == 32, "vitrine_seam");
_Static_assert(sizeof(vitrine_limb) == 56, "vitrine_limb");
_Static_assert(sizeof(vitrine_scale_rule) == 48, "vitrine_scale_rule");
_Static_assert(sizeof(vitrine_fabric) == 48, "vitrine_fabric");
_Static_assert(sizeof(vitrine_garment) == 144, "vitrine_garment");
_Static_assert(sizeof(vitrine_profile_point) == 16, "vitrine_profile_point");
_Static_assert(sizeof(vitrine_neckline) == 56, "vitrine_neckline");
_Static_assert(sizeof(vitrine_plugin) == 80, "vitrine_plugin");
