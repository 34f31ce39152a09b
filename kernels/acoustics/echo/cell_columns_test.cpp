#include "kernels/acoustics/echo/cell_columns.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "kernels/acoustics/echo/testing/found.h"

using namespace ensonify;
using namespace ensonify::echo;
using frames::Vec3;

namespace {

/// Hits all about a head that is turned, 2 km from the origin; every tenth ray hits nothing.
struct Hits {
  frames::HeadPose pose{{2000.0, -1500.0, -7.0}, frames::enu_from_body({.heading_rad = 1.0, .pitch_rad = 0.2})};
  trace::Rays rays;
  trace::Hits hits;
  std::vector<float> source, backscatter;

  explicit Hits(std::size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0), both(-1.0, 1.0);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 direction = Vec3(both(random), both(random), both(random)).normalized();
      const double range_m = 1.0 + 80.0 * unit(random);
      trace::Hit hit;
      hit.position_enu_m = pose.position_enu_m + range_m * (pose.enu_from_head * direction);
      hit.normal_enu = Vec3(both(random), both(random), both(random)).normalized().cast<float>();
      hit.range_m = i % 10 == 9 ? 0.0F : static_cast<float>(range_m);
      hit.travel_time_s = static_cast<float>(range_m / 1500.0);
      hit.path_length_m = static_cast<float>(1.001 * range_m);
      hit.tube_m2 = static_cast<float>(0.9 * range_m * range_m);
      hit.sin_grazing = i % 7 == 0 ? 1e-5F : static_cast<float>(unit(random));
      hit.contributor = static_cast<std::uint32_t>(i % 5);
      hits.push_back(hit);
      rays.push_back({direction.cast<float>(), static_cast<float>(1e-4 * unit(random))});
      source.push_back(static_cast<float>(1e20 * unit(random)));
      backscatter.push_back(static_cast<float>(unit(random)));
    }
  }
  Insonification all() const { return {pose, rays, hits, source, backscatter}; }
};

/// Steps of a cell, 21 bits each.
std::array<std::int64_t, 3> steps(const Vec3& position_enu_m, double cell_m) {
  const double shift[3] = {0.3819660113, 0.6180339887, 0.2360679775};
  std::array<std::int64_t, 3> cell;
  for (int k = 0; k < 3; ++k) cell[k] = static_cast<std::int64_t>(std::floor(position_enu_m[k] / cell_m + shift[k]));
  return cell;
}
std::uint64_t number(const std::array<std::int64_t, 3>& cell) {
  const auto bits = [](std::int64_t step) { return static_cast<std::uint64_t>(step) & 0x1fffff; };
  return bits(cell[0]) | bits(cell[1]) << 21 | bits(cell[2]) << 42;
}

}  // namespace

TEST_CASE("cells in columns are those of each hit, also where their numbers repeat") {
  const Hits some(1000);
  for (const double cell_m : {0.0004, 0.03, 0.5}) {  // 2 km are 5 million cells of 0.4 mm, and 21 bits 2.1 million
    CellParts found{std::vector<std::uint64_t>(600), std::vector<float>(600), std::vector<float>(600)};
    find_parts(some.all(), CellLattice(cell_m, some.pose), 300, 500, found);
    CHECK(found.cell[299] == 0);
    CHECK(found.cell[500] == 0);
    for (std::size_t k = 300; k < 500; ++k) {
      const trace::Hit hit = some.hits[k];
      if (!(hit.range_m > 0.0F)) {
        REQUIRE(found.cell[k] == kNoCell);
        continue;
      }
      REQUIRE(found.cell[k] == number(steps(hit.position_enu_m, cell_m)));
      const double sigma_sr =
          double(some.backscatter[k]) * double(some.rays[k].solid_angle_sr) / std::max(double(hit.sin_grazing), 1e-3);
      REQUIRE(double(found.scattered_upa2m2[k]) == Approx(double(some.source[k]) * sigma_sr).epsilon(1e-6));
      REQUIRE(double(found.cross_section_m2[k]) == Approx(double(hit.tube_m2) * sigma_sr).epsilon(1e-6));
    }
  }
}

