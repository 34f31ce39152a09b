// Rays against a mesh refined for a ping and against the whole mesh.
#include <embree3/rtcore.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>
#include <sstream>

#include "kernels/acoustics/trace/parts.h"
#include "kernels/base/random/stream.h"
#include "kernels/mesh/progressive/cut.h"
#include "kernels/mesh/progressive/testing/meshes.h"

using namespace ensonify;
using namespace ensonify::progressive;

namespace {

/// Triangles of a mesh, as Embree has them.
class Triangles {
 public:
  Triangles(const TriangleMesh& mesh, std::span<const Triangle> triangles) : scene_(rtcNewScene(device_.get())) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.vertex_m.size()));
    for (const auto& vertex : mesh.vertex_m) {
      for (int axis = 0; axis < 3; ++axis) *v++ = vertex[axis];
    }
    auto* t = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles.size()));
    std::memcpy(t, triangles.data(), triangles.size_bytes());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_.get());
  }

  /// geomID is RTC_INVALID_GEOMETRY_ID for a miss.
  RTCRayHit trace(const Eigen::Vector3f& from, const Eigen::Vector3f& along, float range_m) const {
    RTCRayHit ray{};
    ray.ray.org_x = from.x(), ray.ray.org_y = from.y(), ray.ray.org_z = from.z();
    ray.ray.dir_x = along.x(), ray.ray.dir_y = along.y(), ray.ray.dir_z = along.z();
    ray.ray.tfar = range_m;
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_.get(), &context, &ray);
    return ray;
  }

 private:
  trace::Device device_ = trace::new_device();
  trace::EmbreeScene scene_;
};

/// A direction of the frustum.
Eigen::Vector3f direction(const lod::Frustum& f, double across, double along) {
  const double sine = std::lerp(f.low_sine, f.high_sine, across), cosine = std::sqrt(1.0 - sine * sine);
  const double angle = std::lerp(f.low_angle_rad, f.high_angle_rad, along);
  return (sine * f.axis_enu + cosine * (std::cos(angle) * f.zero_enu + std::sin(angle) * f.side_enu)).cast<float>();
}

struct Found {
  std::size_t hits = 0, lost = 0, different = 0, shown = 0, own = 0;
};

/// Random rays within a view of tolerance 0, against the refined mesh and against all of it. The same triangle must
/// give the same bits; on an edge that two triangles share either of them may be given.
Found compare(const Hierarchy& hierarchy, const Triangles& whole, const View& view, std::uint64_t rays) {
  Cut cut(hierarchy);
  cut.choose(hierarchy, std::vector<View>{view});
  const Triangles refined(hierarchy.mesh, cut.triangles());
  Found found;
  found.shown = cut.triangles().size();
  for (std::size_t i = 0; i < cut.triangles().size(); ++i)
    found.own += cut.triangles()[i] == hierarchy.mesh.triangle[cut.sources()[i]] ? 1U : 0U;
  const random::Stream draw{7, "rays"};
  const Eigen::Vector3f from = (view.frustum.apex_enu_m - hierarchy.mesh.origin_enu_m).cast<float>();
  for (std::uint64_t n = 0; n < rays; ++n) {
    const Eigen::Vector3f along = direction(view.frustum, draw.uniform(n, 0), draw.uniform(n, 1));
    const auto range_m = static_cast<float>(view.frustum.max_range_m);
    const RTCRayHit a = whole.trace(from, along, range_m), b = refined.trace(from, along, range_m);
    const bool hit = a.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    found.hits += hit ? 1U : 0U;
    found.lost += hit && b.hit.geomID == RTC_INVALID_GEOMETRY_ID ? 1U : 0U;
    const bool same = (b.hit.geomID != RTC_INVALID_GEOMETRY_ID) == hit && a.ray.tfar == b.ray.tfar &&
                      (!hit || (cut.sources()[b.hit.primID] == a.hit.primID && a.hit.Ng_x == b.hit.Ng_x &&
                                a.hit.Ng_y == b.hit.Ng_y && a.hit.Ng_z == b.hit.Ng_z));
    found.different += same ? 0U : 1U;
  }
  return found;
}

/// The v and f lines of an OBJ of triangles, about its middle; no triangles when there is no such file.
TriangleMesh obj(const std::string& name, double scale) {
  const char* shared = std::getenv("ENSONIFY_SHARED");
  std::ifstream file(std::string(shared == nullptr ? "../shared" : shared) + "/data/" + name);
  std::vector<frames::Vec3> vertices;
  Eigen::AlignedBox3d box;
  TriangleMesh mesh;
  for (std::string line, kind; std::getline(file, line);) {
    std::istringstream words(line);
    words >> kind;
    if (kind == "v") {
      frames::Vec3 v;
      words >> v.x() >> v.y() >> v.z();
      vertices.push_back(v * scale);
      box.extend(vertices.back());
    } else if (kind == "f") {
      Triangle t{};
      std::string corner;
      for (auto& number : t) words >> corner, number = static_cast<std::uint32_t>(std::stoul(corner) - 1);
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangle.push_back(t);
    }
    kind.clear();
  }
  if (!vertices.empty()) mesh.origin_enu_m = box.center().array().round();
  for (const auto& v : vertices) mesh.vertex_m.push_back((v - mesh.origin_enu_m).cast<float>());
  return mesh;
}

void check(const TriangleMesh& mesh, std::span<const View> views, std::uint64_t rays, std::size_t fewer) {
  const Hierarchy hierarchy = hierarchy_of(mesh, collapses_of(mesh));
  const Triangles whole(hierarchy.mesh, hierarchy.mesh.triangle);
  for (const View& view : views) {
    const Found found = compare(hierarchy, whole, view, rays);
    INFO(found.shown << " of " << mesh.triangle.size() << " triangles, " << found.own << " of them the source's");
    CHECK(found.hits > rays / 4);
    CHECK(found.lost == 0);
    CHECK(found.different == 0);
    CHECK(found.shown * fewer < mesh.triangle.size());
  }
}

}  // namespace

TEST_CASE("a ping on a quay wall hits what it hits on the whole wall, to the bit") {
  std::vector<View> views = {fan({-5.0, -3.0, 4.0}, 0.3, 0.0, 25.0), fan({12.0, -4.0, 3.0}, -0.2, 0.0, 25.0)};
  check(quay_wall(60.0), views, 100'000, 15);
}

TEST_CASE("so does one on a survey's TIN") {
  const TriangleMesh tin = obj("terrain/woodshole_tin_east.obj", 1.0);
  if (tin.triangle.empty()) {
    WARN("no TIN in the shared data; skipped");
    return;
  }
  std::vector<View> views;
  for (const double heading_rad : {0.0, 0.7, 2.0})
    views.push_back(fan(tin.origin_enu_m + frames::Vec3(60.0 * heading_rad, -80.0, 40.0), heading_rad, 0.0, 200.0));
  check(tin, views, 50'000, 20);
}

TEST_CASE("and one on a scanned coral") {
  const TriangleMesh coral = obj("objects/mcap_coral.obj", 1.0);
  if (coral.triangle.empty()) {
    WARN("no coral in the shared data; skipped");
    return;
  }
  Eigen::AlignedBox3f box;
  for (const auto& v : coral.vertex_m) box.extend(v);
  View view = fan(coral.origin_enu_m + frames::Vec3(0.0, 0.0, 3.0 * box.diagonal().norm()), 0.5, 0.0, 1e3);
  view.frustum.high_angle_rad = 0.12, view.frustum.low_angle_rad = -0.12, view.frustum.max_range_m = 10.0;
  check(coral, std::vector<View>{view}, 50'000, 3);
}
