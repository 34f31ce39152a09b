#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/navigation_filter/error_state.h"

using namespace ensonify;
using namespace ensonify::navigation_filter;
using inertial::Earth;
using inertial::Inertial;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kDegreePerHour = kDegree / 3600.0;
constexpr double kUg = 9.80665e-6;  // m/s^2
constexpr double kStep_s = 0.2;     // of the IMU; its noise is right at any rate
const Earth kEarth;

/// The grades of components/navigation/grades.
struct Grade {
  inertial::ImuErrors imu;
  double heading_rad;          // at the start, from alignment or a compass
  double compass_rad = 0.0;    // white noise of a compass that is read each second; 0: there is none
  double deviation_rad = 0.0;  // standard deviation of what is left of its deviation, unknown to the filter
};
const Grade kRlg{{{5e-6, 2e-5, 0.003 * kDegreePerHour, 0.001 * kDegreePerHour, 3600, 0.001 * kDegree / 60},
                  {5e-5, 2e-5, 20 * kUg, 5 * kUg, 3600, 5 * kUg}},
                 0.0003};
const Grade kFog{{{3e-5, 5e-5, 0.02 * kDegreePerHour, 0.005 * kDegreePerHour, 3600, 0.005 * kDegree / 60},
                  {1e-4, 5e-5, 50 * kUg, 10 * kUg, 3600, 10 * kUg}},
                 0.002};
const Grade kTactical{{{3e-4, 3e-4, 1.0 * kDegreePerHour, 0.3 * kDegreePerHour, 1000, 0.1 * kDegree / 60},
                       {3e-4, 3e-4, 1000 * kUg, 100 * kUg, 1000, 50 * kUg}},
                      0.01};
const Grade kMems{{{1e-3, 1e-3, 100 * kDegreePerHour, 8 * kDegreePerHour, 500, 0.3 * kDegree / 60},
                   {1e-3, 1e-3, 5000 * kUg, 50 * kUg, 500, 100 * kUg}},
                  0.03,
                  0.02,
                  0.5 * kDegree};

constexpr double kLogScale = 0.002, kLogSigma_mps = 0.01, kDepthSigma_m = 0.05;

NavigationState moved(const NavigationState& from, const Vec3& by_ned_m) {
  NavigationState to = from;
  to.latitude_rad += by_ned_m.x() / (meridian_radius_m(kEarth, from.latitude_rad) + from.height_m);
  to.longitude_rad += by_ned_m.y() / ((prime_vertical_radius_m(kEarth, from.latitude_rad) + from.height_m) *
                                      std::cos(from.latitude_rad));
  to.height_m -= by_ned_m.z();
  return to;
}

