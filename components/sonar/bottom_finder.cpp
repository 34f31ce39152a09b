#include "components/sonar/bottom_finder.h"

#include <cmath>
#include <limits>

#include "kernels/base/profile/profile.h"

namespace ensonify {
namespace {

/// Mean power of the samples between two ranges; 0 without any.
double mean_power(const detect::WaterfallLine& line, double from_m, double to_m) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < line.amplitude.size(); ++k) {
    const double range_m = line.first_range_m + static_cast<double>(k) * line.range_step_m;
    if (range_m < from_m || range_m >= to_m) continue;
    sum += static_cast<double>(line.amplitude[k]) * line.amplitude[k];
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

/// Power of the bottom over that of the water column.
double step_db(const detect::FirstBottomSettings& settings, const detect::WaterfallLine& line, double altitude_m) {
  const double column = mean_power(line, settings.blanking_m, altitude_m);
  const double bottom = mean_power(line, altitude_m, altitude_m + settings.persistence_m);
  return column > 0.0 && bottom > 0.0 ? 10.0 * std::log10(bottom / column) : 0.0;
}

}  // namespace

msg::BottomTrack BottomFinder::find(const echo::Image& envelope, const echo::Sampling& sampling,
                                    const echo::Pulse& pulse, double sound_speed_mps, detect::BottomTrack& track,
                                    Memory& memory) const {
  const profile::Span span(profile::Stage::kDetection);
  auto& [amplitude, all] = memory;
  const auto samples = static_cast<std::size_t>(envelope.samples);
  const double range_per_s = 0.5 * sound_speed_mps;
  detect::FirstBottomSettings settings = settings_;
  settings.echo_m = range_per_s * (pulse.end_s() - pulse.start_s);
  echo::amplitude_upa(envelope, amplitude);
  all.assign(samples, 0.0F);
  msg::BottomTrack found;
  found.beam_travel_time_s = msg::Array<float>({static_cast<std::size_t>(envelope.beams)});
  detect::WaterfallLine line{{}, range_per_s * sampling.start_s, range_per_s * sampling.period_s};
  for (std::size_t beam = 0; beam < static_cast<std::size_t>(envelope.beams); ++beam) {
    line.amplitude = std::span(amplitude).subspan(beam * samples, samples);
    for (std::size_t k = 0; k < samples; ++k) all[k] += line.amplitude[k] * line.amplitude[k];
    const auto pick = detect::first_bottom(settings, line);
    found.beam_travel_time_s[beam] =
        pick.found ? static_cast<float>(pick.altitude_m / range_per_s) : std::numeric_limits<float>::quiet_NaN();
  }
  for (float& power : all) power = std::sqrt(power / static_cast<float>(envelope.beams));
  line.amplitude = all;
  track = detect::follow(settings, track, line);
  found.valid = track.tracked;
  found.altitude_m = track.altitude_m;
  found.travel_time_s = track.altitude_m / range_per_s;
  found.quality_db = track.tracked ? step_db(settings, line, track.altitude_m) : 0.0;
  found.sound_speed_mps = sound_speed_mps;
  return found;
}

}  // namespace ensonify
