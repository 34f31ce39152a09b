// Echoes in columns against the formulas of the page (docs/physics/acoustics/echo.md, multipath.md), scatterer by
// scatterer in double with the C library's functions.
#include "kernels/acoustics/echo/run.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

#include "kernels/acoustics/echo/multipath.h"

using namespace ensonify;
using namespace ensonify::echo;
using frames::Vec3;

namespace {

constexpr double kPi = std::numbers::pi, kSpeed_mps = 1490.0;

struct Echo {
  double time_s = 0.0;
  std::complex<double> pressure_upa;
  Eigen::Vector3d direction_head;
};

/// A head that moves at 5 m/s, sinks and turns, 400 m east and 3 km south of the origin; a transmit pattern with a
/// lobe; waves that leave a part.
struct Sea {
  Carrier carrier{400e3, 0.11};
  std::vector<frames::HeadPose> poses;
  ReceiveTrack track;
  Receivers receivers;
  array::Pattern transmit;
  Multipath multipath;

  explicit Sea(Sum sum, int number_of_poses = 40) {
    carrier.sum = sum;
    for (int i = 0; i < number_of_poses; ++i) {
      poses.push_back(
          {Vec3(400.0 + 0.02 * i, -3000.0 + 0.015 * i, -3.0 - 0.002 * i * i),
           frames::enu_from_body({.heading_rad = 0.7 + 0.002 * i, .pitch_rad = 0.01 * i, .roll_rad = 0.3})});
    }
    track = {0.0, 0.005, poses};
    receivers.set(track);
    transmit.times(array::GaussianFactor{0.4}).times_power(array::CosineFactor{1.5F});
    multipath.head = {215.0, {&transmit, 1}, 12.0};
    multipath.surface = {0.4, kSpeed_mps, 1.5, 0.4e-3};
  }

  const frames::HeadPose& pose() const { return poses.front(); }

  /// The receiver between the two poses that a time lies between, or at the nearest.
  Receivers::At receiver(double time_s) const {
    const auto last = static_cast<double>(poses.size() - 1);
    const double step = std::clamp((time_s - track.start_s) / track.period_s, 0.0, last);
    const auto before = static_cast<std::size_t>(std::min(step, std::max(0.0, last - 1.0)));
    const frames::HeadPose &a = poses[before], &b = poses[std::min(before + 1, poses.size() - 1)];
    const double f = step - static_cast<double>(before);
    const Eigen::Matrix3d m = a.enu_from_head.toRotationMatrix().transpose(),
                          n = b.enu_from_head.toRotationMatrix().transpose();
    return {a.position_enu_m + f * (b.position_enu_m - a.position_enu_m), (m + f * (n - m)).cast<float>()};
  }

  Echo echo(const Scatterer& one, double time_s, double mean_square, double sign,
            const Eigen::Vector3d& direction) const {
    const double share = one.share;
    if (carrier.sum == Sum::kMeanSquare) return {time_s, share * mean_square, direction};
    const double cycles = carrier.frequency_hz * time_s;
    const auto phasor = std::polar(1.0, -2.0 * kPi * (cycles - std::floor(cycles)));
    return {time_s, share * sign * std::sqrt(mean_square) * phasor * std::complex<double>(one.response), direction};
  }

  Echo direct(const Scatterer& one) const {
    const double slowness = one.slowness_spm, out_m = (one.position_enu_m - pose().position_enu_m).norm();
    const Receivers::At at = receiver(2.0 * out_m * slowness);
    const Vec3 back = one.position_enu_m - at.position_enu_m;
    const double back_m = std::max(back.norm(), 1e-3);
    const double loss = std::pow(10.0, -0.1 * carrier.absorption_dbpm * double(one.stretch) * (out_m + back_m));
    const double mean_square = double(one.scattered_upa2m2) * loss / (double(one.spreading) * back_m * back_m);
    const Vec3 direction = at.head_from_enu.cast<double>() * (back / back_m + one.bend_enu.cast<double>());
    return echo(one, out_m * slowness + back_m * slowness, mean_square, 1.0, direction.normalized());
  }

  /// Left for `to` with this mean square at 1 m, after `out_m` back from `from`.
  Echo by_way_of(const Scatterer& one, double at_1m, double reflected, double out_m, const Vec3& from) const {
    const double c = multipath.surface.sound_speed_mps;
    const Receivers::At at = receiver((out_m + (from - pose().position_enu_m).norm()) / c);
    const Vec3 back = from - at.position_enu_m;
    const double back_m = std::max(back.norm(), 1e-3), whole_m = out_m + back_m;
    const double mean_square =
        at_1m * reflected * reflected * std::pow(10.0, -0.1 * carrier.absorption_dbpm * whole_m) / (back_m * back_m);
    return echo(one, whole_m / c, mean_square, reflected < 0.0 ? -1.0 : 1.0,
                at.head_from_enu.cast<double>() * (back / back_m));
  }

