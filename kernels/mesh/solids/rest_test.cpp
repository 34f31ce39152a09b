#include "kernels/mesh/solids/rest.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify;
using namespace ensonify::solids;
using Catch::Matchers::WithinAbs;
using frames::Vec2;
using frames::Vec3;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Ground of 8 m x 8 m about the origin.
template <class Height>
GroundPatch ground(const Height& height_m, double spacing_m = 0.1) {
  GroundPatch patch{{-4, -4}, spacing_m, {}};
  const auto posts = static_cast<Eigen::Index>(8.0 / spacing_m) + 1;
  patch.height_m.resize(posts, posts);
  for (Eigen::Index n = 0; n < posts; ++n) {
    for (Eigen::Index e = 0; e < posts; ++e)
      patch.height_m(n, e) = height_m(-4 + spacing_m * static_cast<double>(e), -4 + spacing_m * static_cast<double>(n));
  }
  return patch;
}

struct Lying {
  Lying(const Solid& solid, const GroundPatch& patch, const Vec2& position_m = {0, 0},
        const Eigen::Matrix3d& upright = Eigen::Matrix3d::Identity()) {
    const Surface surface = surface_of(solid, 1e-3);
    places = places_of(surface, 0.1);
    rest = at_rest(places, centre_of_mass(surface.mesh), upright, position_m, patch);
    for (const Vec3& place : places) {
      const Vec3 at = rest.turn * place + Vec3(position_m.x(), position_m.y(), rest.height_m);
      const double above_m = at.z() - patch.at(at.head<2>());
      lowest_m = std::min(lowest_m, above_m);
      if (above_m < 0.01) contacts.push_back(at);
    }
    middle = Vec3(position_m.x(), position_m.y(), rest.height_m);
  }
  /// The way of one of the body's axes.
  Vec3 axis(int i) const { return rest.turn.col(i); }

  std::vector<Vec3> places, contacts;
  Rest rest;
  Vec3 middle;
  double lowest_m = 1e9;
};

}  // namespace

TEST_CASE("centres of mass: a wedge's and a cone's are in closed form, a plate's is its middle") {
  const Vec3 wedge = centre_of_mass(surface_of(Wedge{{1, 3, 0.6}}, 1e-3).mesh);
  CHECK((wedge - Vec3(0, 0.5, -0.1)).norm() < 1e-6);
  const Vec3 cone = centre_of_mass(surface_of(Cone{0.6, 0.0, 0.8}, 1e-5).mesh);
  CHECK((cone - Vec3(0, 0, -0.2)).norm() < 1e-5);
  CHECK(centre_of_mass(surface_of(Plate{{1, 2}}, 1e-3).mesh).norm() < 1e-9);
}

TEST_CASE("on level ground bodies lie as they stand") {
  const auto level = ground([](double, double) { return -12.0; });
  CHECK_THAT(Lying(Sphere{0.5}, level).middle.z(), WithinAbs(-11.75, 2e-3));
  CHECK_THAT(Lying(Box{{1, 0.6, 0.5}}, level).middle.z(), WithinAbs(-11.75, 1e-6));
  CHECK_THAT(Lying(Cylinder{0.5, 1.8}, level).middle.z(), WithinAbs(-11.75, 2e-3));
  CHECK_THAT(Lying(Plate{{1, 1}}, level).middle.z(), WithinAbs(-12.0, 1e-6));
  CHECK_THAT(Lying(Cone{0.6, 0.2, 0.5}, level).axis(2).z(), WithinAbs(1.0, 1e-6));
}

TEST_CASE("on a slope a box, a plate and a cylinder lie along it") {
  const double slope = std::tan(10 * kDegree);
  const auto hill = ground([&](double east, double) { return -12.0 + slope * east; });
  const Vec3 normal = Vec3(-slope, 0, 1).normalized();
  for (const Solid& solid : {Solid{Box{{1, 0.6, 0.5}}}, Solid{Plate{{1, 1}}}}) {
    const Lying lying(solid, hill);
    CHECK(std::acos(std::min(1.0, lying.axis(2).dot(normal))) < 0.05 * kDegree);
    CHECK(lying.lowest_m > -1e-6);
    CHECK(lying.contacts.size() >= 3);
  }
  const Lying cylinder(Cylinder{0.5, 1.8}, hill, {0, 0},
                       Eigen::AngleAxisd(-90 * kDegree, Vec3::UnitZ()).toRotationMatrix());  // its axis uphill
  CHECK(std::abs(std::asin(cylinder.axis(1).dot(normal))) < 0.1 * kDegree);
}

TEST_CASE("a box over a step rests on three places or more, and nowhere in the ground") {
  const auto step = ground([](double east, double north) { return east + 0.3 * north > 0.2 ? -11.7 : -12.0; });
  const Lying box(Box{{1.2, 1.0, 0.4}}, step);
  CHECK(box.lowest_m > -0.01);
  CHECK(box.contacts.size() >= 3);
  CHECK(box.axis(2).z() < std::cos(5 * kDegree));  // it leans
}

TEST_CASE("no small tilt brings the centre of mass lower on rough ground") {
  const auto rough = ground([](double east, double north) {
    return -12.0 + 0.08 * std::sin(3.1 * east + 1.0) * std::cos(2.3 * north) + 0.03 * std::sin(9.0 * north);
  });
  for (const Solid& solid : {Solid{Box{{1.2, 0.8, 0.5}}}, Solid{Cylinder{0.4, 1.8}}, Solid{Cone{0.8, 0.3, 0.5}},
                             Solid{Figure{Figure::Kind::kAnchor, {0.8, 1.2, 0.5}}}}) {
    const Surface surface = surface_of(solid, 1e-3);
    const auto places = places_of(surface, 0.1);
    const Vec3 centre = centre_of_mass(surface.mesh);
    const Vec2 position(0.3, -0.7);
    const Rest rest = at_rest(places, centre, Eigen::Matrix3d::Identity(), position, rough);
    const double lies_m = rest.height_m + (rest.turn * centre).z();
    for (int way = 0; way < 16; ++way) {
      const double axis_rad = way * 0.125 * std::numbers::pi;
      const Eigen::Matrix3d tilted =
          Eigen::AngleAxisd(0.2 * kDegree, Vec3(std::cos(axis_rad), std::sin(axis_rad), 0)).toRotationMatrix() *
          rest.turn;
      double height_m = -1e9;
      for (const Vec3& place : places) {
        const Vec3 at = tilted * place;
        height_m = std::max(height_m, rough.at(position + at.head<2>()) - at.z());
      }
      CHECK(height_m + (tilted * centre).z() > lies_m - 1e-4);
    }
  }
}

TEST_CASE("what stands on a point falls over") {
  const auto level = ground([](double, double) { return 0.0; });
  const Lying cone(Cone{0.6, 0.0, 0.8}, level, {0, 0},
                   Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()).toRotationMatrix());
  CHECK(std::abs(cone.axis(2).z()) < 0.5);  // on its side
}
