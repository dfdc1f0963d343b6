// SPDX-License-Identifier: GPL-3.0-or-later
#include "residual.hpp"

namespace vitrine::sewing {

Vec3 outside_cone(const Vec3& force, const Vec3& push, double mu) {
  const double load = push.norm();
  if (!(load > 0) || mu == 0) return force;
  const Vec3 n = push / load;
  const double along = force.dot(n);
  const Vec3 tangent = force - along * n;
  const double t = tangent.norm(), held = mu * load;
  return along * n + (t > held ? Vec3(tangent * ((t - held) / t)) : Vec3(Vec3::Zero()));
}

double residual_of(const Cloth& c, Contact* contact, double friction, Layers* layers) {
  std::vector<double> cloth_force(c.x.size(), 0.0);
  internal_forces(c, c.x, cloth_force);
  Packed x, force;
  pack(c.x, x);
  pack(cloth_force, force);
  if (layers) {
    layers->look(x);
    layers->forces(x, force);
  }
  if (contact) {
    wake(*contact);
    contact_forces(*contact, x, std::vector<double>(packed_nodes(c.size), 0.0), force, true);
  }
  double sum = 0;
  for (int n = 0; n < c.size; ++n) {
    if (c.pinned[n]) continue;
    const Vec3 push = contact ? at(contact->normal, n) : Vec3(Vec3::Zero());
    sum += outside_cone(at(force, n), push, friction).norm();
  }
  return sum / c.scale;
}

}  // namespace vitrine::sewing
