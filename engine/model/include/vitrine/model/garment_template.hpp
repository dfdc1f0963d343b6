// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "vitrine/model/geometry.hpp"

namespace vitrine {

/// The engine's own copy of what a plugin supplies. The engine never meets a plugin: the host copies and checks the ABI
/// tables once, when it adopts a plugin.
///
/// The *front frame*: everything is named by the sides of the FRONT picture ("left" = left in the front photo = the
/// wearer's right, x < 0). Back photos are mirrored when they are loaded, so that both panels share this frame and a
/// seam joins edges of the same name.

enum class Side { front = 0, back = 1 };

/// Which way the outline turns at a feature when it is walked clockwise in the picture.
enum class Turn { concave = -1, any = 0, convex = 1 };

struct TemplateFeature {
  std::string name;      ///< e.g. "armpit_left"
  std::string landmark;  ///< body landmark of the mannequin (Table I), e.g. "shoulder_left"; may be empty
  int mirror = -1;       ///< index of the partner on the other side; itself when on the middle line
  Turn turn = Turn::any;
};

/// One way in which a garment lies on its board (sleeves down, sleeves spread): the paper's template proper. The
/// matcher tries each pose and keeps the best.
struct TemplatePose {
  std::string name;
  std::vector<Vec2> uv;  ///< per feature: position in the silhouette's bounding box, (0,0) top left, (1,1) bottom right
  std::vector<double> radius;  ///< per feature: search radius, as a share of the box diagonal
};

enum class EdgeKind {
  seam,  ///< sewn to an edge of the other (or the same) panel
  open,  ///< hem, cuff, armhole, waist: stays open
  neck   ///< open; a neckline plugin shapes it
};

/// Part of a panel's outline between two features. Edges stand in clockwise picture order and close the outline.
struct TemplateEdge {
  std::string name;
  int from = 0, to = 0;  ///< feature indices
  EdgeKind kind = EdgeKind::open;
};

struct TemplateSeam {
  Side side_a = Side::front, side_b = Side::back;
  int edge_a = 0, edge_b = 0;
  bool reversed = false;  ///< false: both edges run from partner to partner in the same direction
};

/// A tube that follows a limb of the body (a sleeve, a trouser leg). Fit turns the panel beyond the root line from the
/// flat axis (middle of root to middle of tip) to the body's chain of landmarks.
struct TemplateLimb {
  std::string name;
  int root_a = 0, root_b = 0;      ///< features that span the root line, e.g. shoulder_left, armpit_left
  int tip_a = 0, tip_b = 0;        ///< features that span the tip, e.g. cuff_upper_left, cuff_lower_left
  std::vector<std::string> chain;  ///< body landmarks from root to tip, e.g. shoulder_left, elbow_left, wrist_left
};

/// How large the garment is when the shop gives no measurement: the distance of two features, doubled (front and back),
/// is the body girth times `ease`.
struct ScaleRule {
  int feature_a = 0, feature_b = 0;  ///< also what --chest-cm (or the waist of a skirt) measures
  std::string girth;                 ///< body girth: "bust", "waist", "hip"
  double ease = 1.0;                 ///< [-] garment girth / body girth
  int top = 0, bottom = 0;           ///< features between which --length-cm is measured (vertical distance)
};

/// A sheet material. k and m as in the paper's eq. (2), spread over the mesh so that they mean the same at every size.
struct Fabric {
  std::string name;
  double stretch = 0;   ///< [N/m] sheet tension stiffness
  double shear = 0;     ///< [N/m]
  double bend = 0;      ///< [N m] bending stiffness (Peirce flexural rigidity per width)
  double mass = 0;      ///< [kg/m^2]
  double friction = 0;  ///< [-] Coulomb, against the body
};

struct GarmentTemplate {
  std::string id;       ///< e.g. "vest"
  std::string plugin;   ///< reverse URI of the plugin it came from
  std::string version;  ///< of the plugin
  std::string title;
  std::vector<TemplateFeature> features;
  std::vector<TemplatePose> poses;
  std::vector<TemplateEdge> edges;  ///< the same outline for front and back
  std::vector<TemplateSeam> seams;
  std::vector<TemplateLimb> limbs;
  ScaleRule scale;
  std::vector<Fabric> fabrics;  ///< the first is the default
  /// Feature whose height hangs on its body landmark when the panel is placed (e.g. neck_left on neck_left).
  std::vector<int> anchors;
  int neck_edge() const {
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (edges[i].kind == EdgeKind::neck) return static_cast<int>(i);
    return -1;
  }
};

/// A neckline in the neck edge's own coordinates: s runs from the edge's first feature (0) to its last (1), depth is
/// measured towards the hem as a share of the neckline's depth (0 at the shoulder line, 1 at the lowest point).
struct NecklineTemplate {
  std::string id;  ///< e.g. "neck_u"
  std::string plugin;
  std::string version;
  std::string title;
  std::vector<Vec2> profile;  ///< (s, depth), s ascending from 0 to 1
  /// Foreground/background ratio of the neck area that selects this neckline, [min, max). Paper III.A: near 1 for V,
  /// near 0 for square, in between for U.
  double ratio_min = 0, ratio_max = 0;
  double default_depth = 0.6;  ///< usual depth / neck width; tells necklines of one ratio range apart
};

}  // namespace vitrine
