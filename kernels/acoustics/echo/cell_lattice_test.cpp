#include "kernels/acoustics/echo/cell_lattice.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "kernels/acoustics/echo/testing/found.h"

using namespace ensonify;
using namespace ensonify::echo;
using Catch::WithinAbs;
using frames::Vec3;

namespace {

constexpr double kDeg = 3.14159265358979 / 180.0;
constexpr double kCube_m = 0.02;
const CellSize kLong = CellSize::for_beam(kCube_m, 1 * kDeg);  // from 18.3 m on

frames::HeadPose pose_at(double heading_deg, const Vec3& position_enu_m = {300.0, -200.0, -1.0}) {
  return {position_enu_m, frames::enu_from_body({.heading_rad = heading_deg * kDeg})};
}

/// A place 20 m below the head, so far from it to starboard and ahead.
Vec3 seen(const frames::HeadPose& head, double starboard_m, double ahead_m) {
  return head.position_enu_m + head.enu_from_head * Vec3(ahead_m, starboard_m, 20.0);
}

CellLattice::Cell cell_of(const CellSize& size, const frames::HeadPose& head, const Vec3& place_enu_m) {
  return CellLattice(size, head)
      .cell_at(place_enu_m.x(), place_enu_m.y(), place_enu_m.z(), (place_enu_m - head.position_enu_m).norm());
}
std::uint64_t number(const CellSize& size, const frames::HeadPose& head, const Vec3& place_enu_m) {
  return cell_of(size, head, place_enu_m).number;
}

}  // namespace

TEST_CASE("long cells are as wide as a cube and four times as long, along the track to 4.5 degrees") {
  for (const double heading_deg : {0.0, 4.4, 30.0, 94.0, 161.0, 270.0, 355.6}) {
    const frames::HeadPose head = pose_at(heading_deg);
    const double off_deg = heading_deg - 9.0 * std::round(heading_deg / 9.0);
    const double cosine = std::cos(off_deg * kDeg), sine = std::sin(off_deg * kDeg);
    struct Extent {
      double low_m = 1e9, high_m = -1e9;
      void add(double m) { low_m = std::min(low_m, m), high_m = std::max(high_m, m); }
      double length_m() const { return high_m - low_m; }
    };
    struct Both {
      Extent along, across;
    };
    std::map<std::uint64_t, Both> cells;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    constexpr double kStarboard_m = 1.0, kAhead_m = 0.8;
    for (int i = 0; i < 200000; ++i) {
      const double starboard_m = kStarboard_m * unit(random), ahead_m = kAhead_m * unit(random);
      Both& cell = cells[number(kLong, head, seen(head, 10.0 + starboard_m, ahead_m))];
      // The lattice's axes lie off the head's by so much to port.
      cell.along.add(ahead_m * cosine - starboard_m * sine);
      cell.across.add(starboard_m * cosine + ahead_m * sine);
    }
    // Cells a x b that a convex area meets: 1 + area / (a b) + its widths along a and b over these, in the mean over
    // where it lies; few are met in a corner that none of the places fell into.
    const double along_m = kAhead_m * cosine + kStarboard_m * std::abs(sine),
                 across_m = kStarboard_m * cosine + kAhead_m * std::abs(sine);
    const double expected =
        1.0 + kStarboard_m * kAhead_m / (4 * kCube_m * kCube_m) + along_m / (4 * kCube_m) + across_m / kCube_m;
    CHECK_THAT(double(cells.size()), WithinAbs(expected, 0.05 * expected));
    double longest_m = 0.0, widest_m = 0.0;
    for (const auto& [name, cell] : cells) {
      longest_m = std::max(longest_m, cell.along.length_m()), widest_m = std::max(widest_m, cell.across.length_m());
    }
    CHECK(longest_m <= 4 * kCube_m + 1e-9);
    CHECK(longest_m > 3.9 * kCube_m);
    CHECK(widest_m <= kCube_m + 1e-9);
    CHECK(widest_m > 0.97 * kCube_m);
  }
}

TEST_CASE("courses of one step, and the opposite ones, find the same cell at a place; other courses other cells") {
  const Vec3 at = seen(pose_at(50.0), 30.0, 0.3);
  const std::uint64_t one = number(kLong, pose_at(50.0), at);
  CHECK(one != number(kCube_m, pose_at(50.0), at));
  CHECK(number(kLong, pose_at(53.0, {300.4, -200.1, -1.1}), at) == one);  // 49.5 to 58.5
  CHECK(number(kLong, pose_at(230.0), at) == one);
  CHECK(number(kLong, pose_at(49.0), at) != one);
  // Steps alone do not tell cells of two courses apart, but their turn does: about the origin all steps are 0.
  const Vec3 origin(1e-4, 1e-4, -20.0);
  std::vector<std::uint64_t> numbers;
  for (int turn = 0; turn < 20; ++turn) {
    const double heading = 9.0 * turn * kDeg;
    numbers.push_back(
        number(kLong, pose_at(9.0 * turn, {-30 * std::cos(heading), 30 * std::sin(heading), 0.0}), origin));
  }
  std::ranges::sort(numbers);
  CHECK(std::ranges::adjacent_find(numbers) == numbers.end());
}

