#include <catch2/catch.hpp>

#include "components/navigation/testing/circle.h"
#include "kernels/instruments/navigation_filter/testing/vehicle.h"

using namespace ensonify;
namespace kernel = ensonify::navigation_filter::test_run;

// Consistency and drift of the filter are tested with grades that its kernel's tests write down
// (navigation_filter/testing/vehicle.h): the kernel reads no files. They are those of the files, but for the quanta,
// which they leave out.

namespace {

void check_same(const inertial::TriadErrors& file, const inertial::TriadErrors& tested) {
  CHECK(file.scale_factor == Approx(tested.scale_factor));
  CHECK(file.misalignment_rad == Approx(tested.misalignment_rad));
  CHECK(file.turn_on_bias == Approx(tested.turn_on_bias));
  CHECK(file.bias_sigma == Approx(tested.bias_sigma));
  CHECK(file.bias_time_s == Approx(tested.bias_time_s));
  CHECK(file.random_walk == Approx(tested.random_walk));
  CHECK(file.rate_random_walk == Approx(tested.rate_random_walk));
}

void check_same(const navigation_filter::StartErrors& file, const navigation_filter::StartErrors& tested) {
  CHECK(file.position_m == Approx(tested.position_m));
  CHECK(file.height_m == Approx(tested.height_m));
  CHECK(file.velocity_mps == Approx(tested.velocity_mps));
  CHECK(file.tilt_rad == Approx(tested.tilt_rad));
  CHECK(file.heading_rad == Approx(tested.heading_rad));
}

void check_same(const HeadingConfig& file, const kernel::Compass& tested) {
  CHECK(file.angle.white == Approx(tested.white_rad));
  CHECK(file.angle.wander == Approx(tested.wander_rad));
  CHECK(file.angle.wander_s == Approx(tested.wander_s));
  std::array deviation = file.errors.deviation_sigma.abcde_rad;
  deviation[0] = std::hypot(file.angle.bias_sigma, deviation[0]);
  for (std::size_t i = 0; i < deviation.size(); ++i) CHECK(deviation[i] == Approx(tested.deviation_rad[i]));
}

}  // namespace

TEST_CASE("the grades that the filter's own tests know are those of the files") {
  const struct {
    const char *imu, *heading;
    const kernel::Grade& tested;
  } grades[] = {{"rlg", "", kernel::kRlg},
                {"fog", "", kernel::kFog},
                {"fog", "satellite", kernel::kFogWithSatellites},
                {"tactical", "", kernel::kTactical},
                {"mems", "magnetic", kernel::kMems}};
  for (const auto& [imu, heading, tested] : grades) {
    CAPTURE(imu, heading);
    const std::string compass = *heading ? std::string("heading: { grade: ") + heading + " }" : "";
    const Instruments carried = test_run::config_of(std::string("imu: { grade: ") + imu + " }\n" + compass).instruments;
    check_same(carried.imu->gyro, tested.imu.gyro);
    check_same(carried.imu->accelerometer, tested.imu.accelerometer);
    check_same(carried.imu->alignment, tested.alignment);
    if (carried.heading) check_same(*carried.heading, tested.compass);
  }
  const Instruments log = test_run::config_of("velocity_log: { grade: performance }").instruments;
  CHECK(log.velocity_log->errors.scale == Approx(kernel::kLogScale));
}
