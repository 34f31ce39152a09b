#include "components/formats/tss1/writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::formats::tss1 {
namespace {

constexpr double kHundredthDegree = std::numbers::pi / 18000.0;
constexpr double kHorizontalStep_mps2 = 0.0383, kVerticalStep_mps2 = 0.000625;

int steps(double value, double step, int least, int most) {
  return static_cast<int>(std::clamp<long>(std::lround(value / step), least, most));
}

/// A space or a minus, and four digits.
std::string signed_text(double value, double step, int most) {
  const int count = steps(value, step, -most, most);
  return fmt::format("{}{:04}", count < 0 ? '-' : ' ', std::abs(count));
}

}  // namespace

std::string write(const Sample& sample) {
  const Motion& motion = sample.motion;
  const auto vertical =
      static_cast<std::uint16_t>(steps(sample.vertical_acceleration_mps2, kVerticalStep_mps2, -32768, 32767));
  return fmt::format(":{:02X}{:04X} {}{}{} {}\r\n",
                     steps(sample.horizontal_acceleration_mps2, kHorizontalStep_mps2, 0, 255), vertical,
                     signed_text(motion.heave_m.value_or(0.0), 0.01, 9999), sample.status,
                     signed_text(motion.roll_rad.value_or(0.0), kHundredthDegree, 9000),
                     signed_text(motion.pitch_rad.value_or(0.0), kHundredthDegree, 9000));
}

}  // namespace ensonify::formats::tss1
