// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vitrine/export.hpp"
#include "vitrine/features.hpp"
#include "vitrine/mannequin.hpp"
#include "vitrine/mesh.hpp"
#include "vitrine/model/garment.hpp"
#include "vitrine/panels.hpp"
#include "vitrine/photo.hpp"
#include "vitrine/sewing.hpp"
#include "vitrine/silhouette.hpp"

namespace vitrine {

/// How much work one item may cost: node counts (both panels) of the mesh levels, and the force residual to stop at.
enum class Quality { draft, standard, fine };

/// A mannequin with its voxels, made once and shared by every item that is dressed on it.
struct Body {
  Mannequin mannequin;
  DistanceField field;
};

struct ConvertRequest {
  std::string name = "garment";  ///< SKU or any label; goes into asset extras
  std::string front, back;       ///< photo files; back may be empty with mirror_back
  std::string front_mask, back_mask;
  bool mirror_back = false;  ///< make the back panel from the front photo's silhouette
  GarmentTemplate garment;
  std::vector<NecklineTemplate> necklines;
  std::string neckline = "auto";
  std::string fabric;            ///< name of one of the garment's fabrics; empty = its first
  double chest = 0, length = 0;  ///< [m] flat measurements as the shop lists them; 0 = unknown
  Quality quality = Quality::standard;
  bool debug_images = false;
  bool obj = false;  ///< also write garment.obj
  std::shared_ptr<const Body> body;
  std::string version;                                                   ///< of the program, for the report
  std::function<void(const std::string& stage, double share)> progress;  ///< may be empty; share in 0..1
};

/// What every room left behind for one item; `error` is set when a room refused, and later rooms are then empty.
struct Conversion {
  std::optional<Error> error;
  Photo front_photo, back_photo;
  Silhouette front_silhouette, back_silhouette;
  Features front_features, back_features;
  Panels panels;
  Pattern pattern;  ///< of the finest level
  Fabric fabric;
  Drape drape;
  RenderMesh garment, mannequin;
  Bytes garment_glb, dressed_glb, preview_png;
  std::vector<std::string> warnings;
  std::vector<std::pair<std::string, double>> stage_ms;  ///< [ms] of processor time per room, in order
  int exit_code() const { return error ? error->exit_code() : 0; }
};

/// One garment, from two photos to files in memory: the rooms in their order.
Conversion convert(const ConvertRequest& request);

/// report.json: status, reason, features in pixels of the photos as given, mesh and drape figures, milliseconds per
/// room.
std::string report_json(const ConvertRequest& request, const Conversion& conversion);

/// Writes garment.glb, dressed.glb, preview.png, report.json (and debug-*.png, garment.obj when asked) into `folder`,
/// each by rename. A refused item writes report.json and the debug pictures it got to.
std::optional<Error> write_conversion(const ConvertRequest& request, const Conversion& conversion,
                                      const std::string& folder);

/// Pictures of what was seen: silhouette, candidates, feature points; and the mesh of a panel.
Image draw_features(const Photo& photo, const Silhouette& silhouette, const Features& features);
Image draw_mesh(const PanelMesh& mesh, int height = 900);

}  // namespace vitrine
