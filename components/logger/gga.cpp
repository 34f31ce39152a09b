#include "components/logger/gga.h"

#include <fmt/format.h>

#include <cmath>

#include "components/formats/utc.h"

namespace ensonify::logger {

namespace {

/// Degrees and minutes. Rounded once, as a whole number of the last decimal, so that minutes never read 60.
std::string degrees_text(double angle_deg, int degree_digits) {
  constexpr std::int64_t kSteps = 10'000'000;  // of a minute
  const std::int64_t steps = std::llround(std::abs(angle_deg) * 60.0 * kSteps);
  const std::int64_t degrees = steps / (60 * kSteps), minutes = steps / kSteps % 60;
  return fmt::format("{:0{}}{:02}.{:07}", degrees, degree_digits, minutes, steps % kSteps);
}

}  // namespace

std::string gga_text(const Fix& fix) {
  constexpr std::int64_t kHundredth_ns = 10'000'000;
  const formats::DayTime time = formats::day_time(fix.unix_ns + kHundredth_ns / 2);
  const std::string body = fmt::format(
      "INGGA,{:02}{:02}{:02}.{:02},{},{},{},{},{},12,{:.1f},{:.3f},M,{:.3f},M,,", time.time_ms / 3'600'000,
      time.time_ms / 60'000 % 60, time.time_ms / 1'000 % 60, time.time_ms / 10 % 100, degrees_text(fix.latitude_deg, 2),
      fix.latitude_deg < 0 ? 'S' : 'N', degrees_text(fix.longitude_deg, 3), fix.longitude_deg < 0 ? 'W' : 'E',
      fix.quality, fix.hdop, fix.height_above_geoid_m, fix.geoid_above_ellipsoid_m);
  unsigned sum = 0;
  for (const char letter : body) sum ^= static_cast<unsigned char>(letter);
  return fmt::format("{}*{:02X}", body, sum);
}

}  // namespace ensonify::logger
