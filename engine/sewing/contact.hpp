// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "cloth.hpp"
#include "springs.hpp"
#include "vitrine/model/body.hpp"

namespace vitrine::sewing {

/// A place of the cloth that must stay outside the body: a node, or the middle of an edge or triangle where the mesh is
/// coarser than the voxels.
struct ContactSample {
  // What most looks need stands first, in one line of the cache.
  int node[3] = {0, 0, 0};
  int count = 1;         ///< nodes that carry it
  double gap = 0;        ///< [m] distance - limit at the last look, or by the plane since
  double seen_path = 0;  ///< [m] of the sample at the last look
  double seen_gap = 0;   ///< [m] at `seen`
  double k = 0;          ///< [N/m] penalty
  double limit = 0;      ///< [m] pushed out below this distance
  bool known = false;
  double share[3] = {1, 0, 0};  ///< [-] barycentric place
  /// What the last look at the field saw: the body's surface there as a plane, good for a hair's breadth around.
  Vec3 seen = Vec3::Zero(), slope = Vec3::Zero();
};

/// Where contact is looked for besides at the nodes.
enum class Middles {
  where_needed,  ///< edges and triangles that the body's curve may reach between their nodes
  all
};

/// Penalty contact against the voxel body (cloth held `offset` above the skin).
struct Contact {
  const DistanceField* field = nullptr;
  double offset = 0;
  std::vector<ContactSample> samples;
  /// Fields are 1-Lipschitz: a sample needs no look before the cloth has travelled through its gap.
  std::vector<double> asleep_until;  ///< [m] of `travelled`, per sample
  std::vector<int> awake;            ///< samples that may touch before `travelled` reaches `call_all`
  double travelled = 0;              ///< [m] sum over the steps so far of the longest a node has made
  double travelled_before = 0, call_all = 0;
  Packed normal;             ///< [N] per node: the body's push on the node, from the last contact_forces()
  std::vector<int> touched;  ///< nodes with a push
  Middles middles = Middles::where_needed;
  double k_most = 0;  ///< [N/m] limit of the refresh
};

/// Samples for a cloth. `load` [N] is the push an ordinary node may have to bear.
Contact make_contact(const Cloth& cloth, const DistanceField& field, double offset, double load, double sheet_k,
                     Middles middles = Middles::where_needed);

/// Adds the body's push to `force`, fills contact.normal and touched, returns the penalty energy [J]. `exact`: with the
/// field itself everywhere, not its planes. `path` [m] per node: how far it has travelled since wake(); no node further
/// than contact.travelled.
double contact_forces(Contact& contact, const Packed& x, const std::vector<double>& path, Packed& force, bool exact);

/// Forgets what earlier looks saw: the cloth was moved by other means.
void wake(Contact& contact);

/// Makes the body strong enough to bear `load` [N] at any place without the cloth sinking in deeper than half the
/// offset.
void strengthen(Contact& contact, double load);

/// Raises the penalty where a sample sinks deeper than a twentieth of the offset; true if it raised any.
bool refresh_contact(Contact& contact);

/// Adds the contact's share to the fictitious masses.
void add_contact_stiffness(const Contact& contact, const Packed& x, std::vector<double>& mass);

/// Moves nodes that start inside the offset out of it: along the field's gradient, or to their panel's own side when
/// the nearest way out would be the wrong one. Returns how many were more than 1 cm deep.
int push_out(Cloth& cloth, const DistanceField& field, double offset);

}  // namespace vitrine::sewing
