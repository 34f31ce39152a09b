#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "components/formats/kmall/navigation.h"
#include "components/formats/kmall/sound_speed.h"

/// Navigation of a .kmall file, of plain values.
namespace ensonify::logger::kmall {

/// Where the vessel is at a time, and how it lies and moves.
struct VesselState {
  std::int64_t unix_ns = 0;
  double latitude_deg = 200.0;  // of the reference point; 200: not known
  double longitude_deg = 200.0;
  double ellipsoid_height_m = 0.0;
  double roll_deg = 0.0;     // port up
  double pitch_deg = 0.0;    // bow up
  double heading_deg = 0.0;  // true
  double heave_down_m = 0.0;
  std::array<double, 3> rate_degps{};        // roll, pitch, yaw
  std::array<double, 3> velocity_ned_mps{};  // of the reference point
};

/// The fix that a position came from.
struct FixSentence {
  std::string gga;             // without $ and line end, as gga_text() makes it
  std::int64_t unix_ns = 0;    // of the sentence
  double fix_quality_m = 0.0;  // dilution of precision times a length by GGA's quality
};

formats::kmall::Position position(const VesselState& state, const FixSentence& fix);

/// The position that .all files have, at the water line: `state` is of that point.
formats::kmall::CompatiblePosition compatible_position(const VesselState& state, const FixSentence& fix);

/// Most samples of a #SKM.
inline constexpr std::size_t kMostMotionSamples = 148;

/// Of at most kMostMotionSamples.
formats::kmall::Motion motion(std::span<const VesselState> states);

/// "INZDA,120000.00,01,06,2025,00,00*7B": without $ and line end.
std::string zda_text(std::int64_t unix_ns);
/// Of a clock that is right.
formats::kmall::Clock clock(std::int64_t unix_ns);

formats::kmall::SurfaceSoundSpeed surface_sound_speed(std::int64_t unix_ns, double sound_speed_mps);

}  // namespace ensonify::logger::kmall
