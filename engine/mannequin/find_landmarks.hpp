// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "vitrine/model/body.hpp"
#include "vitrine/model/result.hpp"

namespace vitrine::body {

/// Fills landmarks and girths of a closed mesh that stands on y = 0 and faces +Z, from plane sections of it. The mesh
/// is moved so that the trunk's middle lies on x = z = 0. Error NOT_A_BODY names `path` and the part that was not
/// found.
Result<bool> find_landmarks(Mannequin& body, const std::string& path);

}  // namespace vitrine::body
