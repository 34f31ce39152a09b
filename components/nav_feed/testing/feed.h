#pragma once

#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "components/formats/nmea/testing/sentence.h"
#include "components/nav_feed/fed_track.h"
#include "components/nav_feed/source_decoder.h"

/// Sentences of a made-up source, and a track that they are given to.
namespace ensonify::feed {

inline const frames::Geodetic kOrigin{53.21, -9.37};  // no whole degrees, whose minutes would round to 60
inline constexpr double kDegree = 3.14159265358979323846 / 180.0;

inline std::string time_of(double t_s) {
  const int milliseconds = static_cast<int>(std::llround(1e3 * t_s)) % 86400000, whole = milliseconds / 1000;
  char text[16];
  std::snprintf(text, sizeof text, "%02d%02d%02d.%03d", whole / 3600, whole / 60 % 60, whole % 60, milliseconds % 1000);
  return text;
}

/// GGA of a place in the world, with seven decimals of a minute (0.2 mm) and four of a metre.
inline std::string fix(double utc_s, double east_m, double north_m, double above_geoid_m = 1.0) {
  const auto place = frames::LocalProjection(kOrigin).geodetic_of({east_m, north_m});
  const double latitude = std::abs(place.latitude_deg), longitude = std::abs(place.longitude_deg);
  char text[128];
  std::snprintf(text, sizeof text, "GPGGA,%s,%02d%010.7f,N,%03d%010.7f,W,4,12,0.7,%.4f,M,50,M,,",
                time_of(utc_s).c_str(), static_cast<int>(latitude), 60.0 * std::fmod(latitude, 1.0),
                static_cast<int>(longitude), 60.0 * std::fmod(longitude, 1.0), above_geoid_m);
  return nmea::sentence(text);
}

inline std::string heading(double degrees) { return nmea::sentence("HEHDT," + std::to_string(degrees) + ",T"); }

/// A track with one source, whose bytes it takes as datagrams.
struct FedBytes {
  FedTrack track;
  SourceDecoder decoder;

  FedBytes(const NavFeedConfig& config, const frames::LocalProjection& world, const FedTrack::Count& count)
      : track(config, world, count), decoder(config.sources[0], count) {}
  void take(std::string_view bytes, SimTime now) {
    decoder.take(bytes, false, true, [&](const nmea::Navigation& said) { track.take(said, {now, 0}); });
  }
  std::optional<frames::MovingPose> at(SimTime now) const { return track.at(now); }
  bool lacks_data(SimTime now) const { return track.lacks_data(now); }
  std::string trouble(SimTime now) const { return track.trouble(now); }
  void forget(SimTime now) { track.forget(now); }
  std::optional<msg::Position> take_fix() { return track.take_fix(); }
};

struct Fed {
  NavFeedConfig config{};
  std::map<std::string, int> counts{};
  FedBytes feed{config, frames::LocalProjection(kOrigin), [this](const std::string& what) { ++counts[what]; }};
};

inline std::string motion_sentence(double utc_s, double roll_deg, double heave_m) {
  char text[128];
  std::snprintf(text, sizeof text, "PASHR,%s,90.00,T,%+.3f,+0.00,%+.4f,0.1,0.1,0.1,1,1", time_of(utc_s).c_str(),
                roll_deg, heave_m);
  return nmea::sentence(text);
}

inline SimTime at_s(double t_s) { return from_seconds(t_s); }

}  // namespace ensonify::feed
