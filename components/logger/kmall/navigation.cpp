#include "components/logger/kmall/navigation.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "components/formats/utc.h"

namespace ensonify::logger::kmall {

using namespace formats::kmall;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kHundredth_ns = 10'000'000;

std::uint32_t seconds_of(std::int64_t unix_ns) { return static_cast<std::uint32_t>(unix_ns / kSecond_ns); }
std::uint32_t rest_of(std::int64_t unix_ns) { return static_cast<std::uint32_t>(unix_ns % kSecond_ns); }
/// Sentences have hundredths of a second: the nearest.
std::int64_t in_sentence(std::int64_t unix_ns) { return (unix_ns + kHundredth_ns / 2) / kHundredth_ns * kHundredth_ns; }

std::array<float, 3> floats(const std::array<double, 3>& values) {
  return {static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2])};
}

std::string framed(const std::string& sentence) { return "$" + sentence + "\r\n"; }

template <class Kind>
Kind position_of(const VesselState& state, const FixSentence& fix) {
  constexpr std::uint16_t kActive = 1, kTimeFromSentence = 1 << 9, kMotionCorrected = 1 << 10;
  const auto& [north_mps, east_mps, down_mps] = state.velocity_ned_mps;
  const std::int64_t sentence_ns = in_sentence(fix.unix_ns);
  const double course_deg = std::atan2(east_mps, north_mps) / kDegree;
  Kind position;
  position.sensor = {0, kActive | kTimeFromSentence | kMotionCorrected, 0};
  position.sensor_time_s = seconds_of(sentence_ns);
  position.sensor_time_ns = rest_of(sentence_ns);
  position.fix_quality_m = static_cast<float>(fix.fix_quality_m);
  position.latitude_deg = state.latitude_deg;
  position.longitude_deg = state.longitude_deg;
  position.speed_mps = static_cast<float>(std::hypot(north_mps, east_mps));
  position.course_deg = static_cast<float>(course_deg < 0.0 ? course_deg + 360.0 : course_deg);
  position.height_m = static_cast<float>(state.ellipsoid_height_m);
  position.sentence = framed(fix.gga);
  return position;
}

Motion::Sample sample_of(const VesselState& state) {
  constexpr std::uint32_t kNoAcceleration = 0x10, kNoErrors = 0x20, kNoDelayedHeave = 0x40;
  Motion::Sample sample;
  sample.time_s = seconds_of(state.unix_ns);
  sample.time_ns = rest_of(state.unix_ns);
  sample.status = kNoAcceleration | kNoErrors | kNoDelayedHeave;
  sample.latitude_deg = state.latitude_deg;
  sample.longitude_deg = state.longitude_deg;
  sample.ellipsoid_height_m = static_cast<float>(state.ellipsoid_height_m);
  sample.roll_deg = static_cast<float>(state.roll_deg);
  sample.pitch_deg = static_cast<float>(state.pitch_deg);
  sample.heading_deg = static_cast<float>(state.heading_deg);
  sample.heave_m = static_cast<float>(state.heave_down_m);
  sample.rate_degps = floats(state.rate_degps);
  sample.velocity_mps = floats(state.velocity_ned_mps);
  return sample;
}

}  // namespace

Position position(const VesselState& state, const FixSentence& fix) { return position_of<Position>(state, fix); }

CompatiblePosition compatible_position(const VesselState& state, const FixSentence& fix) {
  return position_of<CompatiblePosition>(state, fix);
}

Motion motion(std::span<const VesselState> states) {
  constexpr std::uint8_t kActive = 1;
  constexpr std::uint16_t kKmBinary = 1, kAllOfKmBinary = 0x7F;
  if (states.size() > kMostMotionSamples) throw std::invalid_argument("more samples than a #SKM holds");
  Motion motion{.status = kActive, .input_format = kKmBinary, .contents = kAllOfKmBinary};
  for (const VesselState& state : states) motion.samples.push_back(sample_of(state));
  return motion;
}

std::string zda_text(std::int64_t unix_ns) {
  const formats::DayTime time = formats::day_time(unix_ns);
  const std::string body = fmt::format("INZDA,{:02}{:02}{:02}.{:02},{:02},{:02},{:04},00,00", time.time_ms / 3'600'000,
                                       time.time_ms / 60'000 % 60, time.time_ms / 1'000 % 60, time.time_ms / 10 % 100,
                                       time.date % 100, time.date / 100 % 100, time.date / 10'000);
  unsigned sum = 0;
  for (const char letter : body) sum ^= static_cast<unsigned char>(letter);
  return fmt::format("{}*{:02X}", body, sum);
}

Clock clock(std::int64_t unix_ns) {
  constexpr std::uint16_t kClock = 5, kActive = 1;
  Clock clock;
  clock.sensor = {kClock, kActive, 0};
  clock.sentence = framed(zda_text(unix_ns));
  return clock;
}

SurfaceSoundSpeed surface_sound_speed(std::int64_t unix_ns, double sound_speed_mps) {
  constexpr std::uint16_t kActive = 1, kAmlNmea = 1, kSoundSpeed = 1;
  constexpr float kNotKnown = -9'999.0F;
  SurfaceSoundSpeed surface{.status = kActive, .input_format = kAmlNmea, .contents = kSoundSpeed};
  surface.samples.push_back({.time_s = seconds_of(unix_ns),
                             .time_ns = rest_of(unix_ns),
                             .sound_speed_mps = static_cast<float>(sound_speed_mps),
                             .temperature_degc = kNotKnown,
                             .pressure_pa = kNotKnown,
                             .salinity_psu = kNotKnown});
  return surface;
}

}  // namespace ensonify::logger::kmall
