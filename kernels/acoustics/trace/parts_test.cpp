// The parts of a mesh, and what becomes of a failure to build one.
#include "kernels/acoustics/trace/parts.h"

#include <tbb/parallel_for.h>

#include <catch2/catch.hpp>
#include <new>

#include "kernels/acoustics/trace/packet.h"

using namespace ensonify::trace;
using ensonify::frames::Vec3;

namespace {

/// A level triangle that covers [0, 1] x [0, 1] beside x = east_m, 5 m down. There is no memory for it until `memory`.
class Slab final : public Part {
 public:
  Slab(const Device& device, float east_m)
      : Part(device.get(), {east_m, 0.0F, -5.1F, 0.0F, east_m + 2.0F, 2.0F, -4.9F, 0.0F}, 1, 1.0F, kNoise),
        east_m_(east_m) {}

  bool memory = true;

 private:
  Content content() const override {
    if (!memory) throw std::bad_alloc();
    Geometry geometry(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE));
    auto* corner =
        static_cast<float*>(new_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3));
    for (const float value : {0.0F, 0.0F, -5.0F, 2.0F, 0.0F, -5.0F, 0.0F, 2.0F, -5.0F}) *corner++ = value;
    for (int i = 1; i <= 3; ++i) corner[-3 * i] += east_m_;
    auto* index = static_cast<std::uint32_t*>(
        new_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), 1));
    for (std::uint32_t i = 0; i < 3; ++i) index[i] = i;
    return {std::move(geometry), 1};
  }

  float east_m_;
};

/// Straight down, all lanes side by side from x = east_m + 0.1 on.
Packet packet_at(double east_m) {
  Packet packet;
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    packet.set(lane, Vec3(east_m + 0.1 + 0.05 * static_cast<double>(lane), 0.5, 0.0), -Vec3::UnitZ(), 10.0F);
  }
  return packet;
}

}  // namespace

TEST_CASE("a part that cannot be built throws to the ray's caller, and may be tried again") {
  const Device device = new_device();
  const auto first = std::make_shared<Slab>(device, 0.0F), second = std::make_shared<Slab>(device, 10.0F);
  Slab &intact = *first, &planted = *second;
  planted.memory = false;
  const PartTree mesh(device, {first, second});

  const auto all_hit = [&](double east_m, const Part& part) {
    Packet packet = packet_at(east_m);
    packet.intersect(mesh);
    return std::ranges::all_of(packet.part_hit, [&](const Part* part_hit) { return part_hit == &part; });
  };
  CHECK(all_hit(0.0, intact));
  CHECK_THROWS_AS(all_hit(10.0, planted), std::bad_alloc);
  CHECK(all_hit(0.0, intact));  // the mesh is as it was
  CHECK(planted.triangles() == 0);
  // As a trace does it: many packets at once, some of which fail.
  CHECK_THROWS_AS(tbb::parallel_for(0, 1000, [&](int i) { all_hit(i % 2 == 0 ? 0.0 : 10.0, intact); }), std::bad_alloc);

  planted.memory = true;
  CHECK(all_hit(10.0, planted));
  CHECK(planted.triangles() == 1);
}
