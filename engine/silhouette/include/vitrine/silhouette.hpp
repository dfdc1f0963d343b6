// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "vitrine/model/image.hpp"
#include "vitrine/model/result.hpp"
#include "vitrine/photo.hpp"

namespace vitrine {

struct SilhouetteOptions {
  int working_side = 400;     ///< [px] longer side of the picture the models run on
  double min_area = 0.02;     ///< [-] garment / photo area below which the photo is refused (TOO_SMALL)
  double min_contrast = 0.0;  ///< [-] 0 = the room's own gate
};

/// The garment's region in the photo (paper III.A, first half), at the photo's own resolution.
struct Silhouette {
  Image labels;  ///< Label values, 1 channel, the size of Photo::rgb. Without a shop mask no pixel is label_inside
                 ///< yet: the inside of the back is found with the neckline, by the features room.
  std::string method;  ///< "mask", "alpha", "sobel" (the paper's scan found it, colours sharpened it) or "colour" (the
                       ///< scan could not be trusted: the colours along the border started it)
  std::string method_reason;  ///< why the paper's scan was not enough; empty when it was
  double edge_support = 0;    ///< [-] share of the contour that lies on a picture edge
  double contrast = 0;        ///< [-] share of the contour whose two sides differ in colour; the LOW_CONTRAST gate
  std::vector<std::string> warnings;  ///< reason codes of gates that did not refuse
};

/// Sobel 3x3, thinning, first/last edge per row and column, on a picture of working_side; label_background is what the
/// paper's unused colour is. What it finds, or where it fails (low contrast, textured ground) the picture's border,
/// starts a cut of the colours of garment and ground, which is sharpened in a band along its contour and taken to the
/// photo's own size. Hangers, hooks, shadows and loose threads are removed; holes between sleeve and body stay open.
/// Errors (65): LOW_CONTRAST, TOUCHES_FRAME, SEVERAL_GARMENTS, TOO_SMALL, BLURRED.
Result<Silhouette> find_silhouette(const Photo& photo, const SilhouetteOptions& options = {});

}  // namespace vitrine
