#include "kernels/vehicle/motion/hydrodynamics.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify::motion;
using Catch::WithinAbs;
using ensonify::frames::Attitude;
using ensonify::frames::attitude_of;
using ensonify::frames::enu_from_body;
using ensonify::frames::Pose;
using ensonify::frames::Vec3;
constexpr double kPi = std::numbers::pi;

namespace {

/// Neutrally buoyant, its weight below its buoyancy, no damping: it keeps its energy.
HydrodynamicParameters frictionless() {
  HydrodynamicParameters p;
  p.mass_kg = 30;
  p.inertia_kgm2 = {0.5, 4, 5};
  p.gravity_centre_body_m = {0.01, 0, 0.03};
  p.buoyancy_n = 30 * 9.81;
  p.added_mass << 2, 28, 25, 0.1, 3, 3.5;
  return p;
}

HydrodynamicParameters dragging() {
  HydrodynamicParameters p = frictionless();
  p.linear_damping << 2, 20, 20, 1, 6, 6;
  p.quadratic_damping << 6, 100, 100, 1, 10, 10;
  return p;
}

/// Kinetic energy of body and carried water, plus potential energy of weight, buoyancy and waterplane, in still water.
double energy_j(const Body& body, const BodyState& state) {
  const HydrodynamicParameters& p = body.parameters();
  const auto height_m = [&](const Vec3& point) { return enu_from_body(state.pose, point).z(); };
  double energy = 0.5 * state.velocity.dot(body.mass() * state.velocity) +
                  p.mass_kg * p.gravity_mps2 * height_m(p.gravity_centre_body_m) -
                  p.buoyancy_n * height_m(p.buoyancy_centre_body_m);
  if (p.waterplane) {
    const double out_m = state.pose.position_enu_m.z();
    const Attitude attitude = attitude_of(state.pose.enu_from_body);
    energy +=
        0.5 * (p.waterplane->heave_npm * out_m * out_m + p.waterplane->roll_nm * attitude.roll_rad * attitude.roll_rad +
               p.waterplane->pitch_nm * attitude.pitch_rad * attitude.pitch_rad);
  }
  return energy;
}

BodyState tumbling(const Body& body) {
  BodyState state = body.at_rest({{1, 2, -5}, enu_from_body({0.4, 0.3, -0.5})});
  state.velocity << 1.2, -0.4, 0.3, 0.5, -0.3, 0.4;
  return state;
}

BodyState run(const Body& body, BodyState state, double t_s, double step_s, const Surroundings& around = {},
              const Eigen::VectorXd& orders = Eigen::VectorXd::Zero(0)) {
  const int steps = static_cast<int>(std::lround(t_s / step_s));
  for (int i = 0; i < steps; ++i) state = body.step(state, orders, around, step_s);
  return state;
}

}  // namespace

TEST_CASE("Lamb's shares: a sphere carries half its mass, a slender body its own across") {
  CHECK(spheroid_added_mass(1.0, 1.0).along == Approx(0.5));
  CHECK_THAT(spheroid_added_mass(1.001, 1.0).along, WithinAbs(0.5, 1e-3));
  CHECK_THAT(spheroid_added_mass(1.001, 1.0).turning, WithinAbs(0.0, 1e-3));
  // The table of [Lamb1932, article 115]; it was worked by hand: 0.895 and 0.701 where the formula gives 0.894 and
  // 0.699.
  CHECK_THAT(spheroid_added_mass(4.99, 1.0).along, WithinAbs(0.059, 5e-4));
  CHECK_THAT(spheroid_added_mass(4.99, 1.0).across, WithinAbs(0.895, 2e-3));
  CHECK_THAT(spheroid_added_mass(4.99, 1.0).turning, WithinAbs(0.701, 3e-3));
  CHECK_THAT(spheroid_added_mass(9.97, 1.0).across, WithinAbs(0.960, 5e-4));
  CHECK_THROWS_AS(spheroid_added_mass(1.0, 2.0), std::invalid_argument);
}

TEST_CASE("without damping energy stays, with and without Munk's moments") {
  for (const bool munk : {true, false}) {
    HydrodynamicParameters p = frictionless();
    p.munk_moments = munk;
    const Body body(p);
    const BodyState start = tumbling(body);
    const BodyState end = run(body, start, 20.0, 0.01);
    CHECK((end.velocity - start.velocity).norm() > 0.1);
    // What is left is the integrator's: fourth order, so 1e-7 of the energy at 10 ms over a few turns.
    CHECK(energy_j(body, end) == Approx(energy_j(body, start)).epsilon(1e-6));
  }
}

