// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "cloth.hpp"
#include "vitrine/model/body.hpp"

namespace vitrine::sewing {

/// A place of the cloth that must stay outside the body: a node, or the middle of an edge or triangle where the mesh is
/// coarser than the voxels.
struct ContactSample {
  int node[3] = {0, 0, 0};
  int count = 1;                ///< nodes that carry it
  double share[3] = {1, 0, 0};  ///< [-] barycentric place
  double k = 0;                 ///< [N/m] penalty
  double limit = 0;             ///< [m] pushed out below this distance
  // What the last look at the field saw; fields are 1-Lipschitz, so a sample needs no second look before it has
  // travelled through the gap.
  double gap = 0;        ///< [m] distance - limit, then
  double travelled = 0;  ///< [m] path of its nodes, then
};

/// Penalty contact against the voxel body (cloth held `offset` above the skin).
struct Contact {
  const DistanceField* field = nullptr;
  double offset = 0;
  std::vector<ContactSample> samples;
  std::vector<double> path;    ///< [m] per node: travelled so far
  std::vector<double> normal;  ///< [N] 3 per node: the body's push on the node, from the last forces()
  double k_most = 0;           ///< [N/m] limit of the refresh
};

/// Samples for a cloth of the given edge length. `load` [N] is the push an ordinary node may have to bear.
Contact make_contact(const Cloth& cloth, const DistanceField& field, double offset, double edge_length, double load,
                     double sheet_k);

/// Adds the body's push to `force`, fills contact.normal, returns the penalty energy [J]. `fresh`: looks at every
/// sample.
double contact_forces(Contact& contact, const std::vector<double>& x, std::vector<double>& force, bool fresh);

/// Makes the body strong enough to bear `load` [N] at any place without the cloth sinking in deeper than half the
/// offset.
void strengthen(Contact& contact, double load);

/// Raises the penalty where a sample sinks deeper than a twentieth of the offset; true if it raised any.
bool refresh_contact(Contact& contact, const std::vector<double>& x);

/// Adds the contact's share to the fictitious masses.
void add_contact_stiffness(const Contact& contact, const std::vector<double>& x, std::vector<double>& mass);

/// Moves nodes that start inside the offset out of it: along the field's gradient, or to their panel's own side when
/// the nearest way out would be the wrong one. Returns how many were more than 1 cm deep.
int push_out(Cloth& cloth, const DistanceField& field, double offset);

}  // namespace vitrine::sewing
