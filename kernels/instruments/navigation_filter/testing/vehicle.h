#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/instruments/navigation_filter/error_state.h"

// What tests of the filter share: grades of inertial units, a mission, and a vehicle on it that carries all kinds of
// aids, each as wrong as the filter assumes.
namespace ensonify::navigation_filter::test_run {

using inertial::Earth;
using inertial::Inertial;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kDegreePerHour = kDegree / 3600.0;
constexpr double kUg = 9.80665e-6;  // m/s^2
constexpr double kStep_s = 0.2;     // of the IMU; its noise is right at any rate
inline const Earth kEarth;

/// A compass that is read each second; 0: there is none.
struct Compass {
  double white_rad = 0.0;
  double wander_rad = 0.0, wander_s = 60.0;
  std::array<double, 5> deviation_rad{};  // standard deviations of A to E
};

/// The grades of components/navigation/grades, whose grades_test.cpp compares them, without their quanta.
struct Grade {
  inertial::ImuErrors imu;
  StartErrors alignment;  // of the state when the run starts
  Compass compass{};
};
inline const Grade kRlg{
    {{5e-6, 0.001 * kDegree, 0.003 * kDegreePerHour, 0.001 * kDegreePerHour, 3600, 0.001 * kDegree / 60},
     {5e-5, 0.001 * kDegree, 20 * kUg, 5 * kUg, 3600, 5 * kUg}},
    {1.0, 1.0, 0.1, 0.005 * kDegree, 0.02 * kDegree}};
inline const Grade kFog{
    {{3e-5, 0.003 * kDegree, 0.02 * kDegreePerHour, 0.005 * kDegreePerHour, 3600, 0.005 * kDegree / 60},
     {1e-4, 0.003 * kDegree, 50 * kUg, 10 * kUg, 3600, 10 * kUg}},
    {1.0, 1.0, 0.1, 0.01 * kDegree, 0.1 * kDegree}};
inline const Grade kFogWithSatellites{
    kFog.imu, kFog.alignment, {0.03 * kDegree, 0.03 * kDegree, 300, {0.02 * kDegree}}};
inline const Grade kTactical{{{3e-4, 0.017 * kDegree, kDegreePerHour, 0.3 * kDegreePerHour, 1000, 0.1 * kDegree / 60},
                              {3e-4, 0.017 * kDegree, 1000 * kUg, 100 * kUg, 1000, 50 * kUg}},
                             {2.0, 2.0, 0.1, 0.06 * kDegree, 0.6 * kDegree}};
inline const Grade kMems{
    {{1e-3, 0.06 * kDegree, 100 * kDegreePerHour, 8 * kDegreePerHour, 500, 0.3 * kDegree / 60},
     {1e-3, 0.06 * kDegree, 5000 * kUg, 50 * kUg, 500, 100 * kUg}},
    {3.0, 3.0, 0.2, 0.3 * kDegree, 2.0 * kDegree},
    {0.3 * kDegree,
     0.2 * kDegree,
     60,
     {std::hypot(0.3, 0.1) * kDegree, 0.4 * kDegree, 0.3 * kDegree, 0.2 * kDegree, 0.1 * kDegree}}};

constexpr double kLogScale = 0.002, kLogSigma_mps = 0.01, kDepthSigma_m = 0.05;
constexpr double kCurrent_mps = 0.3, kCurrentWalk_mps_per_sqrt_s = 0.004;
constexpr double kUsblWhite_m = 0.3, kCarrier_m = 0.5, kCarrier_s = 300.0;
constexpr std::size_t kUsblAge = 10;  // steps of the IMU: 2 s

inline NavigationState moved(const NavigationState& from, const Vec3& by_ned_m) {
  NavigationState to = from;
  to.latitude_rad += by_ned_m.x() / (meridian_radius_m(kEarth, from.latitude_rad) + from.height_m);
  to.longitude_rad += by_ned_m.y() / ((prime_vertical_radius_m(kEarth, from.latitude_rad) + from.height_m) *
                                      std::cos(from.latitude_rad));
  to.height_m -= by_ned_m.z();
  return to;
}

inline Vec3 apart_ned_m(const NavigationState& to, const NavigationState& from) {
  return {(to.latitude_rad - from.latitude_rad) * (meridian_radius_m(kEarth, from.latitude_rad) + from.height_m),
          (to.longitude_rad - from.longitude_rad) *
              (prime_vertical_radius_m(kEarth, from.latitude_rad) + from.height_m) * std::cos(from.latitude_rad),
          from.height_m - to.height_m};
}

/// A mission's true states and ideal readings: 2 m/s, lines of `line_s` and turns of 180 degrees in 60 s, rolling.
struct Mission {
  std::vector<NavigationState> truth;
  std::vector<Inertial> readings;  // [i] leads from truth[i] to truth[i + 1]
};
inline Mission mission(double duration_s, double line_s, double speed_mps) {
  Mission m;
  NavigationState state{44 * kDegree, -63 * kDegree, -10.0};
  double heading = 30 * kDegree;
  const auto at = [&](double t) {
    state.velocity_ned_mps = speed_mps * Vec3(std::cos(heading), std::sin(heading), 0.0);
    state.ned_from_body =
        Eigen::AngleAxisd(heading, Vec3::UnitZ()) * Eigen::AngleAxisd(2 * kDegree * std::sin(t), Vec3::UnitX());
    return state;
  };
  m.truth.push_back(at(0.0));
  const auto steps = static_cast<int>(duration_s / kStep_s);
  for (int i = 1; i <= steps; ++i) {
    const double t = i * kStep_s, leg = std::fmod(t, line_s + 60.0);
    const bool port = std::fmod(t, 2 * (line_s + 60.0)) > line_s + 60.0;
    if (leg > line_s) heading += (port ? -1 : 1) * std::numbers::pi / 60.0 * kStep_s;
    const NavigationState& from = m.truth.back();
    m.readings.push_back(sensed_between(from, at(t), kStep_s, kEarth));
    state = advance(from, m.readings.back(), kStep_s, kEarth);
    m.truth.push_back(state);
  }
  return m;
}

inline FilterModel model_of(const Grade& grade) {
  FilterModel model;
  model.imu = grade.imu;
  model.fix_wander_horizontal_m = 0.3;
  model.fix_wander_vertical_m = 0.6;
  model.fix_wander_s = 200.0;
  model.log_scale = kLogScale;
  model.current_mps = kCurrent_mps;
  model.current_walk_mps_per_sqrt_s = kCurrentWalk_mps_per_sqrt_s;
  model.carrier_s = kCarrier_s;
  model.compass_wander_rad = grade.compass.wander_rad;
  model.compass_wander_s = grade.compass.wander_s;
  model.compass_deviation_rad = grade.compass.deviation_rad;
  model.remembered_s = 5.0;
  return model;
}

/// What corrects the vehicle besides its depth, and a compass if its grade has one.
struct Aids {
  bool fixes = false;  // each second
  bool bottom = true;  // velocity over ground, each second
  bool water = false;  // velocity through water, each second
  bool usbl = false;   // fixes by a ship, each 2 s, 2 s old
};

/// One vehicle with its own errors, from random streams of `seed`.
class Run {
 public:
  Run(const Mission& m, const Grade& grade, std::uint64_t seed)
      : mission_(m),
        noise_(seed, "noise"),
        wander_stream_(seed, "wander"),
        current_stream_(seed, "current"),
        carrier_stream_(seed, "carrier"),
        compass_stream_(seed, "compass"),
        imu_(grade.imu, {seed, "gyro"}, {seed, "accelerometer"}),
        filter_(start(m.truth[0], grade.alignment), grade.alignment, model_of(grade)),
        grade_(grade),
        scale_(kLogScale * noise_.normal(0, 99)) {
    const FilterModel model = model_of(grade);
    for (std::uint64_t axis = 0; axis < 3; ++axis) {
      wander_[axis] = random::GaussMarkov(axis < 2 ? model.fix_wander_horizontal_m : model.fix_wander_vertical_m,
                                          model.fix_wander_s, wander_stream_, axis);
      carrier_[axis] = random::GaussMarkov(kCarrier_m, kCarrier_s, carrier_stream_, axis);
    }
    const Compass& compass = grade.compass;
    compass_wander_ = random::GaussMarkov(compass.wander_rad, compass.wander_s, compass_stream_, 0);
    for (std::uint64_t i = 0; i < 5; ++i) {
      deviation_rad_[i] = compass.deviation_rad[i] * compass_stream_.normal(0, 10 + i);
    }
    current_ned_mps_ = kCurrent_mps * Vec3(current_stream_.normal(0, 0), current_stream_.normal(0, 1), 0.0);
  }

