// SPDX-License-Identifier: GPL-3.0-or-later
#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <new>

#include "vitrine/rays.hpp"

namespace vitrine {

struct Tracer::Scene {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~Scene() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

Error failed(const std::string& message) {
  return {Cause::internal, "RAYS_FAILED", message, "Report this with the photos that caused it.", "rays"};
}

void set_ray(RTCRay& ray, const Vec3& from, const Vec3& direction, float near, float far) {
  ray.org_x = static_cast<float>(from.x());
  ray.org_y = static_cast<float>(from.y());
  ray.org_z = static_cast<float>(from.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tnear = near;
  ray.tfar = far;
  ray.time = 0;
  ray.mask = std::numeric_limits<unsigned>::max();
  ray.id = 0;
  ray.flags = 0;
}

alignas(16) constexpr int all_valid[4] = {-1, -1, -1, -1};

void set_rays(RTCRay4& rays, const Vec3& from, const std::array<Vec3, 4>& directions) {
  for (int i = 0; i < 4; ++i) {
    rays.org_x[i] = static_cast<float>(from.x());
    rays.org_y[i] = static_cast<float>(from.y());
    rays.org_z[i] = static_cast<float>(from.z());
    rays.dir_x[i] = static_cast<float>(directions[i].x());
    rays.dir_y[i] = static_cast<float>(directions[i].y());
    rays.dir_z[i] = static_cast<float>(directions[i].z());
    rays.mask[i] = std::numeric_limits<unsigned>::max();
  }
}

}  // namespace

SurfacePoint surface_point(const RenderMesh& mesh, const Triangle& triangle, const std::array<double, 3>& weights,
                           double side) {
  SurfacePoint at{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (int i = 0; i < 3; ++i) {
    at.point += weights[i] * mesh.positions[triangle[i]];
    at.normal += weights[i] * side * mesh.normals[triangle[i]];
  }
  if (at.normal.norm() > 1e-6) {
    at.normal.normalize();
  } else {
    const Vec3& origin = mesh.positions[triangle[0]];
    at.normal = side * (mesh.positions[triangle[1]] - origin).cross(mesh.positions[triangle[2]] - origin);
    at.normal = at.normal.norm() > 0 ? Vec3(at.normal.normalized()) : Vec3::UnitY();
  }
  at.start = at.point;
  for (int i = 0; i < 3; ++i) {
    const Vec3 n = side * mesh.normals[triangle[i]];
    at.start -= weights[i] * std::min(0.0, (at.point - mesh.positions[triangle[i]]).dot(n)) * n;
  }
  return at;
}

Result<Tracer> Tracer::build(std::span<const RenderMesh> meshes) {
  auto held = std::make_shared<Scene>();
  // SSE2 everywhere: the wider kernels round differently, and the same picture is wanted on every machine.
  held->device = rtcNewDevice("threads=1,isa=sse2");
  if (!held->device) return failed("Embree could not be started.");
  held->scene = rtcNewScene(held->device);
  rtcSetSceneFlags(held->scene, RTC_SCENE_FLAG_ROBUST);
  for (unsigned m = 0; m < meshes.size(); ++m) {
    const RenderMesh& mesh = meshes[m];
    RTCGeometry geometry = rtcNewGeometry(held->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.positions.size()));
    auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), mesh.triangles.size()));
    if (!points || !corners) {
      rtcReleaseGeometry(geometry);
      return failed("Embree found no memory for the meshes.");
    }
    for (const Vec3& p : mesh.positions)
      for (int i = 0; i < 3; ++i) *points++ = static_cast<float>(p[i]);
    for (const Triangle& t : mesh.triangles)
      for (std::uint32_t v : t) *corners++ = v;
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(held->scene, geometry, m);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(held->scene);
  if (rtcGetDeviceError(held->device) != RTC_ERROR_NONE) return failed("Embree could not take the meshes.");
  return Tracer(std::move(held));
}

std::optional<Hit> Tracer::first_hit(const Vec3& from, const Vec3& direction) const {
  RTCRayHit query{};
  set_ray(query.ray, from, direction, 0.0F, std::numeric_limits<float>::infinity());
  query.hit.geomID = query.hit.primID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1(scene_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v};
}

std::array<std::optional<Hit>, 4> Tracer::first_hits(const Vec3& from, const std::array<Vec3, 4>& directions) const {
  RTCRayHit4 query{};
  set_rays(query.ray, from, directions);
  for (int i = 0; i < 4; ++i) {
    query.ray.tfar[i] = std::numeric_limits<float>::infinity();
    query.hit.geomID[i] = query.hit.primID[i] = query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect4(all_valid, scene_->scene, &context, &query);
  std::array<std::optional<Hit>, 4> hits;
  for (int i = 0; i < 4; ++i)
    if (query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
      hits[i] = Hit{query.hit.geomID[i], query.hit.primID[i], query.hit.u[i], query.hit.v[i]};
  return hits;
}

std::array<bool, 4> Tracer::blocked(const Vec3& from, const std::array<Vec3, 4>& directions,
                                    const std::array<double, 4>& reach) const {
  RTCRay4 rays{};
  set_rays(rays, from, directions);
  for (int i = 0; i < 4; ++i) rays.tfar[i] = static_cast<float>(reach[i]);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded4(all_valid, scene_->scene, &context, &rays);
  std::array<bool, 4> in_the_way{};
  for (int i = 0; i < 4; ++i) in_the_way[i] = rays.tfar[i] < 0;  // Embree's sign for it
  return in_the_way;
}

}  // namespace vitrine
