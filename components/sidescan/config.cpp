#include "components/sidescan/config.h"

#include <cmath>
#include <set>

#include "components/config/read_parameters.h"
#include "components/sonar/ranged_pulse.h"
#include "kernels/acoustics/array/line.h"

namespace ensonify {
namespace {

constexpr double kLeastSweep = 4.0;         // bandwidth times length of a chirp
constexpr double kMostSamples = 100'000.0;  // per side

/// One-way width of a line that transmits and receives with a two-way width: 50.76 / 36.55 of it when uniform.
double one_way_rad(double two_way_rad, const array::Shading& shading) {
  const array::LineArray line = array::line_array_of_width(two_way_rad, 1.0, shading);
  const auto both_ways = [&](double sine) { return std::pow(array::power(line, 1.0, sine), 2); };
  return two_way_rad * std::sin(0.5 * two_way_rad) /
         array::half_power_edges(both_ways, 0.0, 0.1 * two_way_rad).upper_sine;
}

}  // namespace

void SidescanChannel::check(const ConfigReader& from) const {
  check_taper(from, chirp, tapered_fraction);
  if (chirp && bandwidth_hz * pulse_length_s < kLeastSweep) {
    from.problem("bandwidth_hz", "times pulse_length_s is " + std::to_string(bandwidth_hz * pulse_length_s) +
                                     ": a chirp needs at least 4");
  }
  if (!chirp && bandwidth_hz != 0.0) from.problem("bandwidth_hz", "only a chirp sweeps; set pulse: chirp");
  if ((focus == Focus::kFixed) != (focus_m > 0.0)) {
    from.problem("focus_m", "is the range that focus: fixed is focused at, above 0, and 0 otherwise");
  }
  if (focus != Focus::kIdeal && shading.window != array::Shading::Window::kUniform) {
    from.problem("shading", "is of lines with focus: ideal; the near field is that of a uniform line");
  }
}

echo::Pulse SidescanChannel::pulse(double length_s) const {
  if (chirp) return echo::compressed_chirp(length_s, bandwidth_hz, window);
  return echo::tapered_pulse(length_s, tapered_fraction);
}

SidescanConfig SidescanConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  SidescanConfig c;
  read_parameters(from, c);
  std::set<std::string> names;
  for (std::size_t i = 0; i < c.channels.size(); ++i) {
    SidescanChannel& channel = c.channels[i];
    if (!names.insert(channel.name).second) {
      from.problem("channels[" + std::to_string(i) + "].name", "is taken by another channel");
    }
    if (from.good() && channel.two_way) {
      channel.horizontal_beamwidth_rad = one_way_rad(channel.horizontal_beamwidth_rad, channel.shading);
    }
  }
  if (c.channels.empty()) from.problem("channels", "needs at least one channel");
  place_head(from, world, process, c);
  for (const SidescanChannel& channel : c.channels) {
    const double samples = c.reception_s(channel.range_m, channel.pulse_length_s) / channel.sample_period_s();
    if (samples > kMostSamples) {
      from.problem("channels", "channel " + channel.name + " makes " + std::to_string(std::llround(samples)) +
                                   " samples a side; at most 100000 are allowed: shorten range_m");
    }
  }
  return c;
}

HeadSettings SidescanConfig::start_of(const SidescanChannel& channel) const {
  HeadSettings start = start_at(channel.range_m, channel.source_level_db);
  start.pulse_length_s = channel.pulse_length_s;
  return start;
}

SettingLimits SidescanConfig::limits_of(const SidescanChannel& channel) const {
  SettingLimits limits = limits_up_to(1.0, channel.range_m, channel.source_level_db);
  // Samples come as often as the shortest pulse needs; a chirp's length changes neither resolution nor samples.
  limits["pulse_length_s"] = {
      {channel.chirp ? kLeastSweep / channel.bandwidth_hz : channel.pulse_length_s, SidescanChannel::kLongestPulse_s}};
  return limits;
}

}  // namespace ensonify
