#pragma once

#include <Eigen/Core>
#include <array>
#include <deque>
#include <optional>

#include "kernels/instruments/inertial/imu.h"
#include "kernels/instruments/inertial/strapdown.h"

/// Navigation filter of a vehicle's instruments: an inertial system corrected by whatever else has something to say.
namespace ensonify::navigation_filter {

using frames::Vec3;
using inertial::NavigationState;

/// Places of the errors in covariances. Each is truth less estimate; rotations are small angles about north, east,
/// down.
enum ErrorIndex : int {
  kPosition = 0,           // m, north, east, down
  kVelocity = 3,           // m/s, north, east, down
  kRotation = 6,           // rad: true = exp(rotation) estimated attitude
  kGyroBias = 9,           // rad/s, body
  kForceBias = 12,         // m/s^2, body
  kFixError = 15,          // m, north, east, down: the slowly changing error of position fixes
  kLogScale = 18,          // 1, scale error of the velocity log
  kGyroMatrix = 19,        // 1, scale (diagonal) and crosstalk of the gyros, row by row
  kForceMatrix = 28,       // 1, the same of the accelerometers
  kCurrent = 37,           // m/s, north, east, of the water that the velocity log tracks
  kCarrier = 39,           // 1, north, east, down: slow errors of who finds the vehicle, over their standard deviations
  kLevel = 42,             // m, up: the slowly changing error of heights by pressure
  kCompassWander = 43,     // rad, the slowly changing error of headings
  kCompassDeviation = 44,  // rad: A, B, C, D, E of what stays of it at every heading
  kErrorCount = 49,
};
using Covariance = Eigen::Matrix<double, kErrorCount, kErrorCount>;

/// Filter's model of its sensors: standard deviations, as in the sensors' own error models.
struct FilterModel {
  inertial::ImuErrors imu;
  double fix_wander_horizontal_m = 0.0;  // Gauss-Markov errors of position fixes, each axis
  double fix_wander_vertical_m = 0.0;
  double fix_wander_s = 300.0;  // their correlation time, > 0
  double log_scale = 0.0;       // of the velocity log
  double level_wander_m =
      0.0;  // Gauss-Markov error of heights by pressure: the sensor's, and of the level it counts from
  double level_wander_s = 3600.0;   // its correlation time, > 0
  double compass_wander_rad = 0.0;  // Gauss-Markov error of headings
  double compass_wander_s = 300.0;  // its correlation time, > 0
  // What stays of it at heading h: A + B sin h + C cos h + D sin 2h + E cos 2h, the standard deviation of each.
  std::array<double, 5> compass_deviation_rad{};
  // The current at the water that the log tracks, north and east each: how much of it there may be at the start, and
  // how fast it changes at random, with time and with each metre that the vehicle rises or sinks. The water does not
  // rise.
  double current_mps = 0.0;
  double current_walk_mps_per_sqrt_s = 0.0;
  double current_walk_mps_per_sqrt_m = 0.0;
  double carrier_s = 300.0;   // correlation time of the slow errors of who finds the vehicle, > 0
  double remembered_s = 0.0;  // fixes as old as this can be used
};

/// Errors of the first state: standard deviations, each axis.
struct StartErrors {
  double position_m = 10.0;
  double height_m = 10.0;
  double velocity_mps = 0.5;
  double tilt_rad = 0.01;
  double heading_rad = 0.05;
};

/// Result of a correction. The normalised innovation squared is distributed as chi-square of as many degrees of
/// freedom as there were numbers, if the filter and the sensor are as they say.
struct Innovation {
  double normalised_squared = 0.0;
  bool accepted = true;
};

/// Error-state Kalman filter around a strapdown inertial system [Groves2013, chs 3, 14; Sola2017]. The state is the
/// inertial system's own; the filter keeps the covariance of 49 errors of it, of the sensors and of the water, and adds
/// the estimated errors to the state at once, so that they are zero between corrections.
///
/// Biases are assumed to walk at random as fast as the sensors' Gauss-Markov biases start to, which is right for times
/// below their correlation time and careful beyond. Outliers beyond `gate` standard deviations are refused. Latitudes
/// as for NavigationState.
class NavigationFilter {
 public:
  NavigationFilter(const NavigationState& start, const StartErrors& errors, const FilterModel& model,
                   const inertial::Earth& earth = {});

  /// The state dt later, from the mean readings of an inertial measurement unit at the body's origin. The covariance
  /// follows at least every 0.1 s, and before each correction.
  void propagate(const inertial::Inertial& measured, double dt_s);

