#include "kernels/instruments/sensors/doppler_log.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace ensonify;
using namespace ensonify::sensors;
using Catch::WithinAbs;

namespace {

const JanusGeometry kJanus;
const frames::Vec3 kVelocity(2.0, -0.3, 0.1);
const std::array<std::optional<double>, 4> kNear{20.0, 21.0, 22.0, 23.0};

}  // namespace

TEST_CASE("without noise four beams, and three, give the velocity itself") {
  const DopplerLog log(kJanus, {}, random::Stream(1, "dvl"));
  const DopplerReading four = log.bottom_track(kVelocity, kNear, 1);
  REQUIRE(four.valid);
  CHECK((four.velocity_mps - kVelocity).norm() < 1e-12);
  CHECK(std::abs(four.error_velocity_mps) < 1e-12);
  CHECK(*four.altitude_m == Approx(21.5 * std::cos(kJanus.slant_rad)));
  auto three = kNear;
  three[2].reset();
  CHECK((log.bottom_track(kVelocity, three, 1).velocity_mps - kVelocity).norm() < 1e-12);
}

TEST_CASE("bottom lock needs three beams within range") {
  const DopplerLog log(kJanus, {.longest_m = 21.5}, random::Stream(1, "dvl"));
  const DopplerReading reading = log.bottom_track(kVelocity, kNear, 1);  // two beams are too long
  CHECK(!reading.valid);
  CHECK(reading.range_m[0].has_value());
  CHECK(!reading.range_m[3].has_value());
  CHECK(log.water_track(kVelocity, 1).valid);
}

TEST_CASE("velocity is as noisy as a Janus of 30 degrees makes of its beams, and as stated") {
  // One beam's noise s: across s / (sqrt 2 sin 30) = 1.414 s, down s / (2 cos 30) = 0.577 s; 4 x 1.1 % allowed.
  const DopplerLog log(kJanus, {.beam_white_mps = 0.01}, random::Stream(1, "dvl"));
  frames::Vec3 squares = frames::Vec3::Zero();
  double disagreement = 0.0;
  constexpr int kCount = 4000;
  for (std::uint64_t n = 0; n < kCount; ++n) {
    const DopplerReading r = log.bottom_track(kVelocity, kNear, n);
    squares += (r.velocity_mps - kVelocity).cwiseAbs2();
    disagreement += r.error_velocity_mps * r.error_velocity_mps;
    if (n == 0) {
      CHECK(r.sigma_mps.x() == Approx(0.01 * std::sqrt(2.0)));
      CHECK(r.sigma_mps.z() == Approx(0.01 / std::sqrt(3.0)));
    }
  }
  CHECK(std::sqrt(squares.x() / kCount) == Approx(0.01 * std::sqrt(2.0)).epsilon(0.045));
  CHECK(std::sqrt(squares.y() / kCount) == Approx(0.01 * std::sqrt(2.0)).epsilon(0.045));
  CHECK(std::sqrt(squares.z() / kCount) == Approx(0.01 / std::sqrt(3.0)).epsilon(0.045));
  CHECK(std::sqrt(disagreement / kCount) == Approx(0.01 / std::sqrt(3.0)).epsilon(0.045));
}

TEST_CASE("beams drop out as often as stated; a scale error is the same in all pings") {
  const DopplerLog log(kJanus, {.scale = 0.01, .dropout = 0.2}, random::Stream(1, "dvl"));
  int lost = 0;
  double scale = 0.0;
  for (std::uint64_t n = 0; n < 2000; ++n) {
    const DopplerReading r = log.bottom_track(kVelocity, kNear, n);
    for (const auto& range : r.range_m) lost += range ? 0 : 1;
    if (!r.valid) continue;
    const double now = r.velocity_mps.x() / kVelocity.x();
    if (scale != 0.0) REQUIRE(now == Approx(scale).epsilon(1e-12));
    scale = now;
  }
  CHECK_THAT(lost / 8000.0, WithinAbs(0.2, 0.018));  // four times sqrt(0.2 * 0.8 / 8000)
  CHECK(scale != 1.0);
}

TEST_CASE("a current profiler sees the water's layers down to the side lobes' reach") {
  const BinLayout layout{1.0, 2.0, 20};
  std::vector<frames::Vec3> past(20);
  for (std::size_t i = 0; i < past.size(); ++i) past[i] = {-1.0 + 0.05 * static_cast<double>(i), 0.3, 0.0};
  const random::Stream stream(1, "adcp");
  const auto bins = profile_current(kJanus, {}, layout, past, 25.0, stream, 1);
  // Of 25 m cos 30 = 21.65 m are clear: bins end at 3, 5, ... 21 m.
  REQUIRE(bins.size() == 10);
  CHECK(bins[9].depth_below_m == 20.0);
  CHECK((bins[4].velocity_mps - past[4]).norm() < 1e-12);
  CHECK(profile_current(kJanus, {.longest_m = 10.0}, layout, past, std::nullopt, stream, 1).size() == 3);
  CHECK(profile_current(kJanus, {.beam_white_mps = 0.1}, layout, past, 25.0, stream, 1)[0].sigma_mps ==
        Approx(0.1 * std::sqrt(2.0)));
}
