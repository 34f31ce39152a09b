#include "components/sidescan/config.h"

#include <cmath>
#include <set>

#include "components/config/config_reader.h"
#include "components/sonar/line_shading.h"
#include "components/sonar/ranged_pulse.h"
#include "components/sonar/tone_shape.h"
#include "kernels/acoustics/array/line_array.h"

namespace ensonify {
namespace {

constexpr double kFastest_hz = 100.0;

constexpr double kLeastSweep = 4.0;  // bandwidth times length of a chirp
constexpr double kLongestPulse_s = 20e-3;
constexpr double kMostSamples = 100'000.0;  // per side

/// One-way width of a line that transmits and receives with a two-way width: 50.76 / 36.55 of it when uniform.
double one_way_rad(double two_way_rad, const array::Shading& shading) {
  const array::LineArray line = array::line_array_of_width(two_way_rad, 1.0, shading);
  const auto both_ways = [&](double sine) { return std::pow(array::power(line, 1.0, sine), 2); };
  return two_way_rad * std::sin(0.5 * two_way_rad) /
         array::half_power_edges(both_ways, 0.0, 0.1 * two_way_rad).upper_sine;
}

void check(const ConfigReader& from, const SidescanChannel& c) {
  if (c.chirp && c.bandwidth_hz * c.pulse_length_s < kLeastSweep) {
    from.problem("bandwidth_hz", "times pulse_length_s is " + std::to_string(c.bandwidth_hz * c.pulse_length_s) +
                                     ": a chirp needs at least 4");
  }
  if (!c.chirp && c.bandwidth_hz != 0.0) from.problem("bandwidth_hz", "only a chirp sweeps; set pulse: chirp");
  if ((c.focus == Focus::kFixed) != (c.focus_m > 0.0)) {
    from.problem("focus_m", "is the range that focus: fixed is focused at, above 0, and 0 otherwise");
  }
  if (c.focus != Focus::kIdeal && c.shading.window != array::Shading::Window::kUniform) {
    from.problem("shading", "is of lines with focus: ideal; the near field is that of a uniform line");
  }
}

}  // namespace

SidescanChannel SidescanChannel::read(ConfigReader& from) {
  SidescanChannel c;
  from.required("name", c.name);
  from.required("frequency_hz", c.frequency_hz, 50e3, 1e6);
  bool two_way = false;
  from.optional("horizontal_beamwidth_deg", c.horizontal_beamwidth_rad, 0.05, 10, kDegrees);
  from.optional_choice("horizontal_beamwidth_is", two_way, {{"one_way", false}, {"two_way", true}});
  read_shading(from, "shading", c.shading);
  from.optional("vertical_beamwidth_deg", c.vertical_beamwidth_rad, 5, 150, kDegrees);
  from.optional("depression_deg", c.depression_rad, 0, 90, kDegrees);
  from.optional("back_loss_db", c.back_loss_db, 0, 100);
  from.optional_choice(
      "focus", c.focus,
      {{"ideal", Focus::kIdeal}, {"echo", Focus::kEcho}, {"fixed", Focus::kFixed}, {"off", Focus::kOff}});
  from.optional("focus_m", c.focus_m, 0, 1000);
  from.optional("source_level_db", c.source_level_db, -300, 250);
  from.optional_choice("pulse", c.chirp, {{"tone", false}, {"chirp", true}});
  from.optional("pulse_length_s", c.pulse_length_s, 5e-6, kLongestPulse_s);
  read_taper(from, c.chirp, c.tapered_fraction);
  from.optional("bandwidth_hz", c.bandwidth_hz, 0, 500e3);
  read_window(from, c.window);
  from.optional("samples_per_pulse", c.samples_per_pulse, kFewestPerPulse, kMostPerPulse);
  from.optional("range_m", c.range_m, 1, 1000);
  from.optional("electronic_noise_db", c.electronic_noise_db, -200, 150);
  if (from.good() && two_way) c.horizontal_beamwidth_rad = one_way_rad(c.horizontal_beamwidth_rad, c.shading);
  check(from, c);
  return c;
}

echo::Pulse SidescanChannel::pulse(double length_s) const {
  if (chirp) return echo::compressed_chirp(length_s, bandwidth_hz, window);
  return echo::tapered_pulse(length_s, tapered_fraction);
}

SidescanConfig SidescanConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  SidescanConfig c;
  if (from.has("channels")) c.channels.clear();
  std::set<std::string> names;
  for (ConfigReader& channel : from.list("channels")) {
    c.channels.push_back(SidescanChannel::read(channel));
    if (!names.insert(c.channels.back().name).second) channel.problem("name", "is taken by another channel");
  }
  if (c.channels.empty()) from.problem("channels", "needs at least one channel");
  read_head(from, world, process, kFastest_hz, c);
  read_sound_speed(from, c);
  from.optional("bottom_threshold_db", c.bottom_threshold_db, 3, 40);
  for (const SidescanChannel& channel : c.channels) {
    const double samples = c.reception_s(channel.range_m, channel.pulse_length_s) / channel.sample_period_s();
    if (samples > kMostSamples) {
      from.problem("channels", "channel " + channel.name + " makes " + std::to_string(std::llround(samples)) +
                                   " samples a side; at most 100000 are allowed: shorten range_m");
    }
  }
  return c;
}

bool SidescanConfig::operator==(const SidescanConfig& o) const {
  return same_parameters(*this, o) && sound_speed_mps == o.sound_speed_mps && channels == o.channels &&
         bottom_threshold_db == o.bottom_threshold_db;
}

HeadSettings SidescanConfig::start_of(const SidescanChannel& channel) const {
  HeadSettings start = start_at(channel.range_m, channel.source_level_db);
  start.pulse_length_s = channel.pulse_length_s;
  return start;
}

SettingLimits SidescanConfig::limits_of(const SidescanChannel& channel) const {
  SettingLimits limits = limits_up_to(1.0, channel.range_m, channel.source_level_db);
  // Samples come as often as the shortest pulse needs; a chirp's length changes neither resolution nor samples.
  limits.pulse_length_s = {channel.chirp ? kLeastSweep / channel.bandwidth_hz : channel.pulse_length_s,
                           kLongestPulse_s};
  return limits;
}

}  // namespace ensonify
