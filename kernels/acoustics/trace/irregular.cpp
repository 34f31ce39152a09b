#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/acoustics/trace/scene_impl.h"

namespace ensonify::trace {
namespace {

using progressive::Triangle;
using progressive::TriangleMesh;
using terrain::Vec2;
using terrain::Vec3;

/// Embree divides the work on fewer than 1024 primitives among no threads.
constexpr std::size_t kMostInCluster = 512;

/// Cuts triangles in two by their middles along the longest side of what they span, until they are few.
class Clusters {
 public:
  explicit Clusters(const TriangleMesh& mesh) : of_triangle(mesh.triangle.size()) {
    for (const auto& [a, b, c] : mesh.triangle)
      middles_.push_back((mesh.vertex_m[a] + mesh.vertex_m[b] + mesh.vertex_m[c]) / 3.0F);
    std::vector<std::uint32_t> all(of_triangle.size());
    std::iota(all.begin(), all.end(), 0U);
    if (!all.empty()) cut(all);
  }

  std::vector<std::uint32_t> of_triangle;
  std::uint32_t count = 0;

 private:
  void cut(std::span<std::uint32_t> triangles) {
    if (triangles.size() <= kMostInCluster) {
      for (const std::uint32_t t : triangles) of_triangle[t] = count;
      ++count;
      return;
    }
    Eigen::AlignedBox3f box;
    for (const std::uint32_t t : triangles) box.extend(middles_[t]);
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t half = triangles.size() / 2;
    std::ranges::nth_element(triangles, triangles.begin() + static_cast<std::ptrdiff_t>(half), {},
                             [&](std::uint32_t t) { return std::pair(middles_[t][axis], t); });
    cut(triangles.first(half));
    cut(triangles.subspan(half));
  }

  std::vector<Eigen::Vector3f> middles_;
};

RTCBounds bounds_of(std::span<const Triangle> triangles, std::span<const Eigen::Vector3f> places_m) {
  Eigen::AlignedBox3f box;
  for (const Triangle& corners : triangles) {
    for (const std::uint32_t corner : corners) box.extend(places_m[corner]);
  }
  const Eigen::Vector3f low = box.min().array() - kPartSlack_m, high = box.max().array() + kPartSlack_m;
  return {low.x(), low.y(), low.z(), 0.0F, high.x(), high.y(), high.z(), 0.0F};
}

/// As TrianglePart wants them.
std::vector<Eigen::Vector3f> places_of(const TriangleMesh& mesh, const Vec2& origin_enu_m) {
  std::vector<Eigen::Vector3f> places_m;
  places_m.reserve(mesh.vertex_m.size() + 1);
  const Vec3 shift = mesh.origin_enu_m - Vec3(origin_enu_m.x(), origin_enu_m.y(), 0.0);
  for (const Eigen::Vector3f& vertex : mesh.vertex_m) places_m.push_back((shift + vertex.cast<double>()).cast<float>());
  places_m.push_back(Eigen::Vector3f::Zero());
  return places_m;
}

}  // namespace

TrianglePart::TrianglePart(const Device& device, std::vector<Triangle> triangles, Places places_m, const Common& common)
    : Part(device.get(), bounds_of(triangles, *places_m), common.number, common.facet_m, common.contributor),
      triangles_(std::move(triangles)),
      places_m_(std::move(places_m)) {}

Part::Content TrianglePart::content() const {
  Geometry geometry(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE));
  const std::vector<Eigen::Vector3f>& places = *places_m_;
  static_assert(sizeof(places[0]) == 3 * sizeof(float));
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, places.data(), 0,
                             sizeof(places[0]), places.size() - 1);
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles_.data(), 0,
                             sizeof(Triangle), triangles_.size());
  return {std::move(geometry), triangles_.size()};
}

Irregular::Irregular(progressive::Hierarchy hierarchy, std::uint32_t number, std::uint32_t contributor)
    : hierarchy_(std::move(hierarchy)), common_{number, 0.0F, contributor}, cut_(hierarchy_) {
  const TriangleMesh& whole = hierarchy_.mesh;
  double area_m2 = 0.0;
  for (const auto& [a, b, c] : whole.triangle) {
    const Vec3 ab = (whole.vertex_m[b] - whole.vertex_m[a]).cast<double>();
    const Vec3 ac = (whole.vertex_m[c] - whole.vertex_m[a]).cast<double>();
    area_m2 += 0.5 * ab.cross(ac).norm();
    for (const std::uint32_t v : {a, b, c}) box_enu_m_.extend(whole.origin_enu_m + whole.vertex_m[v].cast<double>());
  }
  const double count = std::max(1.0, static_cast<double>(whole.triangle.size()));
  edge_m_ = progressive::mean_edge_m(whole);
  common_.facet_m = static_cast<float>(std::sqrt(2.0 * area_m2 / count));
  Clusters clusters(whole);
  cluster_of_ = std::move(clusters.of_triangle);
  clusters_.resize(clusters.count);
}

void Irregular::choose(std::span<const lod::View> views) {
  cut_.choose(hierarchy_, progressive::views_of(views, edge_m_));
  want(cut_.triangles(), cut_.sources());
}

void Irregular::choose_all() {
  std::vector<std::uint32_t> all(cluster_of_.size());
  std::iota(all.begin(), all.end(), 0U);
  want(hierarchy_.mesh.triangle, all);
}

void Irregular::want(std::span<const Triangle> triangles, std::span<const std::uint32_t> sources) {
  for (Cluster& cluster : clusters_) cluster.wanted.clear();
  for (std::size_t i = 0; i < triangles.size(); ++i) clusters_[cluster_of_[sources[i]]].wanted.push_back(triangles[i]);
}

std::vector<std::shared_ptr<const Part>> Irregular::show(const Device& device, const Vec2& origin_enu_m) {
  if (!places_m_)
    places_m_ = std::make_shared<const std::vector<Eigen::Vector3f>>(places_of(hierarchy_.mesh, origin_enu_m));
  tbb::parallel_for_each(clusters_, [&](Cluster& cluster) {
    if (cluster.wanted.empty()) {
      cluster.part.reset();
    } else if (!cluster.part || cluster.part->shown() != cluster.wanted) {
      cluster.part = std::make_shared<TrianglePart>(device, cluster.wanted, places_m_, common_);
      cluster.part->scene();
    }
  });
  std::vector<std::shared_ptr<const Part>> parts;
  for (const Cluster& cluster : clusters_) {
    if (cluster.part) parts.push_back(cluster.part);
  }
  return parts;
}

void Irregular::forget() {
  for (Cluster& cluster : clusters_) cluster.part.reset();
  places_m_.reset();
}

std::size_t Irregular::triangles() const {
  std::size_t sum = 0;
  for (const Cluster& cluster : clusters_) sum += cluster.part ? cluster.part->triangles() : 0;
  return sum;
}

}  // namespace ensonify::trace
