#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "components/navigation/config.h"
#include "components/navigation/mounted_instrument.h"
#include "components/navigation/water_instruments.h"
#include "components/runtime/ports.h"
#include "messages/navigation.h"

namespace ensonify {

/// The instruments beside the motion sensor and the inertial unit: GNSS, compass, Doppler log, depth, altimeter, and
/// those that measure the water. Each measures at its own rate, corrects the filter (when there is one) and publishes
/// after its latency.
class Suite {
 public:
  /// Sinks of readings whose ports belong to the node.
  struct To {
    std::function<void(const msg::Position&)> positions;
    std::function<void(const msg::SoundSpeed&)> sound_speeds;
  };

  Suite(const NavigationConfig& config, Ports& ports, const To& to);

  SimTime next() const;

  /// Measures what is due, if the truth and the world's place are known. By what is `estimated` the
  /// antenna's place is brought to the body's origin, and a transponder's into the world.
  void step(SimTime now, const std::optional<msg::Pose>& truth, const std::optional<frames::LocalProjection>& world,
            const EstimatedPose& estimated, std::optional<Estimator>& estimator);

  /// The newest heading that the compass has sent by now, clockwise from true north.
  std::optional<double> heading_rad(SimTime now);
  void send_due(SimTime now) { outbox_.send_due(now); }

 private:
  void measure_fix(const Moment& moment);
  void measure_heading(const Moment& moment);
  void measure_velocity(const Moment& moment, std::uint64_t n);
  void track_water(const Moment& moment, const frames::HeadPose& head, std::uint64_t n,
                   msg::VelocityLog& message) const;
  /// Corrects the filter with how a reading moves the transducer, by one of its corrections.
  using CorrectVelocity = navigation_filter::Innovation (Estimator::Filter::*)(const frames::Vec3&, const frames::Vec3&,
                                                                               const frames::Vec3&);
  void report_velocity(const Moment& moment, const sensors::DopplerReading& reading, CorrectVelocity correct) const;
  void measure_depth(const Moment& moment);
  void measure_altitude(const Moment& moment);

  Heights heights_;
  SeabedBelow seabed_;
  Outbox outbox_;
  std::function<void(const msg::Position&)> positions_;
  std::deque<std::pair<SimTime, double>> headings_;  // and when each comes: the newest that has, and all after it
  std::optional<MountedInstrument<GnssConfig, sensors::Gnss>> gnss_;
  std::optional<MountedInstrument<HeadingConfig, sensors::HeadingSensor>> heading_;
  std::optional<MountedInstrument<DopplerLogConfig, sensors::DopplerLog>> log_;
  std::optional<MountedInstrument<DepthConfig, sensors::ScalarSensor>> depth_;
  std::optional<MountedInstrument<AltimeterConfig, sensors::RangeSensor>> altimeter_;
  std::optional<Ports::Out<msg::Heading>> headings_out_;
  std::optional<Ports::Out<msg::VelocityLog>> velocities_out_;
  std::optional<Ports::Out<msg::Depth>> depths_out_;
  std::optional<Ports::Out<msg::Altitude>> altitudes_out_;
  WaterInstruments water_;
};

/// An array under this vehicle that finds the transponder of another one.
class UsblTracker {
 public:
  UsblTracker(const UsblConfig& config, std::uint64_t seed, const std::string& process, Ports& ports);

  SimTime next() const { return array_.due.next(); }
  /// Asks when it is due; without a moment time passes and nothing is asked.
  void step(SimTime now, const Moment* moment, Outbox& outbox);

  /// Reason that the last interrogation had no answer; empty when it had one.
  const std::string& silence() const { return silence_; }

 private:
  /// Place of the transponder when it sent the reply received now; empty while the target is not known.
  std::optional<frames::Vec3> answered_enu_m(const Moment& moment, const frames::Vec3& array_enu_m) const;
  std::string why_silent(const frames::Vec3& place_array_m) const;

  MountedInstrument<UsblConfig, random::Stream> array_;
  frames::PoseHistory target_;
  std::string silence_;
  Ports::Out<msg::UsblFix> fixes_out_;
};

}  // namespace ensonify
