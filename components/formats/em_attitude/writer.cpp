#include "components/formats/em_attitude/writer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ensonify::formats::em_attitude {
namespace {

constexpr double kHundredthDegree = std::numbers::pi / 18000.0;
constexpr std::uint8_t kSync = 0x90;
constexpr long kTurn = 36'000;

std::int16_t steps(const std::optional<double>& value, double step, long most) {
  return static_cast<std::int16_t>(std::clamp(std::lround(value.value_or(0.0) / step), -most, most));
}

}  // namespace

Bytes write(const Sample& sample) {
  const Motion& motion = sample.motion;
  const long heading = std::lround(motion.true_heading_rad.value_or(0.0) / kHundredthDegree) % kTurn;
  Bytes frame;
  append_number(frame, sample.status);
  append_number(frame, kSync);
  append_number(frame, steps(motion.roll_rad, kHundredthDegree, 18'000));
  append_number(frame, steps(motion.pitch_rad, kHundredthDegree, 9000));
  append_number(frame, steps(motion.heave_m, 0.01, 1000));
  append_number(frame, static_cast<std::uint16_t>((heading + kTurn) % kTurn));
  return frame;
}

}  // namespace ensonify::formats::em_attitude
