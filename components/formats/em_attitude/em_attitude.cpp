#include "components/formats/em_attitude/em_attitude.h"

#include <cstdlib>
#include <numbers>

namespace ensonify::formats::em_attitude {
namespace {

constexpr double kHundredthDegree = std::numbers::pi / 18000.0;
constexpr std::uint8_t kSync = 0x90, kInvalid = 0x9A, kLastError = 0xAF;

}  // namespace

std::optional<Sample> read(ByteView frame) {
  if (frame.size() != Format::kMostBytes) return std::nullopt;
  ByteSource in(frame);
  Sample sample;
  sample.status = in.number<std::uint8_t>();
  const auto sync = in.number<std::uint8_t>();
  const auto roll = in.number<std::int16_t>(), pitch = in.number<std::int16_t>(), heave_cm = in.number<std::int16_t>();
  const auto heading = in.number<std::uint16_t>();
  const bool known = sample.status == 0 || (sample.status >= kSync && sample.status <= kLastError);
  if (!known || sync != kSync || std::abs(roll) > 18000 || std::abs(pitch) > 9000 || std::abs(heave_cm) > 1000 ||
      heading > 36000) {
    return std::nullopt;
  }
  sample.motion.roll_rad = roll * kHundredthDegree;
  sample.motion.pitch_rad = pitch * kHundredthDegree;
  sample.motion.heave_m = 0.01 * heave_cm;
  sample.motion.true_heading_rad = heading * kHundredthDegree;
  sample.motion.usable = sample.status < kInvalid;
  return sample;
}

Front Format::front(ByteView bytes, bool behind_a_frame) const {
  if (bytes.size() < kMostBytes) return {};
  if (!read(bytes.first(kMostBytes))) return {Front::Is::garbage, 1};
  if (behind_a_frame) return {Front::Is::frame, kMostBytes};
  if (bytes.size() < 2 * kMostBytes) return {};
  if (!read(bytes.subspan(kMostBytes, kMostBytes))) return {Front::Is::garbage, 1};
  return {Front::Is::frame, kMostBytes};
}

}  // namespace ensonify::formats::em_attitude
