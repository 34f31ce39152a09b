#include <catch2/catch.hpp>

#include "components/navigation/testing/circle.h"

using namespace ensonify;
using namespace ensonify::test_run;
using Catch::WithinAbs;

namespace {

struct Nees {
  double position = 0.0, velocity = 0.0, rotation = 0.0;
};

double normalised(const frames::Vec3& error, const std::array<double, 9>& covariance) {
  const Eigen::Matrix3d p = Eigen::Map<const Eigen::Matrix3d>(covariance.data());  // symmetric
  return error.dot(p.ldlt().solve(error));
}

Nees nees_of(const msg::Estimate& estimate) {
  const msg::Pose truth = circling(SimTime{estimate.stamp_ns}, kLevel);
  const auto off = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return frames::Vec3(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  };
  const Eigen::AngleAxisd turn(frames::canonical(frames::quaternion_of(estimate.enu_from_body) *
                                                 frames::quaternion_of(truth.enu_from_body).conjugate()));
  return {normalised(off(estimate.position_enu_m, truth.position_enu_m), estimate.position_covariance_enu_m2),
          normalised(off(estimate.velocity_enu_mps, truth.velocity_enu_mps), estimate.velocity_covariance_enu_m2ps2),
          normalised(turn.angle() * turn.axis(), estimate.rotation_covariance_enu_rad2)};
}

/// Mean of 200 seeds at epochs of 5 s, on 75 s of a circle, with these instruments.
std::vector<Nees> mean_nees(const std::string& carried) {
  constexpr int kEpochs = 15;
  constexpr double kRuns = 200;
  std::vector<Nees> mean(kEpochs);
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    NavigationConfig config = config_of(carried, seed);
    config.attitude_rate_hz = 10;
    NodeUnderTest<NavigationNode> navigation(config);
    navigation.give_each("pose", kEpochs * 5_s, 100_ms, [](SimTime t) { return circling(t, kLevel); });
    const auto estimates = navigation.step_until<msg::Estimate>("estimate", kEpochs * 5_s);
    REQUIRE(estimates.size() == 50 * kEpochs + 1);
    for (std::size_t epoch = 0; epoch < kEpochs; ++epoch) {
      const Nees nees = nees_of(estimates[50 * (epoch + 1)]);
      mean[epoch].position += nees.position / kRuns;
      mean[epoch].velocity += nees.velocity / kRuns;
      mean[epoch].rotation += nees.rotation / kRuns;
    }
  }
  return mean;
}

double mean_of(const std::vector<Nees>& epochs, double Nees::*of) {
  double sum = 0.0;
  for (const Nees& epoch : epochs) sum += epoch.*of;
  return sum / static_cast<double>(epochs.size());
}

}  // namespace

TEST_CASE("estimates are as wrong as they say, with instruments as graded") {
  const std::string gnss = "gnss: { grade: rtk, position_m: [-1, 0.5, -3] }\n";
  const std::string magnetic = gnss +
                               "imu: { grade: mems, position_m: [2, 0.5, 1], rotation_deg: [0, 0, 90], "
                               "measured_rotation_deg: [0, 0, 90] }\nheading: { grade: magnetic }";
  const std::string satellite = gnss + "imu: { grade: fog, position_m: [1, 0.5, 0.3] }\nheading: { grade: satellite }";
  // The mean of 200 with three degrees of freedom each has the deviation sqrt(6 / 200) = 0.17. A run's epochs share
  // what is drawn once, so their mean is hardly more certain: 3.3 deviations, one in a thousand.
  const auto check = [](const std::vector<Nees>& epochs) {
    for (double Nees::*of : {&Nees::position, &Nees::velocity, &Nees::rotation}) {
      CHECK_THAT(mean_of(epochs, of), WithinAbs(3.0, 0.57));
    }
  };
  check(mean_nees(magnetic));
  check(mean_nees(satellite));
}
