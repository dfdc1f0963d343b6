// SPDX-License-Identifier: GPL-3.0-or-later
#include "effects.hpp"

#include <algorithm>

#include "text.hpp"

namespace vitrine::sewing {
namespace {

std::string found(const SelfContact& s) {
  return text("%d places of front and back touch, %d have crossed, by up to %.1f mm", s.close, s.crossed,
              1000 * s.depth);
}

}  // namespace

double share_in_reach(const Positions& positions, const DistanceField& body) {
  Vec3 lo = positions[0][0], hi = lo;
  for (const auto& panel : positions)
    for (const Vec3& p : panel) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
  double share = 1;
  for (int a = 0; a < 3; ++a) {
    const double length = body.spacing * (body.size[a] - 1);
    const double from = std::clamp(lo[a] - body.origin[a], 0.0, length),
                 to = std::clamp(hi[a] - body.origin[a], 0.0, length);
    share *= (to - from) / length;
  }
  return share;
}

void list_effects(const SewingOptions& options, const SceneNotes& notes, Drape& out) {
  auto& modelled = out.modelled;
  auto& skipped = out.skipped;
  modelled = {options.spring_k > 0
                  ? "springs of one k each (paper eq. (2)), as asked: the mesh decides what cloth it is"
                  : "tension and shear springs (paper eq. (2)), k spread over the mesh by area",
              options.node_mass > 0 ? "nodes of one mass each, as asked" : "weight by area",
              "seams drawn together and welded", "contact with the voxel body at the skin offset"};
  skipped.push_back(
      text("contact out of the garment's reach: %.0f %% of the voxels, other parts of the body among them",
           100 * (1 - notes.voxels_in_reach)));
  if (options.bending && notes.bend > 0)
    modelled.push_back("bending, also across seams, and stiffer in hems and bands");
  else
    skipped.push_back(options.bending ? "bending: the fabric's bending stiffness is 0" : "bending: switched off");
  if (options.friction && notes.friction > 0)
    modelled.push_back("Coulomb friction with the body, quasi-static");
  else
    skipped.push_back(options.friction ? "friction: the fabric's coefficient is 0" : "friction: switched off");
  if (out.stiffness_cap > 0)
    skipped.push_back(text("stiffness above %.4g N/m: the cloth's own weight already stretches it by less than %.2g %%",
                           out.stiffness_cap, 100 * options.max_weight_strain));
  if (options.contact_between_nodes)
    modelled.push_back("contact of all edges and triangles between their nodes, as asked");
  else if (notes.cut_in)
    modelled.push_back("contact of all edges and triangles between their nodes: at first they cut into the body");
  else if (notes.between_nodes > 0)
    modelled.push_back(
        text("contact of edges and triangles between their nodes, in %d places where the body turns under them",
             notes.between_nodes));
  if (!notes.cut_in && !options.contact_between_nodes)
    skipped.push_back("contact between nodes elsewhere: the edges are short enough to follow the body");
  if (options.front_back == FrontBack::always) {
    modelled.push_back("contact of front and back, as asked; now " + found(notes.left));
  } else if (options.front_back == FrontBack::never) {
    skipped.push_back("contact of front and back: switched off; " + found(notes.left));
  } else if (notes.crossed.crossed > 0) {
    modelled.push_back("contact of front and back: at first " + found(notes.crossed) + "; now " + found(notes.left));
  } else if (notes.left.close == 0) {
    skipped.push_back("contact of front and back: the body parts them, and no two places touch");
  } else {
    skipped.push_back("contact of front and back: they lie on each other without crossing; " + found(notes.left));
  }
  skipped.push_back("folds of one panel on itself: the bending of the cloth alone holds them apart");
  skipped.push_back("motion: only the rest shape is computed");
}

}  // namespace vitrine::sewing