  /// Out directly and back from the image at this height; and in the other order.
  std::array<Echo, 2> by_image(const Scatterer& one, double image_z, double mirror) const {
    const Vec3 &at = one.position_enu_m, image(at.x(), at.y(), image_z);
    const Vec3 leg = image - pose().position_enu_m, out = at - pose().position_enu_m;
    const double sine = std::abs(leg.z()) / leg.norm();
    const double V = surface_reflection(multipath.surface, carrier.frequency_hz, sine) * mirror;
    const Eigen::Vector3f launch = (pose().enu_from_head.conjugate() * leg.normalized()).cast<float>();
    const double sent =
        std::pow(10.0, 0.1 * multipath.head.source_level_db) * array::power(multipath.head.transmit, launch);
    const double insonified = sent * double(one.cross_section_m2) / leg.squaredNorm();
    return {by_way_of(one, one.scattered_upa2m2, V, out.norm(), image), by_way_of(one, insonified, V, leg.norm(), at)};
  }
};

/// From 0.3 m to 120 m away, all directions, some above the surface, some straight below.
Scatterers scatterers(const Sea& sea, std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0), both(-1.0, 1.0);
  Scatterers all;
  for (std::size_t i = 0; i < count; ++i) {
    Scatterer one;
    const double range_m = 0.3 * std::pow(400.0, unit(random));
    Vec3 away(both(random), both(random), both(random) - 0.7);
    if (i % 7 == 0) away = -Vec3::UnitZ();
    if (i % 11 == 0) away.z() = 1e-3;
    one.position_enu_m = sea.pose().position_enu_m + range_m * away.normalized();
    one.bend_enu = 0.02F * Eigen::Vector3d(both(random), both(random), both(random)).cast<float>();
    one.slowness_spm = static_cast<float>((1.0 + 1e-3 * both(random)) / kSpeed_mps);
    one.stretch = static_cast<float>(1.0 + 1e-3 * unit(random));
    one.spreading = static_cast<float>(1.0 + 0.2 * both(random));
    one.scattered_upa2m2 = static_cast<float>(std::pow(10.0, 8.0 + 12.0 * unit(random)));
    one.cross_section_m2 = static_cast<float>(std::pow(10.0, -9.0 + 8.0 * unit(random)));
    one.response = {static_cast<float>(both(random)), static_cast<float>(both(random))};
    one.share = static_cast<float>(unit(random));
    one.contributor = trace::sediment_contributor(static_cast<std::uint8_t>(i % 5));
    all.push_back(one);
  }
  return all;
}

/// The largest differences between echoes and the formulas.
struct Errors {
  double time = 0.0, phase_rad = 0.0, level_db = 0.0, direction = 0.0;
  std::size_t compared = 0;

  void add(const Arrival& found, const Echo& want) {
    time = std::max(time, std::abs(found.time_s - want.time_s) / want.time_s);
    direction = std::max(direction, (found.direction_head.cast<double>() - want.direction_head).cwiseAbs().maxCoeff());
    const std::complex<double> pressure(found.pressure_upa);
    if (std::norm(want.pressure_upa) == 0.0 && std::norm(pressure) == 0.0) return;
    ++compared;
    level_db = std::max(level_db, std::abs(20.0 * std::log10(std::abs(pressure) / std::abs(want.pressure_upa))));
    phase_rad = std::max(phase_rad, std::abs(std::arg(pressure / want.pressure_upa)));
  }
  void check(std::size_t at_least) const {
    INFO("time " << time << ", phase " << phase_rad << " rad, level " << level_db << " dB, direction " << direction);
    CHECK(compared >= at_least);
    CHECK(time < 1e-13);
    CHECK(phase_rad < 5e-7);
    CHECK(level_db < 2e-5);
    CHECK(direction < 3e-7);
  }
};

constexpr std::size_t kMany = 5000;

}  // namespace

TEST_CASE("direct echoes in columns are those of the formula, one by one") {
  for (const Sum sum : {Sum::kPressure, Sum::kMeanSquare}) {
    for (const int poses : {1, 2, 40}) {
      const Sea sea(sum, poses);
      const Scatterers all = scatterers(sea, kMany);
      Arrivals arrivals;
      add_direct_echoes(sea.carrier, sea.pose().position_enu_m, all, sea.receivers, arrivals);
      REQUIRE(arrivals.size() == kMany);
      Errors errors;
      for (std::size_t i = 0; i < kMany; ++i) {
        errors.add(arrivals[i], sea.direct(all[i]));
        REQUIRE(arrivals.contributor[i] == all.contributor[i]);
      }
      errors.check(kMany);
    }
  }
}

