#include "components/multibeam/steering.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "components/multibeam/test_head.h"
#include "kernels/array/stabilisation.h"

using namespace ensonify;
using frames::Vec3;

namespace {

constexpr double kDegree = MultibeamConfig::kDegree;

/// Angle from the vertical across the track at which a beam lies, with the head turned like this.
double across_rad(const Steering& steering, std::size_t beam, const frames::Attitude& attitude) {
  frames::Attitude counted = attitude;
  counted.heading_rad = 0.0;
  const frames::Quaternion level_from_head = frames::enu_from_ned().conjugate() * frames::enu_from_body(counted);
  const auto direction =
      array::cone_intersection(level_from_head * Vec3::UnitX(), steering.sin_transmit, level_from_head * Vec3::UnitY(),
                               static_cast<double>(steering.sin_beams[beam]));
  return std::atan2(direction->y(), direction->z());
}

}  // namespace

TEST_CASE("stabilised beams keep their angles from the vertical, whatever roll and pitch") {
  const MultibeamConfig config = head_in_plain_water();
  for (const double roll_deg : {-10.0, 0.0, 10.0}) {
    for (const double pitch_deg : {-4.0, 0.0, 4.0}) {
      const frames::Attitude attitude{1.0, pitch_deg * kDegree, roll_deg * kDegree};
      const Steering steering = steer(config, {1500.0, attitude});
      CHECK((steering.roll_stabilised && steering.pitch_stabilised));
      for (const std::size_t beam : {0U, 60U, 128U, 255U}) {  // of a float sine at 75 degrees: 2e-7
        CHECK(across_rad(steering, beam, attitude) ==
              Approx(static_cast<double>(steering.across_rad[beam])).margin(1e-6));
      }
    }
  }
}

TEST_CASE("without stabilisation, and without a motion sensor, angles are counted from the head's own axis") {
  MultibeamConfig config = head_in_plain_water();
  const auto unsteered = [](const Steering& s) {
    return s.sin_transmit == 0.0 && s.middle_rad == 0.0 && !s.roll_stabilised && !s.pitch_stabilised &&
           std::abs(s.beam_angle_rad[255] - static_cast<float>(65.0 * kDegree)) < 1e-6F;
  };
  CHECK(unsteered(steer(config, {1500.0, std::nullopt})));
  config.roll_stabilised = config.pitch_stabilised = false;
  CHECK(unsteered(steer(config, {1500.0, frames::Attitude{0.0, 0.1, 0.1}})));
}

TEST_CASE("a beam is never steered behind the face") {
  MultibeamConfig config = head_in_plain_water();
  config.swath_rad = 170.0 * kDegree;
  const Steering steering = steer(config, {1500.0, frames::Attitude{0.0, 0.0, 15.0 * kDegree}});
  for (const float sine : steering.sin_beams) CHECK(std::abs(sine) <= 1.0F);
  CHECK(std::ranges::is_sorted(steering.sin_beams));
}