  void step(std::size_t n, const Aids& aids) {
    filter_.propagate(imu_.measure(mission_.readings[n - 1], kStep_s), kStep_s);
    if (n % 5 != 0) return;
    const NavigationState& truth = mission_.truth[n];
    for (std::uint64_t axis = 0; axis < 3; ++axis) wander_[axis].advance(1.0, wander_stream_, n, axis);
    current_ned_mps_ +=
        kCurrentWalk_mps_per_sqrt_s * Vec3(current_stream_.normal(n, 0), current_stream_.normal(n, 1), 0.0);
    if (aids.fixes) {
      const Vec3 error = 0.02 * noise(n, 0) + Vec3(wander_[0].value(), wander_[1].value(), wander_[2].value());
      filter_.correct_position(fix_at(moved(truth, error), 0.02));
    }
    const frames::Quaternion body_from_ned = truth.ned_from_body.conjugate();
    const Vec3 sigma_mps = Vec3::Constant(kLogSigma_mps);
    if (aids.bottom) {
      const Vec3 velocity = body_from_ned * truth.velocity_ned_mps;
      filter_.correct_velocity((1.0 + scale_) * velocity + kLogSigma_mps * noise(n, 3), Vec3::Zero(), sigma_mps);
    }
    if (aids.water) {
      const Vec3 velocity = body_from_ned * (truth.velocity_ned_mps - current_ned_mps_);
      filter_.correct_water_velocity((1.0 + scale_) * velocity + kLogSigma_mps * noise(n, 8), Vec3::Zero(), sigma_mps);
    }
    if (aids.usbl && n % 10 == 0) find(n);
    if (grade_.compass.white_rad > 0.0) read_compass(n);
    filter_.correct_height(truth.height_m + kDepthSigma_m * noise_.normal(n, 6), Vec3::Zero(), kDepthSigma_m);
  }

