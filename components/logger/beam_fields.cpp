#include "components/logger/beam_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/formats/fixed_point.h"

namespace ensonify::logger {

std::uint8_t detection_of(const msg::Soundings& soundings, std::size_t entry) {
  constexpr std::uint8_t kAmplitude = 0, kPhase = 1, kNone = 0x84;  // bit 7: not valid
  if (!is_valid(soundings, entry)) return kNone;
  return entry < soundings.kind.size() && soundings.kind[entry] == 2 ? kPhase : kAmplitude;
}

std::uint16_t count_of(double value) {
  if (!(value > 0.0)) return 0;  // NaN too
  return static_cast<std::uint16_t>(std::min(std::round(value), 65'534.0));
}

double at_or_nan(const msg::Array<float>& values, std::size_t entry) {
  return entry < values.size() ? static_cast<double>(values[entry]) : std::numeric_limits<double>::quiet_NaN();
}

std::int16_t tenths(double strength_db) { return formats::FixedPoint<std::int16_t, 10>::of(strength_db).count; }

std::uint16_t valid_beams(const msg::Soundings& soundings) {
  return static_cast<std::uint16_t>(std::count_if(soundings.valid.flat().begin(), soundings.valid.flat().end(),
                                                  [](std::uint8_t flag) { return flag != 0; }));
}

std::vector<msg::TransmitSector> sectors_of(const msg::AppliedSettings& settings) {
  if (!settings.sectors.empty()) return settings.sectors;
  msg::TransmitSector only;
  only.frequency_hz = settings.frequency_hz;
  only.pulse = settings.pulse;
  only.pulse_length_s = settings.pulse_length_s;
  only.bandwidth_hz = settings.bandwidth_hz;
  only.source_level_db = settings.source_level_db;
  return {only};
}

}  // namespace ensonify::logger
