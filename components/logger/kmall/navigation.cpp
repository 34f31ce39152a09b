#include "components/logger/kmall/navigation.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "components/formats/utc.h"

namespace ensonify::logger::kmall {

using namespace formats::kmall;

namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kHundredth_ns = 10'000'000;

std::uint32_t seconds_of(std::int64_t unix_ns) { return static_cast<std::uint32_t>(unix_ns / kSecond_ns); }
std::uint32_t rest_of(std::int64_t unix_ns) { return static_cast<std::uint32_t>(unix_ns % kSecond_ns); }
/// Sentences have hundredths of a second: the nearest.
std::int64_t in_sentence(std::int64_t unix_ns) { return (unix_ns + kHundredth_ns / 2) / kHundredth_ns * kHundredth_ns; }

std::string framed(const std::string& sentence) { return "$" + sentence + "\r\n"; }

template <class Kind>
Kind position_of(const Moment& moment, const frames::Geodetic& place, double height_m) {
  constexpr std::uint16_t kActive = 1, kTimeFromSentence = 1 << 9, kMotionCorrected = 1 << 10;
  const std::int64_t sentence_ns = in_sentence(moment.unix_ns);
  Kind position;
  position.sensor = {0, kActive | kTimeFromSentence | kMotionCorrected, 0};
  position.sensor_time_s = seconds_of(sentence_ns);
  position.sensor_time_ns = rest_of(sentence_ns);
  position.fix_quality_m = static_cast<float>(moment.fix_quality_m);
  position.latitude_deg = place.latitude_deg;
  position.longitude_deg = place.longitude_deg;
  position.speed_mps = static_cast<float>(moment.speed_mps);
  position.course_deg = static_cast<float>(moment.course_deg);
  position.height_m = static_cast<float>(height_m);
  position.sentence = framed(moment.gga);
  return position;
}

Motion::Sample sample_of(const Moment& moment) {
  constexpr std::uint32_t kNoAcceleration = 0x10, kNoErrors = 0x20, kNoDelayedHeave = 0x40;
  Motion::Sample sample;
  sample.time_s = seconds_of(moment.unix_ns);
  sample.time_ns = rest_of(moment.unix_ns);
  sample.status = kNoAcceleration | kNoErrors | kNoDelayedHeave;
  sample.latitude_deg = moment.reference.latitude_deg;
  sample.longitude_deg = moment.reference.longitude_deg;
  sample.ellipsoid_height_m = static_cast<float>(moment.height_m);
  sample.roll_deg = static_cast<float>(moment.roll_deg);
  sample.pitch_deg = static_cast<float>(moment.pitch_deg);
  sample.heading_deg = static_cast<float>(moment.heading_deg);
  sample.heave_m = static_cast<float>(moment.heave_down_m);
  sample.velocity_mps = {static_cast<float>(moment.north_mps), static_cast<float>(moment.east_mps),
                         static_cast<float>(moment.down_mps)};
  return sample;
}

/// Of roll, pitch and yaw, in degrees a second.
std::array<float, 3> rates(const Moment& from, const Moment& to) {
  const double time_s = static_cast<double>(to.unix_ns - from.unix_ns) * 1e-9;
  if (time_s <= 0.0) return {};
  return {static_cast<float>((to.roll_deg - from.roll_deg) / time_s),
          static_cast<float>((to.pitch_deg - from.pitch_deg) / time_s),
          static_cast<float>(std::remainder(to.heading_deg - from.heading_deg, 360.0) / time_s)};
}

}  // namespace

Position position(const Moment& moment) { return position_of<Position>(moment, moment.reference, moment.height_m); }

CompatiblePosition compatible_position(const Moment& moment) {
  return position_of<CompatiblePosition>(moment, moment.water_line, moment.height_m);
}

Motion motion(std::span<const Moment> moments, const std::optional<Moment>& before) {
  constexpr std::uint8_t kActive = 1;
  constexpr std::uint16_t kKmBinary = 1, kAllOfKmBinary = 0x7F;
  if (moments.size() > kMostMotionSamples) throw std::invalid_argument("more samples than a #SKM holds");
  Motion motion{.status = kActive, .input_format = kKmBinary, .contents = kAllOfKmBinary};
  for (std::size_t i = 0; i < moments.size(); ++i) {
    motion.samples.push_back(sample_of(moments[i]));
    const Moment earlier = i > 0 ? moments[i - 1] : before.value_or(moments[i]);
    motion.samples.back().rate_degps = rates(earlier, moments[i + 1 < moments.size() ? i + 1 : i]);
  }
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
