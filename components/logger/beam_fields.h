#pragma once

#include <cstdint>
#include <vector>

#include "messages/soundings.h"

/// What a format's datagrams, and the formats, say of a beam alike.
namespace ensonify::logger {

inline bool is_valid(const msg::Soundings& soundings, std::size_t entry) {
  return entry < soundings.valid.size() && soundings.valid[entry] != 0;
}

/// How the bottom was found: by amplitude, by phase, or not at all; then all else is zero.
std::uint8_t detection_of(const msg::Soundings& soundings, std::size_t entry);

/// A count of samples, rounded; 0 of what is none, at most what is still a number.
std::uint16_t count_of(double value);

/// NaN where the message does not give it.
double at_or_nan(const msg::Array<float>& values, std::size_t entry);

inline float sampling_hz(double sample_period_s) { return static_cast<float>(1.0 / sample_period_s); }

/// Tenths of a decibel, as images have them.
std::int16_t tenths(double strength_db);

std::uint16_t valid_beams(const msg::Soundings& soundings);

/// The sectors of a ping; of a head without any, its one transmission.
std::vector<msg::TransmitSector> sectors_of(const msg::AppliedSettings& settings);

}  // namespace ensonify::logger
