#include "kernels/acoustics/echo/multipath.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace ensonify;
using namespace ensonify::echo;
using Catch::WithinAbs;
using frames::Vec3;

constexpr double kSpeed = 1500.0, kAlpha = 0.05;
static const Carrier kCarrier{100e3, kAlpha};

/// Power 1 below, this much above.
static array::Pattern face_down(double above) {
  return array::Pattern().times_power(
      array::FaceFactor{Eigen::Vector3f::UnitZ(), array::Face(0.0, -10.0 * std::log10(above))});
}

/// An omnidirectional head of 200 dB, `depth_m` below a surface at 1.5 m, at rest.
struct Geometry {
  double depth_m, altitude_m;
  SurfaceMirror surface{1.5, kSpeed};
  array::Pattern transmit;
  MultipathHead head{200.0, {&transmit, 1}, 12.0};
  frames::HeadPose pose{{3.0, -2.0, 1.5 - depth_m}, frames::enu_from_ned()};
  Receivers receivers;

  Geometry(double depth, double altitude) : depth_m(depth), altitude_m(altitude) {
    receivers.set({0, 1, std::span(&pose, 1)});
  }
  double bottom_m() const { return pose.position_enu_m.z() - altitude_m; }

  /// One scatterer at a ground range of the head, of cross section 1 cm^2.
  Scatterer at(double ground_m) const {
    Scatterer one;
    one.position_enu_m = {pose.position_enu_m.x() + ground_m, pose.position_enu_m.y(), bottom_m()};
    one.slowness_spm = float(1 / kSpeed);
    one.cross_section_m2 = 1e-4F;
    one.scattered_upa2m2 = 1e-4F * 1e20F / float(std::pow(ground_m, 2) + altitude_m * altitude_m);
    one.response = {0.6F, -0.8F};
    return one;
  }
  Arrivals multipath(double ground_m, const MultipathParts& parts) const {
    const Scatterer one = at(ground_m);
    Arrivals arrivals;
    add_multipath(kCarrier, head, surface, parts, pose, {one}, receivers, arrivals);
    return arrivals;
  }
};

static double level_db(const Arrival& arrival) { return 10 * std::log10(std::norm(arrival.pressure_upa)); }

TEST_CASE("an echo's contributor says by which path it came") {
  const Geometry geometry(4.0, 20.0);
  Scatterer one = geometry.at(30.0);
  one.contributor = trace::sediment_contributor(9);
  Arrivals arrivals;
  add_multipath(kCarrier, geometry.head, geometry.surface, {}, geometry.pose, {one}, geometry.receivers, arrivals);
  REQUIRE(arrivals.size() == 5);
  const trace::Contributors table;
  using Path = trace::EchoPath;
  const Path paths[] = {Path::kViaSurface, Path::kViaSurface, Path::kViaBottom, Path::kViaBottom};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(table[arrivals[i].contributor].sediment == 9);
    CHECK((table[arrivals[i].contributor].path == paths[i]));
    CHECK(trace::by_path(arrivals[i].contributor, Path::kDirect) == one.contributor);
  }
  CHECK(arrivals[4].contributor == trace::kNoise);  // the surface overhead
}

TEST_CASE("an oblique ghost arrives after R1 + R2 from above and below, added as pressures") {
  const Geometry geometry(4.0, 20.0);
  const double x = 30.0, D = 24.0, d = 4.0;
  const double R1 = std::hypot(x, 20.0), R2 = std::hypot(x, D + d);
  const auto ghosts = geometry.multipath(x, {true, false, false});
  REQUIRE(ghosts.size() == 2);
  const double want_db = 200 - 40 - 20 * std::log10(R1 * R2) - kAlpha * (R1 + R2);
  for (const Arrival& ghost : ghosts) {
    CHECK(ghost.time_s == Approx((R1 + R2) / kSpeed).epsilon(1e-7));
    CHECK_THAT(level_db(ghost), WithinAbs(want_db, 0.001));
  }
  CHECK(ghosts[0].direction_head.z() == Approx(-(D + d) / R2).epsilon(1e-5));  // seabed - surface comes from above
  CHECK(ghosts[1].direction_head.z() == Approx(20.0 / R1).epsilon(1e-5));
  CHECK_THAT(20 * std::log10(std::abs(ghosts[0].pressure_upa + ghosts[1].pressure_upa)),
             WithinAbs(want_db + 6.0206, 0.01));
  // The direct echo's phase, later by the longer way and turned over by the surface.
  Arrivals direct;
  const Scatterer one = geometry.at(x);
  add_direct_echoes(kCarrier, geometry.pose.position_enu_m, {one}, geometry.receivers, direct);
  const auto turn = std::polar(1.0, -2 * std::numbers::pi * 100e3 * (ghosts[0].time_s - direct[0].time_s));
  const auto ratio = std::complex<double>(ghosts[0].pressure_upa) / std::complex<double>(direct[0].pressure_upa);
  CHECK(std::abs(std::arg(-ratio / turn)) < 1e-3);
}

