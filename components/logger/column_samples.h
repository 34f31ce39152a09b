#pragma once

#include <cstdint>
#include <vector>

#include "components/logger/format.h"
#include "components/logger/ping_place.h"

namespace ensonify::logger {

/// A ping's water column as files have it: level less source level, with the head's range-varying gain and an offset,
/// in halves of a decibel from -64 to 63.5 dB.
struct ColumnSamples {
  struct Beam {
    double angle_deg = 0.0;  // re vertical, to port
    std::uint8_t sector = 0;
    double detected_sample = 0.0;  // 0: none
    std::vector<std::int8_t> half_db;
  };
  std::uint16_t first_sample = 0;
  std::uint8_t log_factor = 0;  // X of X log R + 2 alpha R + offset
  std::int8_t offset_db = 0;
  std::vector<Beam> beams;
};

/// Of a ping that has a water column.
ColumnSamples column_samples(const LoggedSoundings& ping, const PingPlace& place);

}  // namespace ensonify::logger
