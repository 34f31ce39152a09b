#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "components/navigation/instrument_config.h"
#include "components/runtime/sim_time.h"
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

}  // namespace ensonify
