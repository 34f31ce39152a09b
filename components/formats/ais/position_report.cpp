#include "components/formats/ais/position_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::formats::ais {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kKnot_mps = 1852.0 / 3600.0;
constexpr int kBitsALetter = 6;

/// Bits of a message, the highest of each number first, six to a letter.
class Letters {
 public:
  void put(std::int64_t value, int bits) {
    for (int bit = bits - 1; bit >= 0; --bit) {
      letter_ = 2U * letter_ + static_cast<unsigned>(value >> bit & 1);
      if (++count_ % kBitsALetter != 0) continue;
      text_ += static_cast<char>(letter_ + (letter_ < 40 ? '0' : '8'));
      letter_ = 0;
    }
  }
  /// Of a message whose bits are a multiple of six.
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  unsigned letter_ = 0;
  int count_ = 0;
};

std::int64_t rounded(double value) { return std::llround(value); }

/// 4.733 times the root of degrees a minute, with the sign of the turn; -128: not given.
std::int64_t turn_code(const std::optional<double>& rate_radps) {
  if (!rate_radps) return -128;
  const double degrees_a_minute = *rate_radps / kDegree * 60.0;
  const std::int64_t size = std::min<std::int64_t>(rounded(4.733 * std::sqrt(std::abs(degrees_a_minute))), 126);
  return degrees_a_minute < 0.0 ? -size : size;
}

/// Tenths of a knot to 102.2 knots; 1023: not given.
std::int64_t speed_code(const std::optional<double>& speed_mps) {
  return speed_mps ? std::min<std::int64_t>(rounded(*speed_mps / kKnot_mps * 10.0), 1022) : 1023;
}

/// Of so many steps in a turn; `none`: not given.
std::int64_t direction_code(const std::optional<double>& rad, std::int64_t steps, std::int64_t none) {
  if (!rad) return none;
  const std::int64_t step = rounded(*rad / (2.0 * std::numbers::pi) * static_cast<double>(steps));
  return (step % steps + steps) % steps;
}

/// Ten thousandths of a minute.
std::int64_t angle_code(double degrees) { return rounded(degrees * 600'000.0); }

std::string payload(const PositionReport& report) {
  Letters letters;
  letters.put(1, 6);  // the type
  letters.put(0, 2);  // repeated by nobody
  letters.put(report.mmsi, 30);
  letters.put(report.status, 4);
  letters.put(turn_code(report.turn_rate_radps), 8);
  letters.put(speed_code(report.speed_mps), 10);
  letters.put(report.accurate ? 1 : 0, 1);
  letters.put(angle_code(report.longitude_deg), 28);
  letters.put(angle_code(report.latitude_deg), 27);
  letters.put(direction_code(report.course_rad, 3600, 3600), 12);
  letters.put(direction_code(report.heading_rad, 360, 511), 9);
  letters.put(report.second, 6);
  letters.put(0, 2 + 3 + 1);  // no special manoeuvre given, spare, no integrity monitoring
  letters.put(report.radio, 19);
  return letters.text();
}

/// The sentence with `!`, sum and CR LF; on no channel where it was not received.
std::string sentence(const char* kind, const char* channel, const PositionReport& report) {
  const std::string body = fmt::format("{},1,1,,{},{},0", kind, channel, payload(report));
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  return fmt::format("!{}*{:02X}\r\n", body, sum);
}

}  // namespace

std::string vdm(const PositionReport& report) { return sentence("AIVDM", "A", report); }
std::string vdo(const PositionReport& report) { return sentence("AIVDO", "", report); }

}  // namespace ensonify::formats::ais
