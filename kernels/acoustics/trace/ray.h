#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <tuple>
#include <vector>

#include "kernels/acoustics/trace/batch.h"

namespace ensonify::trace {

/// A bundle of sound around one direction. The direction is unit length. The solid angles of the rays that are spread
/// over a transmission's volume sum to that of the volume; those to facets of small objects stand for the facets.
struct Ray {
  Eigen::Vector3f direction_head = Eigen::Vector3f::UnitZ();  // head frame, FRD
  float solid_angle_sr = 0.0F;
};

struct Rays : Batch<Rays, Ray> {
  VectorColumns<float> direction_head;
  std::vector<float> solid_angle_sr;

  Rays() = default;
  Rays(std::initializer_list<Ray> rays) {
    for (const Ray& ray : rays) push_back(ray);
  }
  template <class Self>
  static auto columns(Self& self) {
    return std::tie(self.solid_angle_sr, self.direction_head.x, self.direction_head.y, self.direction_head.z);
  }
  Ray operator[](std::size_t i) const { return {direction_head[i], solid_angle_sr[i]}; }
  void set(std::size_t i, const Ray& ray) {
    direction_head.set(i, ray.direction_head);
    solid_angle_sr[i] = ray.solid_angle_sr;
  }
};

}  // namespace ensonify::trace
