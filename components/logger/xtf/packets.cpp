#include "components/logger/xtf/packets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "components/formats/text.h"
#include "components/logger/beam_fields.h"

namespace ensonify::logger {

using namespace formats::xtf;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kKnotsPerMps = 3600.0 / 1852.0;
constexpr std::int64_t kMillisecond_ns = 1'000'000, kHundredth_ns = 10'000'000, kSecond_ns = 1'000'000'000,
                       kTenthMillisecond_ns = 100'000;

/// The nearest multiple: fields of a time are cut, not rounded.
std::int64_t nearest(std::int64_t unix_ns, std::int64_t step_ns) { return (unix_ns + step_ns / 2) / step_ns * step_ns; }

/// Fraction of the second, in steps.
std::int64_t steps_of_second(std::int64_t unix_ns, std::int64_t step_ns) { return unix_ns % kSecond_ns / step_ns; }

/// Days since 1 January.
std::uint16_t day_of_year(std::int64_t unix_ns) {
  const std::int64_t year = Time::of(unix_ns).year;
  return static_cast<std::uint16_t>((unix_ns - formats::unix_ns(static_cast<std::uint32_t>(year * 10'000 + 101), 0)) /
                                    (86'400 * kSecond_ns));
}

std::array<std::uint8_t, 4> clock_time(const Time& time, std::uint8_t hundredths) {
  return {time.hour, time.minute, time.second, hundredths};
}

}  // namespace

std::uint32_t XtfClock::ms(std::int64_t unix_ns) const {
  return static_cast<std::uint32_t>((unix_ns - start_unix_ns + kMillisecond_ns / 2) / kMillisecond_ns);
}

PingHeader xtf_ping_header(const XtfMoment& at, const XtfClock& clock, std::int64_t ping, double sound_speed_mps,
                           double altitude_m) {
  const std::int64_t time_ns = nearest(at.unix_ns, kHundredth_ns);
  PingHeader header{.time = Time::of(time_ns)};
  header.hundredths = static_cast<std::uint8_t>(steps_of_second(time_ns, kHundredth_ns));
  header.day_of_year = day_of_year(time_ns);
  header.ping = static_cast<std::uint32_t>(ping);
  header.half_sound_speed_mps = static_cast<float>(0.5 * sound_speed_mps);
  header.computed_sound_speed_mps = static_cast<float>(sound_speed_mps);
  header.ship_speed_kn = header.sensor_speed_kn = static_cast<float>(at.speed_mps * kKnotsPerMps);
  header.ship_heading_deg = header.heading_deg = static_cast<float>(at.heading_deg);
  header.ship_y = at.ship_latitude_deg;
  header.ship_x = at.ship_longitude_deg;
  header.sensor_y = at.sensor_latitude_deg;
  header.sensor_x = at.sensor_longitude_deg;
  // The position is of the time of the ping: so is the fix.
  header.fix_time = header.computer_time = clock_time(header.time, header.hundredths);
  header.fix_ms = static_cast<std::uint32_t>(steps_of_second(nearest(at.unix_ns, kMillisecond_ns), kMillisecond_ns));
  header.sensor_depth_m = static_cast<float>(at.sensor_depth_m);
  header.sensor_altitude_m = static_cast<float>(altitude_m);
  header.ship_altitude_m = header.ship_altitude_m.of(altitude_m > 0.0 ? altitude_m + at.sensor_depth_m : 0.0);
  header.pitch_deg = static_cast<float>(at.pitch_deg);
  header.roll_deg = static_cast<float>(at.roll_deg);
  header.heave_m = static_cast<float>(at.heave_up_m);
  header.attitude_time_ms = clock.ms(at.unix_ns);
  return header;
}

Attitude xtf_attitude(const XtfMoment& at, const XtfClock& clock) {
  const std::int64_t time_ns = nearest(at.unix_ns, kMillisecond_ns);
  Attitude attitude{.epoch_us = static_cast<std::uint32_t>(steps_of_second(at.unix_ns, 1'000)),
                    .source_epoch = static_cast<std::uint32_t>(at.unix_ns / kSecond_ns)};
  attitude.pitch_deg = static_cast<float>(at.pitch_deg);
  attitude.roll_deg = static_cast<float>(at.roll_deg);
  attitude.heave_m = static_cast<float>(at.heave_up_m);
  attitude.heading_deg = static_cast<float>(at.heading_deg);
  attitude.time_ms = clock.ms(at.unix_ns);
  attitude.time = Time::of(time_ns);
  attitude.milliseconds = static_cast<std::uint16_t>(steps_of_second(time_ns, kMillisecond_ns));
  return attitude;
}

RawNavigation xtf_navigation(const XtfMoment& at) {
  const std::int64_t time_ns = nearest(at.unix_ns, kTenthMillisecond_ns);
  RawNavigation navigation{.time = Time::of(time_ns)};
  navigation.tenths_ms = static_cast<std::uint16_t>(steps_of_second(time_ns, kTenthMillisecond_ns));
  navigation.y = at.ship_latitude_deg;
  navigation.x = at.ship_longitude_deg;
  navigation.pitch_deg = static_cast<float>(at.pitch_deg);
  navigation.roll_deg = static_cast<float>(at.roll_deg);
  navigation.heave_m = static_cast<float>(at.heave_up_m);
  navigation.heading_deg = static_cast<float>(at.heading_deg);
  return navigation;
}

MultibeamPing xtf_multibeam(const PingHeader& header, const msg::Soundings& soundings) {
  constexpr std::int32_t kGood = 3;
  MultibeamPing ping{.header = header};
  const auto& sectors = soundings.applied.sectors;
  for (std::size_t i = 0; i < soundings.beam_angle_rad.size(); ++i) {
    MultibeamPing::Beam beam{.number = static_cast<std::int32_t>(i)};
    beam.angle_deg = static_cast<double>(soundings.beam_angle_rad[i]) / kDegree;
    const std::size_t sector = i < soundings.sector.size() ? soundings.sector[i] : 0;
    if (sector < sectors.size()) {
      beam.tilt_deg = sectors[sector].tilt_rad / kDegree;
      beam.delay_s = sectors[sector].delay_s;
    }
    if (is_valid(soundings, i)) {
      beam.travel_time_s = static_cast<double>(at_or_nan(soundings.travel_time_s, i));
      const double level_db = at_or_nan(soundings.backscatter_strength_db, i);
      beam.intensity = std::isfinite(level_db) ? level_db : 0.0;
      beam.quality = kGood;
    }
    ping.beams.push_back(beam);
  }
  return ping;
}

Notes xtf_notes(std::int64_t unix_ns, const std::string& text) {
  return {.time = Time::of(unix_ns), .text = formats::padded<200>(text.substr(0, 199))};
}

}  // namespace ensonify::logger
