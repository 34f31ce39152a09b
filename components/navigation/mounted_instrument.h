#pragma once

#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "components/navigation/estimator.h"
#include "components/navigation/instrument_config.h"
#include "components/navigation/world_frame.h"
#include "components/runtime/ports.h"
#include "components/runtime/sim_time.h"

namespace ensonify {

/// Estimated pose of the vehicle.
struct EstimatedPose {
  frames::Quaternion enu_from_body = frames::enu_from_ned();
  std::optional<frames::Vec3> position_enu_m;  // of the body's origin; not before the first estimate
};

/// Truth at one event, and who wants to know of it.
struct Moment {
  SimTime now;
  double t_s;  // of the truth
  frames::MovingPose truth;
  const frames::LocalProjection& world;
  const EstimatedPose& estimated;
  Estimator* estimator;  // may be null

  inertial::NavigationState at(const frames::Mounting& mounting) const {
    return geodetic_state(truth, mounting, world);
  }
  frames::Vec3 velocity_enu_mps(const frames::Vec3& point_body_m) const {
    return truth.velocity_enu_mps + truth.pose.enu_from_body * truth.angular_rate_body_radps.cross(point_body_m);
  }
  double stamp_s(const Instrument& i) const { return i.clock.stamp_s(t_s, i.latency_s, i.stamping); }
};

/// Messages that leave later than what they describe was measured, in order of their times.
class Outbox {
 public:
  void at(SimTime t, std::function<void()> send) { waiting_.emplace(t, std::move(send)); }

  /// After the instrument's latency, with the stamp that its clock gives to the true time with which the message comes:
  /// that of what it indicates. `out` outlives this.
  template <class Message>
  void publish(Ports::Out<Message>& out, Message message, const Instrument& instrument, SimTime now) {
    const double t_s = seconds(SimTime{message.stamp_ns});
    message.stamp_ns = from_seconds(instrument.clock.stamp_s(t_s, instrument.latency_s, instrument.stamping)).count();
    at(now + from_seconds(instrument.latency_s), [&out, message] { out.send(message); });
  }
  template <class Message>
  void publish(Ports::Out<Message>& out, Message message, const Instrument& instrument, const Moment& moment) {
    message.stamp_ns = from_seconds(moment.t_s).count();
    publish(out, message, instrument, moment.now);
  }

  void send_due(SimTime now) {
    for (; !waiting_.empty() && waiting_.begin()->first <= now; waiting_.erase(waiting_.begin())) {
      waiting_.begin()->second();
    }
  }
  SimTime next() const { return waiting_.empty() ? kNever : waiting_.begin()->first; }

 private:
  std::multimap<SimTime, std::function<void()>> waiting_;  // equal times keep their order
};

/// An instrument, its model and its pace.
template <class Config, class Sensor>
struct MountedInstrument {
  MountedInstrument(const Config& of, Sensor made)
      : config(of), sensor(std::move(made)), due(rate_of(of.instrument.rate_hz)) {}

  Config config;
  Sensor sensor;
  Periodic due;
  std::optional<double> last_s;  // true time of the sample before

  double since(double t_s) {
    const double dt_s = last_s ? t_s - *last_s : 0.0;
    last_s = t_s;
    return dt_s;
  }
};

}  // namespace ensonify