Vec3 apart_ned_m(const NavigationState& to, const NavigationState& from) {
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
Mission mission(double duration_s, double line_s, double speed_mps) {
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

FilterModel model_of(const Grade& grade) {
  FilterModel model;
  model.imu = grade.imu;
  model.fix_wander_horizontal_m = 0.3;
  model.fix_wander_vertical_m = 0.6;
  model.fix_wander_s = 200.0;
  model.log_scale = kLogScale;
  return model;
}

const StartErrors kStart{1.0, 1.0, 0.1, 0.001, 0.0};

/// One vehicle with its own errors, from random streams of `seed`.
class Run {
 public:
  Run(const Mission& m, const Grade& grade, std::uint64_t seed)
      : mission_(m),
        noise_(seed, "noise"),
        wander_stream_(seed, "wander"),
        imu_(grade.imu, {seed, "gyro"}, {seed, "accelerometer"}),
        filter_(start(m.truth[0], grade), errors(grade), model_of(grade)),
        grade_(grade),
        scale_(kLogScale * noise_.normal(0, 99)) {
    const FilterModel model = model_of(grade);
    for (std::uint64_t axis = 0; axis < 3; ++axis) {
      wander_[axis] = random::GaussMarkov(axis < 2 ? model.fix_wander_horizontal_m : model.fix_wander_vertical_m,
                                          model.fix_wander_s, wander_stream_, axis);
    }
  }

  /// To sample n: fixes each second while `fixes`, log and depth each second always.
  void step(std::size_t n, bool fixes) {
    filter_.propagate(imu_.measure(mission_.readings[n - 1], kStep_s), kStep_s);
    if (n % 5 != 0) return;
    const NavigationState& truth = mission_.truth[n];
    for (std::uint64_t axis = 0; axis < 3; ++axis) wander_[axis].advance(1.0, wander_stream_, n, axis);
    if (fixes) {
      const Vec3 error = 0.02 * noise(n, 0) + Vec3(wander_[0].value(), wander_[1].value(), wander_[2].value());
      const NavigationState fix = moved(truth, error);
      filter_.correct_position({fix.latitude_rad, fix.longitude_rad, fix.height_m, Vec3::Zero(), Vec3::Constant(0.02)});
    }
    const Vec3 velocity = truth.ned_from_body.conjugate() * truth.velocity_ned_mps;
    filter_.correct_velocity((1.0 + scale_) * velocity + kLogSigma_mps * noise(n, 3), Vec3::Zero(),
                             Vec3::Constant(kLogSigma_mps));
    if (grade_.compass_rad > 0.0) {
      const Vec3 forward = truth.ned_from_body * Vec3::UnitX();
      const double error = grade_.compass_rad * noise_.normal(n, 7) + grade_.deviation_rad * noise_.normal(0, 98);
      filter_.correct_heading(std::atan2(forward.y(), forward.x()) + error, grade_.compass_rad);
    }
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

  double off_m(std::size_t n) const { return apart_ned_m(mission_.truth[n], filter_.state()).head<2>().norm(); }

 private:
  static StartErrors errors(const Grade& grade) {
    StartErrors e = kStart;
    e.heading_rad = grade.heading_rad;
    return e;
  }
  Vec3 noise(std::uint64_t n, std::uint64_t lane) const {
    return {noise_.normal(n, lane), noise_.normal(n, lane + 1), noise_.normal(n, lane + 2)};
  }
  NavigationState start(const NavigationState& truth, const Grade& grade) const {
    NavigationState state = moved(truth, -noise(0, 10) * kStart.position_m);
    state.velocity_ned_mps -= kStart.velocity_mps * noise(0, 20);
    const Vec3 z = noise(0, 30);
    const Vec3 turn(kStart.tilt_rad * z.x(), kStart.tilt_rad * z.y(), grade.heading_rad * z.z());
    state.ned_from_body = Eigen::AngleAxisd(turn.norm(), -turn.normalized()) * truth.ned_from_body;
    return state;
  }

  const Mission& mission_;
  random::Stream noise_, wander_stream_;
  inertial::Imu imu_;
  NavigationFilter filter_;
  const Grade& grade_;
  double scale_;
  std::array<random::GaussMarkov, 3> wander_;
};

}  // namespace

TEST_CASE("the filter is as wrong as it says: mean NEES of 200 runs") {
  // 150 s with fixes on the surface, then 250 s without, log and depth all along; epochs each 5 s. Of 200 runs the mean
  // of nine degrees of freedom is chi-square of 1800 over 200: 95 % between 8.42 and 9.60. The epochs of a run share
  // what is drawn once (correlation 0.44), so how many of them are inside is itself a matter of luck: of 100 runs of a
  // filter that is right, 15 in 100 have fewer than 90 % inside (docs/navigation/filter.md).
  constexpr int kRuns = 200;
  const Mission m = mission(400.0, 80.0, 2.0);
  for (const Grade& grade : {kFog, kTactical}) {
    std::vector<double> mean(m.truth.size(), 0.0);
    for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
      Run run(m, grade, seed);
      for (std::size_t n = 1; n < m.truth.size(); ++n) {
        run.step(n, n * kStep_s <= 150.0);
        if (n % 25 == 0) mean[n] += run.nees(n) / kRuns;
      }
    }
    int epochs = 0, inside = 0;
    double total = 0.0;
    for (std::size_t n = 25; n < m.truth.size(); n += 25) {
      ++epochs;
      total += mean[n];
      if (mean[n] > 8.42 && mean[n] < 9.60) ++inside;
    }
    CAPTURE(inside, epochs, total / epochs);
    CHECK(inside >= 0.9 * epochs);
  }
}

TEST_CASE("aided by a Doppler log of 0.2 %, drift per distance depends on the grade") {
  // Ten runs of half an hour at 2 m/s on one course without fixes, after half a minute with them. The root mean square
  // of ten strays by about 16 %, so a grade is told from the next, not to a digit.
  const Mission m = mission(1800.0, 1e9, 2.0);
  const double distance_m = 2.0 * 1770.0;
  const auto drift = [&](const Grade& grade) {
    double squares = 0.0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Run run(m, grade, seed);
      for (std::size_t n = 1; n < m.truth.size(); ++n) run.step(n, n * kStep_s <= 30.0);
      squares += std::pow(run.off_m(m.truth.size() - 1), 2);
    }
    return 100.0 * std::sqrt(squares / 10.0) / distance_m;
  };
  const double rlg = drift(kRlg), fog = drift(kFog), tactical = drift(kTactical), mems = drift(kMems);
  CAPTURE(rlg, fog, tactical, mems);  // 0.13, 0.16, 0.57, 0.75 %
  CHECK(fog >= 0.1);
  CHECK(fog <= 0.3);
  CHECK(rlg <= fog);
  CHECK(tactical > fog);
  CHECK(mems > tactical);
  CHECK(mems < 3.0);
}