TEST_CASE("cells are cubes where the beam is narrow on the seabed, and where range changes along the track") {
  for (const double heading_deg : {0.0, 77.0}) {
    const frames::HeadPose head = pose_at(heading_deg);
    const auto is_cube = [&](const Vec3& at) { return number(kLong, head, at) == number(kCube_m, head, at); };
    CHECK_FALSE(is_cube(seen(head, 0.0, 0.0)));
    CHECK(is_cube(head.position_enu_m + Vec3(0, 0, -18.0)));
    CHECK_FALSE(is_cube(head.position_enu_m + Vec3(0, 0, -18.5)));
    CHECK_FALSE(is_cube(seen(head, 0.0, 1.9)));
    CHECK(is_cube(seen(head, 0.0, 2.2)));
    CHECK(is_cube(seen(head, 0.0, -2.2)));
    CHECK(is_cube(seen(head, 10.0, 10.0)));
  }
}

TEST_CASE("ranges of a long cell spread no more than those of a cube seen over its edge") {
  // By what range changes along each edge. Fans of a degree, 150 degrees wide, on all courses have long cells alone.
  for (double heading_deg = 0.0; heading_deg < 360.0; heading_deg += 1.25) {
    const frames::HeadPose head = pose_at(heading_deg);
    for (double angle_deg = -75.0; angle_deg <= 75.0; angle_deg += 5.0) {
      for (const double ahead : {-0.0087, 0.0, 0.0087}) {
        const double starboard = std::tan(angle_deg * kDeg);
        const Vec3 at = seen(head, 20.0 * starboard, 20.0 * ahead * std::hypot(1.0, starboard));
        const CellLattice::Cell cell = cell_of(kLong, head, at);
        REQUIRE(cell.along_m == 4 * kCube_m);
        const Vec3 to = (at - head.position_enu_m).normalized();
        const double along = std::abs(to.x() * cell.axis_x + to.y() * cell.axis_y),
                     across = std::abs(to.y() * cell.axis_x - to.x() * cell.axis_y);
        CHECK(along * cell.along_m + across * kCube_m <= std::sqrt(2.0) * kCube_m);
      }
    }
  }
}

TEST_CASE("a scatterer lies anywhere in its long cell") {
  const frames::HeadPose head = pose_at(50.0);
  const CellLattice lattice(kLong, head);
  trace::Rays rays;
  trace::Hits hits;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 20000; ++i) {
    trace::Hit hit;
    hit.position_enu_m = seen(head, 30.0 + 4.0 * unit(random), unit(random));
    hit.normal_enu = Eigen::Vector3f::UnitZ();
    hit.range_m = static_cast<float>((hit.position_enu_m - head.position_enu_m).norm());
    hit.tube_m2 = hit.range_m * hit.range_m, hit.sin_grazing = 0.5F;
    hits.push_back(hit);
    rays.push_back({Eigen::Vector3f::UnitZ(), 1e-6F});
  }
  const std::vector<float> ones(hits.size(), 1.0F);
  const Scatterers found = scatterers_of(SpeckleCells(kLong, {1, "seabed"}), {head, rays, hits, ones, ones});
  std::map<std::uint64_t, int> cells;
  for (std::size_t i = 0; i < hits.size(); ++i) cells[number(kLong, head, hits.position_enu_m[i])] = 0;
  CHECK(found.size() == cells.size());
  double mean = 0.0, square = 0.0;  // of the share of the length
  for (const Scatterer& one : found) {
    const Vec3 at = one.position_enu_m;
    const CellLattice::Cell cell = cell_of(kLong, head, at);
    REQUIRE(++cells.at(cell.number) == 1);
    const double share = (at.x() * cell.axis_x + at.y() * cell.axis_y -
                          lattice.place(cell, 0, 0, 0).dot(Vec3(cell.axis_x, cell.axis_y, 0))) /
                         cell.along_m;
    mean += share / double(found.size()), square += share * share / double(found.size());
  }
  CHECK_THAT(mean, WithinAbs(0.5, 0.02));  // 4 sd of 2500 and more
  CHECK_THAT(square - mean * mean, WithinAbs(1.0 / 12, 0.01));
}