TEST_CASE("an undamped floating hull keeps its energy and heaves at its natural period") {
  HydrodynamicParameters p = frictionless();
  p.waterplane = Waterplane{800.0, 60.0, 200.0};
  p.gravity_centre_body_m = {0, 0, 0.03};
  const Body body(p);
  BodyState start = body.at_rest({{0, 0, 0.1}, enu_from_body({0, 0, 0})});
  const double period_s = 2 * kPi * std::sqrt((30.0 + 25.0) / 800.0);
  CHECK_THAT(run(body, start, period_s, period_s / 200).pose.position_enu_m.z(), WithinAbs(0.1, 1e-6));
  CHECK_THAT(run(body, start, period_s / 2, period_s / 200).pose.position_enu_m.z(), WithinAbs(-0.1, 1e-6));
  // Springs about the body's axes have the energy of their Euler angles for small angles: a third order of 0.05 rad.
  start = body.at_rest({{0, 0, 0.02}, enu_from_body({0, 0.03, 0.05})});
  CHECK_THAT(energy_j(body, run(body, start, 5.0, 0.005)), WithinAbs(energy_j(body, start), 1e-3));
}

TEST_CASE("in an infinite sea the impulse of body and water stays") {
  HydrodynamicParameters p = frictionless();
  p.gravity_centre_body_m = Vec3::Zero();  // no righting moment, and weight balances buoyancy: no force from outside
  const Body body(p);
  const auto impulse = [&](const BodyState& s) {
    const Vec6 momentum = body.mass() * s.velocity;
    return Vec3(s.pose.enu_from_body * Vec3(momentum.head<3>()));
  };
  const BodyState start = tumbling(body);
  CHECK((impulse(run(body, start, 10.0, 0.01)) - impulse(start)).norm() < 1e-5);
}

TEST_CASE("with damping and nothing to drive it a body only loses energy and rests upright") {
  const Body body(dragging());
  BodyState state = tumbling(body);
  double energy = energy_j(body, state);
  for (int i = 0; i < 4000; ++i) {
    state = body.step(state, {}, {}, 0.02);
    const double next = energy_j(body, state);
    REQUIRE(next <= energy + 1e-9);
    energy = next;
  }
  CHECK_THAT(attitude_of(state.pose.enu_from_body).roll_rad, WithinAbs(0.0, 1e-3));
  CHECK_THAT(attitude_of(state.pose.enu_from_body).pitch_rad, WithinAbs(std::atan2(-0.01, 0.03), 1e-3));
}

TEST_CASE("the integrator is of fourth order") {
  const Body body(dragging());
  const BodyState start = tumbling(body);
  const auto end = [&](double h) { return run(body, start, 2.0, h).pose.position_enu_m; };
  const Vec3 exact = end(0.0025);
  const double coarse = (end(0.04) - exact).norm(), fine = (end(0.02) - exact).norm();
  // The error falls by 2^4; 12 to 20 leaves room for the next order at these steps.
  CHECK(coarse / fine > 12.0);
  CHECK(coarse / fine < 20.0);
  CHECK(fine < 1e-6);  // metres after 2 s at the step that the header names
}

TEST_CASE("a mirrored start makes a mirrored way") {
  HydrodynamicParameters p = dragging();
  p.cross_flow = CrossFlow{1.6, 0.2, 1.1};
  const Body body(p);
  BodyState port = body.at_rest({}), starboard = port;
  port.pose.enu_from_body = enu_from_body({0, 0.1, 0.2});
  starboard.pose.enu_from_body = enu_from_body({0, 0.1, -0.2});
  port.velocity << 1, 0.2, 0.1, 0.3, 0.1, -0.2;
  starboard.velocity << 1, -0.2, 0.1, -0.3, 0.1, 0.2;
  port = run(body, port, 5.0, 0.02);
  starboard = run(body, starboard, 5.0, 0.02);
  const Vec3 a = port.pose.position_enu_m, b = starboard.pose.position_enu_m;
  CHECK(a.x() == Approx(-b.x()));
  CHECK(a.y() == Approx(b.y()));
  CHECK(a.z() == Approx(b.z()));
  CHECK(std::abs(a.x()) > 0.05);
}