TEST_CASE("a scatterer's position and response are those of its cell's bits, one by one") {
  const Hits some(1000);
  const random::Stream stream{5, "seabed"};
  const double cell_m = 0.05;
  std::vector<std::uint32_t> rays;
  for (std::uint32_t ray = 0; rays.size() < 250; ray += 3) {
    if (some.hits.hit(ray)) rays.push_back(ray);
  }
  constexpr std::size_t kBefore = 7;  // rows that others have
  Scatterers all;
  all.resize(kBefore + rays.size());
  find_geometry(some.all(), CellLattice(cell_m, some.pose), CellStreams(stream), rays, all, kBefore);
  for (std::size_t i = 0; i < kBefore; ++i) REQUIRE(all.slowness_spm[i] == 0.0F);
  const Vec3 shift(0.3819660113, 0.6180339887, 0.2360679775);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Scatterer found = all[kBefore + i];
    const trace::Hit hit = some.hits[rays[i]];
    const auto cell = steps(hit.position_enu_m, cell_m);
    const auto bits = stream.bits(number(cell));
    const Vec3 inside(double(bits[2] & 0xffff) / 65536, double(bits[2] >> 16) / 65536,
                      double(bits[3] & 0xffff) / 65536);
    const Vec3 at = cell_m * (Vec3(double(cell[0]), double(cell[1]), double(cell[2])) + inside - shift);
    const Vec3 normal = hit.normal_enu.cast<double>();
    const Vec3 on_facet = at - normal * normal.dot(at - hit.position_enu_m);
    REQUIRE((found.position_enu_m - on_facet).norm() < 1e-11);
    const Vec3 straight = (hit.position_enu_m - some.pose.position_enu_m) / double(hit.range_m);
    const Vec3 launch = some.pose.enu_from_head * some.rays[rays[i]].direction_head.cast<double>();
    REQUIRE((found.bend_enu.cast<double>() - (launch - straight)).norm() < 1e-12);
    const double radius = std::sqrt(-std::log((double(bits[0] >> 8) + 0.5) / 16777216));
    const auto response = std::polar(radius, 2 * std::numbers::pi * double(bits[1]) / 4294967296);
    REQUIRE(std::abs(std::complex<double>(found.response) - response) < 2e-6);
    REQUIRE(found.slowness_spm == hit.travel_time_s / hit.range_m);
    REQUIRE(found.stretch == hit.path_length_m / hit.range_m);
    REQUIRE(double(found.spreading) == Approx(0.9).epsilon(1e-6));
    REQUIRE(found.share == 1.0F);
  }
}

TEST_CASE("floors, walls and slopes have a scatterer for each cell that rays hit") {
  const double cell_m = 0.1;
  const std::pair<Vec3, Vec3> planes[] = {{Vec3::UnitX(), Vec3::UnitY()},
                                          {Vec3::UnitX(), Vec3::UnitZ()},
                                          {Vec3::UnitY(), Vec3::UnitZ()},
                                          {Vec3::UnitX() + Vec3::UnitZ(), Vec3::UnitY() - Vec3::UnitZ()}};
  for (const auto& [along, across] : planes) {
    Hits some(0);
    std::set<std::uint64_t> cells;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (std::size_t i = 0; i < 60000; ++i) {
      trace::Hit hit;
      hit.position_enu_m = Vec3(40, 30, -20) + 15.0 * (unit(random) * along + unit(random) * across);
      hit.range_m = 50.0F;
      hit.sin_grazing = 1.0F;
      cells.insert(number(steps(hit.position_enu_m, cell_m)));
      some.hits.push_back(hit);
      some.rays.push_back({Eigen::Vector3f::UnitZ(), 1e-6F});
    }
    some.source.assign(some.hits.size(), 1.0F);
    some.backscatter.assign(some.hits.size(), 1.0F);
    const Scatterers found = scatterers_of(SpeckleCells(cell_m, {1, "seabed"}), some.all());
    CHECK(found.size() == cells.size());
  }
}
