#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "components/formats/ais/position_report.h"
#include "components/formats/km_binary/km_binary.h"
#include "components/formats/nmea/navigation.h"
#include "components/nav_out/accelerating.h"
#include "components/nav_out/output.h"
#include "components/nav_out/turning.h"
#include "kernels/base/frames/local_projection.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify::nav_out {

/// A vessel's place and motion, as it knows them itself.
struct Motion {
  std::int64_t stamp_ns = 0;
  frames::Vec3 position_enu_m = frames::Vec3::Zero();
  frames::Quaternion enu_from_body = frames::enu_from_ned();
  frames::Vec3 velocity_enu_mps = frames::Vec3::Zero();
};
Motion motion_of(const msg::Estimate& estimate);
Motion motion_of(const msg::Pose& pose);

/// UTC, and the map: grid and true north.
struct Earth {
  std::int64_t start_unix_ns = 0;
  std::optional<frames::LocalProjection> world;  // from when its origin is known on

  std::int64_t unix_ns(std::int64_t stamp_ns) const { return start_unix_ns + stamp_ns; }
  /// Seconds of the UTC day.
  double time_s(std::int64_t stamp_ns) const;
  nmea::DateAndTime date_and_time(std::int64_t stamp_ns) const;
  nmea::Course course_of(const Motion& motion) const;
  double heading_of(const Motion& motion) const;
};

/// What AIS says of a vessel.
formats::ais::PositionReport report_of(const Motion& motion, const Turning& turning, const Earth& earth,
                                       std::uint32_t mmsi);

/// The newest measurement of each of the vehicle's instruments, and the sentences of them.
class Instruments {
 public:
  Instruments(std::int64_t start_unix_ns, std::uint32_t mmsi) : mmsi_(mmsi) { earth_.start_unix_ns = start_unix_ns; }

  void set_origin(const frames::Geodetic& origin) { earth_.world.emplace(origin); }
  void take(const msg::Position& position) { position_ = position; }
  void take(const msg::Attitude& attitude);
  void take(const msg::Heading& heading);
  void take(const msg::Altitude& altitude) { altitude_ = altitude; }
  void take(const msg::Estimate& estimate);
  /// Headings come as messages of their own: those of attitude turn nothing.
  void carry_compass() { compass_ = true; }

  /// A sentence or frame of the newest measurement; "": there is none, or grid north cannot be told from true north
  /// yet.
  std::string say(Kind kind, const Output& output) const;

  const Earth& earth() const { return earth_; }

 private:
  bool ready() const { return earth_.world && estimate_; }
  formats::Motion motion() const;
  /// Not to be used where the estimate says that it is worse than an instrument would give out.
  nmea::MotionQuality quality() const;
  formats::km_binary::Sample km_sample() const;
  std::string motion_sentence(Kind kind) const;

  std::uint32_t mmsi_;
  Earth earth_;
  std::optional<msg::Position> position_;
  std::optional<msg::Attitude> attitude_;
  std::optional<double> heading_rad_;  // from true north
  std::optional<msg::Altitude> altitude_;
  std::optional<msg::Estimate> estimate_, estimate_before_;
  Turning turning_;
  Accelerating accelerating_;
  bool compass_ = false;
};

}  // namespace ensonify::nav_out