TEST_CASE("a steady current carries everything with it") {
  const Body body(dragging());
  const Surroundings stream{{0.4, -0.7, 0.0}, 0.0};
  const BodyState still = tumbling(body);
  BodyState carried = still;
  carried.velocity.head<3>() += still.pose.enu_from_body.conjugate() * stream.current_enu_mps;
  const BodyState a = run(body, still, 10.0, 0.02), b = run(body, carried, 10.0, 0.02, stream);
  CHECK((b.pose.position_enu_m - a.pose.position_enu_m - 10.0 * stream.current_enu_mps).norm() < 1e-5);
  CHECK(b.pose.enu_from_body.angularDistance(a.pose.enu_from_body) < 1e-6);
}

TEST_CASE("quadratic drag alone stops a body along a logarithm") {
  HydrodynamicParameters p = frictionless();
  p.quadratic_damping(0) = 16;
  p.gravity_centre_body_m = Vec3::Zero();  // nothing pitches it
  const Body body(p);
  BodyState state = body.at_rest({});
  state.velocity(0) = 2.0;
  state = run(body, state, 10.0, 0.01);
  // m v' = -k v^2: v = v0 / (1 + k v0 t / m), x = m / k ln(1 + k v0 t / m), with m = 30 + 2.
  CHECK(state.velocity(0) == Approx(2.0 / 11.0).epsilon(1e-6));
  CHECK(state.pose.position_enu_m.y() == Approx(2.0 * std::log(11.0)).epsilon(1e-6));
}

TEST_CASE("cross-flow drag is the strip integral, where the flow turns too") {
  HydrodynamicParameters p = frictionless();
  const Body bare(p);
  p.cross_flow = CrossFlow{2.0, 0.3, 1.2};
  const Body body(p);
  for (const double v : {0.0, 0.3, -0.8}) {
    for (const double r : {0.0, 0.5, -1.5}) {
      BodyState state = body.at_rest({});
      state.velocity << 0, v, 0, 0, 0, r;
      double force = 0.0, moment = 0.0;
      constexpr int kStrips = 20000;
      for (int i = 0; i < kStrips; ++i) {
        const double x = -1.0 + 2.0 * (i + 0.5) / kStrips, flow = v + x * r;
        force -= 0.5 * 1026 * 0.3 * 1.2 * std::abs(flow) * flow * 2.0 / kStrips;
        moment -= 0.5 * 1026 * 0.3 * 1.2 * std::abs(flow) * flow * x * 2.0 / kStrips;
      }
      const Vec6 drag = body.passive_force(state, {}) - bare.passive_force(state, {});
      CHECK_THAT(drag(1), WithinAbs(force, 1e-3));
      CHECK_THAT(drag(5), WithinAbs(moment, 1e-3));
    }
  }
}

TEST_CASE("revolutions give back the thrust they were asked for") {
  Propeller propeller;
  propeller.ahead_ns2 = 0.2;
  propeller.astern_ns2 = 0.1;
  propeller.advance_loss_ns2pm = 0.5;
  propeller.fastest_rps = 30;
  for (const double thrust : {-40.0, -1.0, 5.0, 60.0}) {
    CHECK(thrust_n(propeller, revolutions_rps(propeller, thrust, 1.5), 1.5) == Approx(thrust));
  }
  CHECK(revolutions_rps(propeller, 1e4, 1.5) == 30.0);
}

TEST_CASE("actuators follow commands with their time constant, within their limits") {
  HydrodynamicParameters p = frictionless();
  Propeller propeller;
  propeller.ahead_ns2 = propeller.astern_ns2 = 1e-6;
  propeller.fastest_rps = 10;
  propeller.time_constant_s = 2;
  p.propellers = {propeller};
  const Body body(p);
  const BodyState state = run(body, body.at_rest({}), 2.0, 0.02, {}, Eigen::VectorXd::Constant(1, 50.0));
  CHECK(state.actuators(0) == Approx(10 * (1 - std::exp(-1.0))).epsilon(1e-6));
}

TEST_CASE("what cannot be is refused") {
  HydrodynamicParameters p = frictionless();
  p.mass_kg = 0;
  CHECK_THROWS_WITH(Body(p), "hydrodynamics: mass, density and gravity must be above 0");
  p = frictionless();
  p.fins = {Fin{{-1, 0, 0}, {0, 2, 0}, 0.01, 1.0}};
  CHECK_THROWS_WITH(Body(p), "hydrodynamics: a fin's lift must be of unit length");
}
