#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "components/navigation/instrument_config.h"
#include "components/runtime/ports.h"
#include "components/runtime/sim_time.h"
#include "kernels/base/frames/attitude.h"
#include "kernels/base/frames/local_projection.h"
#include "kernels/base/random/stream.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify {

/// An inertial measurement unit and the filter around it. How the system was aligned before the run is not simulated:
/// it starts at the truth less errors drawn with the grade's `alignment`.
///
/// The unit senses what takes the true state of one event to that of the next; the filter sees its readings alone.
class Estimator {
 public:
  using Filter = navigation_filter::NavigationFilter;

  Estimator(const Instruments& carried, std::uint64_t seed, const std::string& process);

  /// On to the next true pose. Empty at the first, and when time has not passed.
  std::optional<msg::InertialIncrements> advance(const msg::Pose& truth, const frames::LocalProjection& world);

  /// Corrects with what an instrument stamped; a stamp in the future waits until the filter is there.
  void correct(double stamped_s, std::function<void(Filter&)> correction);

  bool ready() const { return filter_.has_value(); }
  double time_s() const { return seconds(SimTime{stamp_ns_}); }  // of the estimate
  /// Estimate of the body's origin, by the measured mounting of the unit. Only when ready.
  msg::Estimate estimate(const frames::LocalProjection& world) const;

  /// A place of the body as seen from the unit, its axes; and turns from the body's axes to its.
  frames::Vec3 lever_of(const frames::Vec3& point_body_m) const;
  frames::Vec3 along_unit(const frames::Vec3& vector_body) const;

 private:
  void align(const inertial::NavigationState& truth);

  ImuConfig config_;
  navigation_filter::FilterModel model_;
  inertial::Imu imu_;
  random::Stream alignment_;
  std::optional<inertial::NavigationState> truth_;  // of the unit, at `stamp_ns_`
  std::int64_t stamp_ns_ = 0;
  std::optional<Filter> filter_;
  struct Waiting {
    double stamped_s;
    std::function<void(Filter&)> correction;
  };
  std::vector<Waiting> waiting_;
};

/// Position between and through fixes: measured velocity is summed up (trapezoids), each fix pulls the sum towards
/// itself by a fixed gain. This is the steady state of a Kalman filter with white errors in velocity and fix, without
/// its covariance. In steady state a fix's white noise of sigma s leaves s sqrt(gain / (2 - gain)).
class DeadReckoning {
 public:
  explicit DeadReckoning(double gain) : gain_(gain) {}

  /// Times must not fall.
  void predict(SimTime t, const frames::Vec3& velocity_enu_mps);
  /// A fix at the time of the last prediction. The first n fixes are averaged until the gain is below 1 / n.
  void correct(const frames::Vec3& fix_enu_m);

  /// False before the first fix.
  bool ready() const { return fixes_ > 0; }
  const frames::Vec3& position_enu_m() const { return position_enu_m_; }
  const frames::Vec3& velocity_enu_mps() const { return velocity_enu_mps_; }

 private:
  double gain_;
  SimTime t_{0};
  bool moving_ = false;  // a velocity has been given
  int fixes_ = 0;
  frames::Vec3 position_enu_m_ = frames::Vec3::Zero();
  frames::Vec3 velocity_enu_mps_ = frames::Vec3::Zero();
};

/// Estimates that are older than their stamps say, as from a system whose outputs take their time to whoever stamps
/// them: east and north by `position`, the rest (height, attitude, velocity) by `motion`. Between estimates they are
/// interpolated; before the first has the age, the first is given. Covariances are those of the stamp.
class OutputAge {
 public:
  OutputAge(SimTime position, SimTime motion) : position_(position), motion_(motion) {}

  msg::Estimate aged(const msg::Estimate& now);

 private:
  msg::Estimate at(std::int64_t t_ns) const;

  SimTime position_, motion_;
  std::deque<msg::Estimate> past_;  // the newest that is old enough for both, and all after it
};

/// Fixes of this vehicle's transponder by another's array, as they come over telemetry: late, and with all that the
/// other vehicle errs by.
class UsblFixes {
 public:
  UsblFixes(const UsblFixesConfig& config, Ports& ports);

  /// Corrects with what has come since the last time.
  void correct(Estimator& estimator, const frames::LocalProjection& world);

 private:
  Estimator::Filter::Fix fix_of(const msg::UsblFix& found, const Estimator& estimator,
                                const frames::LocalProjection& world) const;

  UsblFixesConfig config_;
  std::vector<msg::UsblFix> come_;
};

}  // namespace ensonify