TEST_CASE("without speckle an aperture's pair is (sqrt(bT1 bR2) + sqrt(bT2 bR1))^2 of one path") {
  // Below the head bT1 and bR1, above it bT2 and bR2. One aperture both ways: 6.02 dB more than one path.
  Carrier carrier = kCarrier;
  carrier.sum = Sum::kMeanSquare;
  constexpr double kBelow = 0.81, kAbove = 0.09;
  for (const auto& [received_below, received_above] : {std::pair{kBelow, kAbove}, {1.0, 1.0}, {0.25, 0.0}}) {
    Geometry geometry(4.0, 20.0);
    geometry.transmit = face_down(kAbove);
    Scatterer one = geometry.at(30.0);
    one.scattered_upa2m2 *= float(kBelow);  // what the rays carried
    Arrivals arrivals;
    add_direct_echoes(carrier, geometry.pose.position_enu_m, {one}, geometry.receivers, arrivals);
    const PairedArrivals paired = add_multipath(carrier, geometry.head, geometry.surface, {true, false, false},
                                                geometry.pose, {one}, geometry.receivers, arrivals);
    REQUIRE(arrivals.size() == 3);
    CHECK(paired.first == 1);
    CHECK(paired.pairs() == 1);
    std::vector<float> gain;
    for (const Arrival& arrival : arrivals)
      gain.push_back(float(std::sqrt(arrival.direction_head.z() > 0 ? received_below : received_above)));
    power_gains(arrivals, paired, nullptr, gain);
    const double R1 = std::hypot(30.0, 20.0), R2 = std::hypot(30.0, 28.0);
    const double one_path = std::pow(10.0, 20.0 - 4.0 - 0.1 * kAlpha * (R1 + R2)) / std::pow(R1 * R2, 2);
    const double pair = double(arrivals.pressure_re_upa[1] * gain[1]) + double(arrivals.pressure_re_upa[2] * gain[2]);
    const double amplitudes = std::sqrt(kBelow * received_above) + std::sqrt(kAbove * received_below);
    CHECK(pair / one_path == Approx(amplitudes * amplitudes).epsilon(1e-4));  // float
    CHECK(double(gain[0]) == Approx(received_below));                         // the direct echo has no part in it
    if (received_below == kBelow) {
      CHECK_THAT(10 * std::log10(pair / (one_path * kBelow * kAbove)), WithinAbs(6.0206, 0.001));
    }
  }
}

TEST_CASE("the second bottom echo comes after both heights of water") {
  const Geometry geometry(4.0, 20.0);
  const auto second = geometry.multipath(0.0, {false, true, false});
  REQUIRE(second.size() == 2);
  const double long_m = 20.0 + 2 * 24.0;  // of the leg by way of the seabed and the surface: H + 2 D
  for (const Arrival& arrival : second) {
    CHECK(arrival.time_s == Approx(2 * (20.0 + 24.0) / kSpeed).epsilon(1e-7));
    CHECK_THAT(level_db(arrival), WithinAbs(200 - 40 - 20 * std::log10(20.0 * long_m) - kAlpha * 88 - 12, 0.001));
    CHECK(arrival.direction_head.z() == Approx(1.0));  // from below
  }
}

TEST_CASE("the echo of the surface is that of an image source") {
  const Arrivals echoes = Geometry(4.0, 20.0).multipath(10.0, {false, false, true});
  REQUIRE(echoes.size() == 1);
  CHECK(echoes[0].time_s == Approx(8.0 / kSpeed).epsilon(1e-9));
  CHECK_THAT(level_db(echoes[0]), WithinAbs(200 - 20 * std::log10(8.0) - kAlpha * 8.0, 0.001));
  CHECK(echoes[0].direction_head.z() == Approx(-1.0));
}

TEST_CASE("paths leave and arrive where the patterns say") {
  // A head that sends downwards only: nothing goes to the surface first; what comes back from above is still received.
  Geometry geometry(4.0, 20.0);
  geometry.transmit = face_down(0.0);
  const auto ghosts = geometry.multipath(30.0, {true, false, true});
  CHECK(std::norm(ghosts[0].pressure_upa) > 0);
  CHECK(ghosts[1].pressure_upa == std::complex<float>{});
  CHECK(ghosts[2].pressure_upa == std::complex<float>{});
}

TEST_CASE("waves and bubbles take the coherent reflection away") {
  const SurfaceMirror calm{0, kSpeed}, rough{0, kSpeed, 3.0, 2e-3};
  CHECK(surface_reflection(calm, 300e3, 0.7) == Approx(-1));  // pressure release
  // 2 k sigma sin = 2 x 1256.6 x 0.002 x 0.5 = 2.513: exp(-2.513^2 / 2) is -27.4 dB, bubbles 3 dB more.
  CHECK_THAT(20 * std::log10(-surface_reflection(rough, 300e3, 0.5)), WithinAbs(-27.43 - 3, 0.01));
}

TEST_CASE("where waves leave nothing, nothing is added") {
  // At 30 m the surface is hit at 43 degrees: 2 k sigma sin = 4 leaves e^-8, 3e-4; 6 leaves 2e-8.
  Geometry geometry(4.0, 20.0);
  const double sine = 28.0 / std::hypot(28.0, 30.0), wavenumber = 2.0 * std::numbers::pi * 100e3 / kSpeed;
  geometry.surface.rms_height_m = 4.0 / (2.0 * wavenumber * sine);
  CHECK(geometry.multipath(30.0, {true, true, false}).size() == 4);
  geometry.surface.rms_height_m = 6.0 / (2.0 * wavenumber * sine);
  CHECK(geometry.multipath(30.0, {true, true, false}).empty());
}

TEST_CASE("nothing is added for a head in the air") {
  const Geometry above(-0.5, 20.0);
  CHECK(above.multipath(10.0, {}).empty());
}
