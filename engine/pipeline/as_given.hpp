// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "vitrine/pipeline.hpp"

namespace vitrine {

/// A picture of the photo's working size with its sides as in the photo as given.
Image as_given(const Photo& photo, const Image& image);

/// A pixel of the working picture (front frame) as a pixel of the photo as given.
Vec2 pixel_as_given(const Photo& photo, Vec2 p);

/// Labels at another size.
Image resize_labels(const Image& labels, int width, int height);

/// The latest labels that the rooms left; empty when there are none.
const Image& labels_of(const View& view);

/// Entries that the reports of one photo and of an item have in common.
nlohmann::ordered_json point_json(const NamedPoint& point);
nlohmann::ordered_json silhouette_json(const Silhouette& silhouette);
nlohmann::ordered_json neckline_json(const NecklineChoice& neckline);

}  // namespace vitrine