TEST_CASE("echoes by the surface in columns are those of the formula, one by one") {
  for (const Sum sum : {Sum::kPressure, Sum::kMeanSquare}) {
    const Sea sea(sum);
    const Scatterers all = scatterers(sea, kMany);
    const SurfaceMirror& surface = sea.multipath.surface;
    Arrivals arrivals;
    const PairedArrivals paired =
        add_multipath(sea.carrier, sea.multipath.head, surface, {}, sea.pose(), all, sea.receivers, arrivals);
    std::vector<Scatterer> below;  // the surface: the others have no image
    for (const Scatterer one : all) {
      if (one.position_enu_m.z() < surface.level_enu_m) below.push_back(one);
    }
    REQUIRE(below.size() < kMany);
    REQUIRE(paired.scatterers == std::array{below.size(), below.size()});
    REQUIRE(arrivals.size() == 4 * below.size() + 1);
    Errors errors;
    for (std::size_t way = 0; way < 2; ++way) {
      const double mirror = way == 0 ? 1.0 : std::pow(10.0, -0.05 * sea.multipath.head.bottom_mirror_loss_db);
      const auto path = way == 0 ? trace::EchoPath::kViaSurface : trace::EchoPath::kViaBottom;
      for (std::size_t i = 0; i < below.size(); ++i) {
        const double z = below[i].position_enu_m.z(), once = 2.0 * surface.level_enu_m - z;
        const auto [first, second] = paired[way * below.size() + i];
        const auto want = sea.by_image(below[i], way == 0 ? once : 2.0 * z - once, mirror);
        errors.add(arrivals[first], want[0]);
        errors.add(arrivals[second], want[1]);
        REQUIRE(arrivals.contributor[first] == trace::by_path(below[i].contributor, path));
        REQUIRE(arrivals.contributor[second] == arrivals.contributor[first]);
      }
    }
    errors.check(2 * kMany);
  }
}

TEST_CASE("direct echoes and those by the surface are the same made together or one after another") {
  const Sea sea(Sum::kPressure);
  const Scatterers all = scatterers(sea, kMany);
  EchoMemory memory;
  Arrivals apart, together;
  together.resize(17);  // of an earlier ping
  add_direct_echoes(sea.carrier, sea.pose().position_enu_m, all, sea.receivers, apart);
  make_echoes(sea.carrier, sea.pose(), all, sea.receivers, nullptr, memory, together);
  CHECK(together == apart);
  const PairedArrivals one =
      add_multipath(sea.carrier, sea.multipath.head, sea.multipath.surface, {}, sea.pose(), all, sea.receivers, apart);
  const PairedArrivals other =
      make_echoes(sea.carrier, sea.pose(), all, sea.receivers, &sea.multipath, memory, together);
  CHECK(together == apart);
  CHECK(other.first == one.first);
  CHECK(other.pairs() == one.pairs());
}

/// Those before a time, in their order.
static std::vector<Arrival> before(const Arrivals& arrivals, double latest_s) {
  std::vector<Arrival> early;
  for (const Arrival one : arrivals) {
    if (one.time_s <= latest_s) early.push_back(one);
  }
  return early;
}

TEST_CASE("what comes after the last sample may be left out, and nothing else") {
  const Sea sea(Sum::kPressure);
  const Scatterers all = scatterers(sea, kMany);
  EchoMemory memory;
  Arrivals every;
  make_echoes(sea.carrier, sea.pose(), all, sea.receivers, &sea.multipath, memory, every);
  for (const double latest_s : {0.004, 0.03, 0.1, 0.4}) {
    Multipath multipath = sea.multipath;
    multipath.latest_s = latest_s;
    Arrivals some;
    const PairedArrivals paired = make_echoes(sea.carrier, sea.pose(), all, sea.receivers, &multipath, memory, some);
    CHECK(paired.first == kMany);
    CHECK(paired.end() + 1 == some.size());
    const auto want = before(every, latest_s), found = before(some, latest_s);
    REQUIRE(found.size() == want.size());
    for (std::size_t i = 0; i < want.size(); ++i) {
      REQUIRE(found[i].time_s == want[i].time_s);
      REQUIRE(found[i].pressure_upa == want[i].pressure_upa);
      REQUIRE(found[i].direction_head == want[i].direction_head);
      REQUIRE(found[i].contributor == want[i].contributor);
    }
    // The receiver moves by 1 m or less: what comes more than that later is not made.
    for (std::size_t i = kMany; i + 1 < some.size(); ++i) REQUIRE(some.time_s[i] < latest_s + 8.0 / kSpeed_mps);
  }
}

TEST_CASE("an echo is the same whatever other scatterers there are") {
  const Sea sea(Sum::kPressure);
  const Scatterers all = scatterers(sea, 3 * Run::kMost + 5);
  EchoMemory memory;
  Arrivals together, alone;
  const PairedArrivals paired =
      make_echoes(sea.carrier, sea.pose(), all, sea.receivers, &sea.multipath, memory, together);
  std::size_t below = 0;  // the surface, before this one
  for (std::size_t i = 0; i < all.size(); ++i) {
    make_echoes(sea.carrier, sea.pose(), {all[i]}, sea.receivers, &sea.multipath, memory, alone);
    REQUIRE(alone.pressure_upa(0) == together.pressure_upa(i));
    if (all.position_enu_m.z[i] >= sea.multipath.surface.level_enu_m) continue;
    const auto [one, other] = paired[below];
    REQUIRE(alone.pressure_upa(1) == together.pressure_upa(one));
    REQUIRE(alone.pressure_upa(2) == together.pressure_upa(other));
    ++below;
  }
  CHECK(below == paired.scatterers[0]);
}
