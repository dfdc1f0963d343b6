// SPDX-License-Identifier: GPL-3.0-or-later
// Garments that the project draws itself, dressed with every setting open: what a command line does not let through as
// well.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "case_runner.hpp"
#include "photo_maker.hpp"
#include "vitrine/fit.hpp"
#include "vitrine/host/registry.hpp"
#include "vitrine/pipeline.hpp"

namespace vitrine::bench {

/// Front and back as files, and what they show.
struct DrawnGarment {
  std::string front, back;
  support::GarmentKind kind = support::GarmentKind::vest;
};

/// Draws both photos of a garment into `folder`.
DrawnGarment draw_garment(support::GarmentKind kind, const std::string& folder);

/// A photo as a PNG in `folder`; the name without ending.
std::string write_png(const std::string& folder, const std::string& name, const Image& picture);

/// All of what trades speed for accuracy, or breaks it.
struct Dressing {
  std::vector<int> level_nodes{300};  ///< both panels, coarse to fine
  SewingOptions sewing;
  Fabric fabric;  ///< empty name: the garment's first
  Dressing() { sewing.residual = 1e-2; }
};

/// Seen once, with feature points on both sides; throws when the drawn garment is refused, which is no case.
struct SeenGarment {
  GarmentTemplate garment;
  Conversion seen;
};
SeenGarment see_garment(const DrawnGarment& drawn, const PluginRegistry& registry, std::shared_ptr<const Body> body);

/// The rooms from panels to sewing.
Result<Drape> dress_garment(const SeenGarment& item, const Body& body, const Dressing& dressing);

/// A drape's figures, or the refusal.
Outcome outcome_of(const Result<Drape>& drape);
Outcome outcome_of(const Error& error);

}  // namespace vitrine::bench
