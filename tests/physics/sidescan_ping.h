#pragma once

#include "components/sidescan/head.h"
#include "components/sonar/testing/config.h"
#include "components/sonar/testing/ping.h"

namespace ensonify::physics {

/// A sidescan of one frequency that receives only the seabed: no noise, no sound by way of the surface. Its beams
/// are 0.5 degrees wide, its pulses 100 us long.
inline SidescanConfig sidescan_of(double frequency_hz) {
  SidescanConfig config;
  world_of(config).water.profile.sound_speed_mps = 1500.0;
  config.channels[0].frequency_hz = frequency_hz;
  config.channels[0].horizontal_beamwidth_rad = 0.5 * SidescanChannel::kDegree;
  config.channels[0].range_m = 101.0;
  config.effects.noise = config.effects.multipath = false;
  return config;
}

/// What the head receives at rest, heading north.
inline msg::Ping sidescan_ping(const SidescanConfig& config, trace::Scene& seabed, const frames::Vec3& position_enu_m,
                               std::int64_t ping = 0) {
  frames::PoseHistory at_rest(1'000'000'000);
  at_rest.push(0, {position_enu_m, frames::enu_from_ned()});
  Sidescan head(config, 0);
  const HeadSettings settings = config.start_of(config.channels[0]);
  return image_of(head, {ping, SimTime{0}, settings.range_m}, settings, around(at_rest, seabed));
}

inline double sample_time_s(const msg::Ping& ping, std::size_t sample) {
  return ping.first_sample_s + static_cast<double>(sample) * static_cast<double>(ping.sample_period_s);
}

/// Samples whose echoes came from slant ranges about this one: the echo at t is that of c (t - tau) / 2 .. c t / 2.
struct Samples {
  std::size_t first, end;
};
inline Samples samples_about(const msg::Ping& ping, double range_m, double around_m) {
  const auto sample = [&](double r) {
    return static_cast<std::size_t>((r / 750.0 + 0.5 * ping.applied.pulse_length_s) / ping.sample_period_s);
  };
  return {sample(range_m - around_m), sample(range_m + around_m) + 1};
}

/// Sum of squared amplitudes, uPa^2.
inline double power_sum(const msg::Ping& ping, std::size_t side, Samples samples) {
  double sum = 0.0;
  for (std::size_t k = samples.first; k < samples.end; ++k) {
    const double a = static_cast<double>(ping.amplitude_upa(side, k));
    sum += a * a;
  }
  return sum;
}

}  // namespace ensonify::physics
