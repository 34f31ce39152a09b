#pragma once

#include <cstdint>
#include <string>

#include "components/formats/xtf/bathymetry.h"
#include "components/formats/xtf/navigation.h"
#include "components/formats/xtf/ping.h"
#include "messages/soundings.h"

namespace ensonify::logger {

/// What the instruments know of vessel and sensor at one time.
struct XtfMoment {
  std::int64_t unix_ns = 0;
  double ship_latitude_deg = 0.0, ship_longitude_deg = 0.0;      // of the reference point
  double sensor_latitude_deg = 0.0, sensor_longitude_deg = 0.0;  // of the transducer
  double sensor_depth_m = 0.0;                                   // below the water line
  double roll_deg = 0.0, pitch_deg = 0.0, heading_deg = 0.0;     // true heading
  double heave_up_m = 0.0;
  double speed_mps = 0.0;  // over ground
};

/// Milliseconds of the clock that pings' attitude times and attitude packets share: since the run's start.
struct XtfClock {
  std::int64_t start_unix_ns = 0;
  std::uint32_t ms(std::int64_t unix_ns) const;
};

/// The head of a ping's packet. `altitude_m` of the sensor above the seabed; 0: not known.
formats::xtf::PingHeader xtf_ping_header(const XtfMoment& at, const XtfClock& clock, std::int64_t ping,
                                         double sound_speed_mps, double altitude_m);

formats::xtf::Attitude xtf_attitude(const XtfMoment& at, const XtfClock& clock);
formats::xtf::RawNavigation xtf_navigation(const XtfMoment& at);

/// A multibeam's ping, every beam: angle in the head's frame from its down axis, to port negative; travel time, 0 where
/// nothing was detected; quality 3 and 0; tilt and delay of the beam's sector.
formats::xtf::MultibeamPing xtf_multibeam(const formats::xtf::PingHeader& header, const msg::Soundings& soundings);

formats::xtf::Notes xtf_notes(std::int64_t unix_ns, const std::string& text);

}  // namespace ensonify::logger