  struct Fix {
    double latitude_rad = 0.0;
    double longitude_rad = 0.0;
    double height_m = 0.0;
    Vec3 lever_body_m = Vec3::Zero();  // of the antenna or transponder, from the body's origin
    Vec3 sigma_ned_m = Vec3::Ones();   // white noise
    bool wanders = true;               // has the model's Gauss-Markov errors of fixes
    // Standard deviations of what the place of who found the vehicle, its attitude and its array err by slowly.
    Vec3 carrier_sigma_ned_m = Vec3::Zero();
  };
  /// Place of the vehicle `age_s` ago (>= 0). The fix is compared with the remembered estimate of that time, as all
  /// later corrections have moved it; errors of position are taken back by those of velocity. What is left out is age^2
  /// / 2 of the errors of acceleration: 4 cm for 0.1 degrees of tilt and 2 s. Older than is remembered: refused.
  Innovation correct_position(const Fix& fix, double age_s = 0.0);

  /// Velocity of the point `lever` over ground, along body axes, by a Doppler log or another whose scale is in doubt.
  Innovation correct_velocity(const Vec3& velocity_body_mps, const Vec3& lever_body_m, const Vec3& sigma_body_mps);

  /// The same through water that drifts with the current of the model.
  Innovation correct_water_velocity(const Vec3& velocity_body_mps, const Vec3& lever_body_m,
                                    const Vec3& sigma_body_mps);

  /// Height of the point `lever` above the ellipsoid, of a pressure sensor once its level is known.
  Innovation correct_height(double height_m, const Vec3& lever_body_m, double sigma_m);

  /// True heading of an axis of the body, by a compass along it; refused when the axis points nearly up or down.
  Innovation correct_heading(double heading_rad, const Vec3& axis_body, double sigma_rad);

  const NavigationState& state() const { return state_; }
  const Covariance& covariance() const { return covariance_; }
  /// Turn rate of the body against the turning Earth, along its axes, now: readings are means of intervals, so it is
  /// the last one, corrected, and half of what it grew by since the one before.
  Vec3 turn_rate_radps() const;
  /// Errors of place and velocity of another point of the body, north, east, down: its place hangs on the attitude,
  /// its velocity on the turn rate as well.
  struct PointCovariance {
    Eigen::Matrix3d position_m2, velocity_m2ps2;
  };
  PointCovariance covariance_at(const Vec3& lever_body_m) const;
  Vec3 fix_error_ned_m() const { return fix_error_; }
  double log_scale() const { return log_scale_; }
  Vec3 current_ned_mps() const { return current_ned_; }  // of the tracked water; down is zero
  /// Deviation of the compass at a heading.
  double compass_error_rad(double heading_rad) const;

  double gate = 6.0;

 private:
  template <int N>
  using Observation = Eigen::Matrix<double, N, kErrorCount>;
  template <int N>
  Innovation correct(const Eigen::Matrix<double, N, 1>& residual, const Observation<N>& observation,
                     const Eigen::Matrix<double, N, 1>& sigma);
  enum class Tracked { kBottom, kWater };
  Innovation correct_log(Tracked tracked, const Vec3& velocity_body_mps, const Vec3& lever_body_m,
                         const Vec3& sigma_body_mps);
  void add(const Eigen::Matrix<double, kErrorCount, 1>& errors);
  void remember();
  /// The estimate as it was, interpolated; empty when it is forgotten.
  std::optional<NavigationState> recall(double age_s) const;
  void propagate_covariance();
  Covariance error_rates(const Vec3& force_ned, const Vec3& rate_body_radps) const;

  inertial::Earth earth_;
  FilterModel model_;
  NavigationState state_;
  Covariance covariance_ = Covariance::Zero();
  Vec3 gyro_bias_ = Vec3::Zero(), force_bias_ = Vec3::Zero(), fix_error_ = Vec3::Zero();
  Vec3 current_ned_ = Vec3::Zero(), carrier_error_ = Vec3::Zero();
  double log_scale_ = 0.0, level_error_m_ = 0.0, compass_wander_rad_ = 0.0;
  Eigen::Matrix<double, 5, 1> compass_deviation_rad_ = Eigen::Matrix<double, 5, 1>::Zero();
  Eigen::Matrix3d gyro_matrix_ = Eigen::Matrix3d::Zero(), force_matrix_ = Eigen::Matrix3d::Zero();
  Vec3 rate_radps_ = Vec3::Zero();            // of the body against inertial space, mean of the last interval
  Vec3 rate_growth_radps_ = Vec3::Zero();     // of that rate, from the middle of the last interval to its end
  double interval_s_ = 0.0;                   // the last one
  Vec3 pending_velocity_ned_ = Vec3::Zero();  // of specific force, since the covariance was last propagated
  Vec3 pending_turn_rad_ = Vec3::Zero();      // the angle turned since then, along body axes
  double pending_s_ = 0.0;
  struct Past {
    double t_s;
    NavigationState state;
  };
  std::deque<Past> past_;  // one estimate that is as old as is remembered, and later ones
  double t_s_ = 0.0;       // since the start
};

}  // namespace ensonify::navigation_filter
