// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <memory>
#include <optional>

#include "vitrine/accuracy.hpp"

namespace vitrine::accuracy {

using Bodies = std::map<double, std::shared_ptr<const Body>>;  ///< by the edge of their voxels [m]

/// Rows as a forked process sends them to the one that waits for them.
Bytes to_bytes(const Measurement& part);
std::optional<Measurement> measurement_from(const Bytes& bytes);
void append(Measurement& all, const Measurement& part);

}  // namespace vitrine::accuracy
