#pragma once

#include <cstdint>
#include <optional>
#include <string>

/// Position reports of class A transponders (AIS, messages of type 1) in sentences of NMEA 0183 [ITU1371], written.
namespace ensonify::formats::ais {

/// What a vessel says of itself. What it does not know is not given.
struct PositionReport {
  std::uint32_t mmsi = 0;
  int status = 15;                        // 0 under way using engine, 1 at anchor, 5 moored, 15 not given
  std::optional<double> turn_rate_radps;  // to starboard
  std::optional<double> speed_mps;        // over ground
  bool accurate = false;                  // within 10 m
  double latitude_deg = 0.0, longitude_deg = 0.0;
  std::optional<double> course_rad;  // over ground, from true north
  std::optional<double> heading_rad;
  int second = 60;          // of UTC, of the position; 60: not given
  std::uint32_t radio = 0;  // state of the radio link, as transmitted
};

/// !AIVDM: as others' receivers give it.
std::string vdm(const PositionReport& report);
/// !AIVDO: as the vessel's own transponder gives it.
std::string vdo(const PositionReport& report);

}  // namespace ensonify::formats::ais
