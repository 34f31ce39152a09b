#pragma once

#include <cstdint>
#include <string>

namespace ensonify::logger {

/// A fix as a GGA sentence has it.
struct Fix {
  std::int64_t unix_ns = 0;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  std::int64_t quality = 0;  // 4: RTK fixed
  double hdop = 0.0;
  double height_above_geoid_m = 0.0;
  double geoid_above_ellipsoid_m = 0.0;
};

/// "INGGA,120000.00,5400.0000000,N,...*5A": without $ and line end, as .all files keep it.
std::string gga_text(const Fix& fix);

}  // namespace ensonify::logger
