#include "components/formats/km_binary/km_binary.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace ensonify::formats::km_binary {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::size_t kWithoutDelayed = 120;
constexpr std::size_t kLengthAt = 4, kLengthEnd = 6;
constexpr std::uint32_t kDay_s = 86400;
// Bits of the status: what is not valid.
constexpr std::uint32_t kNoPlace = 1U << 0U, kNoRollAndPitch = 1U << 1U, kNoHeading = 1U << 2U, kNoHeave = 1U << 3U;

bool begins_as_one(ByteView bytes) {
  static constexpr char kMark[] = {'#', 'K', 'M', 'B'};
  return std::memcmp(bytes.data(), kMark, std::min(bytes.size(), sizeof kMark)) == 0;
}

}  // namespace

Front Format::front(ByteView bytes, bool) const {
  if (!begins_as_one(bytes)) return {Front::Is::garbage, bytes_before(bytes, '#')};
  if (bytes.size() < kLengthEnd) return {};
  ByteSource at(bytes.subspan(kLengthAt));
  const auto stated = at.number<std::uint16_t>();
  if (stated != kWithoutDelayed && stated != kMostBytes) return {Front::Is::garbage, bytes_before(bytes, '#')};
  if (bytes.size() < stated) return {};
  return {Front::Is::frame, stated};
}

std::optional<Sample> read(ByteView frame) {
  Bytes whole(frame.begin(), frame.end());
  whole.resize(Format::kMostBytes);
  LayoutReader in{ByteView(whole)};
  Sample sample;
  in(sample);
  const auto within = [](double value, double most) { return std::abs(value) <= most; };  // false for NaN
  if (frame.size() < kWithoutDelayed || sample.time_ns >= 1'000'000'000U || !within(sample.roll_deg, 180.0) ||
      !within(sample.pitch_deg, 90.0) || !within(sample.heave_m, 100.0) ||
      !(sample.heading_deg >= 0.0F && sample.heading_deg <= 360.0F)) {
    return std::nullopt;
  }
  return sample;
}

Motion motion_of(const Sample& sample) {
  Motion motion;
  motion.time_s = sample.time_s % kDay_s + 1e-9 * sample.time_ns;
  if ((sample.status & kNoRollAndPitch) == 0) {
    motion.roll_rad = sample.roll_deg * kDegree;
    motion.pitch_rad = sample.pitch_deg * kDegree;
  }
  if ((sample.status & kNoHeading) == 0) motion.true_heading_rad = sample.heading_deg * kDegree;
  if ((sample.status & kNoHeave) == 0) motion.heave_m = -sample.heave_m;  // down in the frame
  return motion;
}

std::optional<Place> place_of(const Sample& sample) {
  const bool possible = std::abs(sample.latitude_deg) <= 90.0 && std::abs(sample.longitude_deg) <= 180.0;
  if ((sample.status & kNoPlace) != 0 || !possible) return std::nullopt;
  return Place{sample.latitude_deg, sample.longitude_deg, sample.ellipsoid_height_m};
}

}  // namespace ensonify::formats::km_binary
