#pragma once

#include <functional>
#include <map>
#include <optional>

#include "components/navigation/estimator.h"
#include "components/navigation/heights.h"
#include "components/navigation/instrument_config.h"
#include "components/runtime/head/tile_set.h"
#include "components/runtime/ports.h"

namespace ensonify {

/// Messages that leave later than what they tell of was measured, in order of their times.
class Outbox {
 public:
  void at(SimTime t, std::function<void()> send) { waiting_.emplace(t, std::move(send)); }
  void send_due(SimTime now) {
    for (; !waiting_.empty() && waiting_.begin()->first <= now; waiting_.erase(waiting_.begin())) {
      waiting_.begin()->second();
    }
  }
  SimTime next() const { return waiting_.empty() ? kNever : waiting_.begin()->first; }

 private:
  std::multimap<SimTime, std::function<void()>> waiting_;  // equal times keep their order
};

/// The instruments beside the motion sensor and the inertial unit: GNSS, compass, Doppler log, depth, altimeter. Each
/// measures at its own rate, tells the filter (when there is one) and publishes after its latency.
class Suite {
 public:
  /// `positions` is where fixes go: their port belongs to the node.
  Suite(const Instruments& carried, const Heights& heights, std::uint64_t seed, const std::string& process,
        Ports& ports, std::function<void(const msg::Position&)> positions);

  SimTime next() const;

  /// Measures what is due, if the truth and the world's place are known. `believed` is the attitude by which the
  /// antenna's place is brought to the body's origin.
  void step(SimTime now, const std::optional<msg::Pose>& truth, const std::optional<frames::LocalProjection>& world,
            const frames::Quaternion& believed_enu_from_body, std::optional<Estimator>& estimator);

  /// The newest heading, clockwise from true north.
  std::optional<double> heading_rad() const { return heading_rad_; }
  void send_due(SimTime now) { outbox_.send_due(now); }

 private:
  struct Moment;
  template <class Config, class Sensor>
  struct Carried {
    Carried(const Config& of, Sensor made) : config(of), sensor(std::move(made)), due(rate_of(of.instrument.rate_hz)) {}

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

  void measure_fix(const Moment& moment);
  void measure_heading(const Moment& moment);
  void measure_velocity(const Moment& moment, std::uint64_t n);
  void measure_depth(const Moment& moment);
  void measure_altitude(const Moment& moment);
  std::optional<double> distance_m(const frames::HeadPose& from, const frames::Vec3& direction, double longest_m) const;
  template <class Message>
  void publish(std::optional<Ports::Out<Message>>& out, Message message, const Instrument& instrument,
               const Moment& moment);

  Heights heights_;
  TileSet seabed_;
  Outbox outbox_;
  std::function<void(const msg::Position&)> positions_;
  std::optional<double> heading_rad_;
  std::optional<Carried<GnssConfig, sensors::Gnss>> gnss_;
  std::optional<Carried<HeadingConfig, sensors::HeadingSensor>> heading_;
  std::optional<Carried<DopplerLogConfig, sensors::DopplerLog>> log_;
  std::optional<Carried<DepthConfig, sensors::ScalarSensor>> depth_;
  std::optional<Carried<AltimeterConfig, sensors::RangeSensor>> altimeter_;
  std::optional<Ports::Out<msg::Heading>> headings_out_;
  std::optional<Ports::Out<msg::VelocityLog>> velocities_out_;
  std::optional<Ports::Out<msg::Depth>> depths_out_;
  std::optional<Ports::Out<msg::Altitude>> altitudes_out_;
};

}  // namespace ensonify