  /// Normalised squared error of position, velocity, rotation: chi-square of nine degrees of freedom.
  double nees(std::size_t n) const {
    const NavigationState &truth = mission_.truth[n], &state = filter_.state();
    const Eigen::AngleAxisd turn(frames::canonical(truth.ned_from_body * state.ned_from_body.conjugate()));
    Eigen::Matrix<double, 9, 1> error;
    error << apart_ned_m(truth, state), truth.velocity_ned_mps - state.velocity_ned_mps, turn.angle() * turn.axis();
    const Eigen::Matrix<double, 9, 9> p = filter_.covariance().topLeftCorner<9, 9>();
    return error.dot(p.ldlt().solve(error));
  }

  /// The same of the current: two degrees of freedom.
  double current_nees() const {
    const Eigen::Vector2d error = (current_ned_mps_ - filter_.current_ned_mps()).head<2>();
    const Eigen::Matrix2d p = filter_.covariance().block<2, 2>(kCurrent, kCurrent);
    return error.dot(p.ldlt().solve(error));
  }

  const NavigationFilter& filter() const { return filter_; }
  double off_m(std::size_t n) const { return apart_ned_m(mission_.truth[n], filter_.state()).head<2>().norm(); }

 private:
  Vec3 noise(std::uint64_t n, std::uint64_t lane) const {
    return {noise_.normal(n, lane), noise_.normal(n, lane + 1), noise_.normal(n, lane + 2)};
  }
  NavigationState start(const NavigationState& truth, const StartErrors& sigma) const {
    const Vec3 place(sigma.position_m, sigma.position_m, sigma.height_m);
    NavigationState state = moved(truth, -place.cwiseProduct(noise(0, 10)));
    state.velocity_ned_mps -= sigma.velocity_mps * noise(0, 20);
    const Vec3 turn = Vec3(sigma.tilt_rad, sigma.tilt_rad, sigma.heading_rad).cwiseProduct(noise(0, 30));
    state.ned_from_body = Eigen::AngleAxisd(turn.norm(), -turn.normalized()) * truth.ned_from_body;
    return state;
  }

  static NavigationFilter::Fix fix_at(const NavigationState& place, double sigma_m) {
    return {place.latitude_rad, place.longitude_rad, place.height_m, Vec3::Zero(), Vec3::Constant(sigma_m)};
  }
  /// The ship reports where she found the vehicle.
  void find(std::size_t n) {
    for (std::uint64_t axis = 0; axis < 3; ++axis) carrier_[axis].advance(2.0, carrier_stream_, n, axis);
    const Vec3 error =
        kUsblWhite_m * noise(n, 11) + Vec3(carrier_[0].value(), carrier_[1].value(), carrier_[2].value());
    NavigationFilter::Fix fix = fix_at(moved(mission_.truth[n - kUsblAge], error), kUsblWhite_m);
    fix.wanders = false;
    fix.carrier_sigma_ned_m.setConstant(kCarrier_m);
    filter_.correct_position(fix, kUsblAge * kStep_s);
  }

  void read_compass(std::size_t n) {
    const Vec3 forward = mission_.truth[n].ned_from_body * Vec3::UnitX();
    const double h = std::atan2(forward.y(), forward.x()), white_rad = grade_.compass.white_rad;
    compass_wander_.advance(1.0, compass_stream_, n, 0);
    const auto& [a, b, c, d, e] = deviation_rad_;
    const double deviation_rad = a + b * std::sin(h) + c * std::cos(h) + d * std::sin(2.0 * h) + e * std::cos(2.0 * h);
    const double error_rad = deviation_rad + compass_wander_.value() + white_rad * noise_.normal(n, 7);
    filter_.correct_heading(h + error_rad, Vec3::UnitX(), white_rad);
  }

  const Mission& mission_;
  random::Stream noise_, wander_stream_, current_stream_, carrier_stream_, compass_stream_;
  inertial::Imu imu_;
  NavigationFilter filter_;
  const Grade& grade_;
  double scale_;
  std::array<random::GaussMarkov, 3> wander_, carrier_;
  random::GaussMarkov compass_wander_;
  std::array<double, 5> deviation_rad_{};
  Vec3 current_ned_mps_ = Vec3::Zero();
};

}  // namespace ensonify::navigation_filter::test_run
