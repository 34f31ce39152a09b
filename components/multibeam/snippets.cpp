#include "components/multibeam/snippets.h"

#include <algorithm>
#include <cmath>

#include "kernels/acoustics/detect/seabed_image.h"

namespace ensonify {
namespace {

/// Two-way time of the nearest sounding; 0 without any.
double nearest_s(const msg::Soundings& soundings) {
  double nearest = 0.0;
  for (std::size_t i = 0; i < soundings.valid.size(); ++i) {
    if (soundings.valid[i] == 0) continue;
    const auto time = static_cast<double>(soundings.travel_time_s[i]);
    if (nearest == 0.0 || time < nearest) nearest = time;
  }
  return nearest;
}

}  // namespace

msg::Snippets snippets_of(std::span<const SectorBeams> received, const Steering& steering, std::span<const Echo> echoes,
                          const msg::Soundings& soundings) {
  std::vector<std::uint16_t> beams;
  std::vector<float> first_s, samples;
  std::vector<std::uint32_t> centres, offsets{0};
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    if (soundings.valid[i] == 0) continue;
    const Echo& echo = echoes[i];
    const detect::Amplitudes& image = received[static_cast<std::size_t>(echo.sector)].image;
    const int row = echo.beam - steering.sectors[static_cast<std::size_t>(echo.sector)].first_beam;
    const int first = echo.measured.snippet_first, count = echo.measured.snippet_count;
    const auto snippet = image.amplitude_upa.subspan(
        static_cast<std::size_t>(row) * static_cast<std::size_t>(image.samples) + static_cast<std::size_t>(first),
        static_cast<std::size_t>(count));
    const long centre = std::lround((echo.measured.two_way_s - image.start_s) / image.period_s) - first;
    beams.push_back(static_cast<std::uint16_t>(echo.beam));
    first_s.push_back(static_cast<float>(first * image.period_s));
    centres.push_back(static_cast<std::uint32_t>(std::clamp(centre, 0L, std::max(count - 1L, 0L))));
    samples.insert(samples.end(), snippet.begin(), snippet.end());
    offsets.push_back(static_cast<std::uint32_t>(samples.size()));
  }
  msg::Snippets message;
  message.stamp_ns = soundings.stamp_ns;
  message.ping = soundings.ping;
  message.sample_period_s = soundings.sample_period_s;
  message.beam = msg::Array<std::uint16_t>::of(beams);
  message.first_sample_s = msg::Array<float>::of(first_s);
  message.centre = msg::Array<std::uint32_t>::of(centres);
  message.offset = msg::Array<std::uint32_t>::of(offsets);
  message.amplitude_upa = msg::Array<float>::of(samples);
  return message;
}

msg::SeabedImage seabed_image_of(const MultibeamConfig& config, const HeadSettings& settings, const Steering& steering,
                                 const SectorBeams& received, const AreaLengths& lines, const msg::Snippets& snippets,
                                 const msg::Soundings& soundings) {
  const auto sectors = config.all_sectors();
  detect::FlatteningModel model;
  model.source_level_db = settings.source_level_db;
  model.pulse_length_s = received.echo_s;
  model.sound_speed_mps = steering.sound_speed_mps;
  model.absorption_dbpm = settings.gain_absorption_dbpm;
  model.nearest_range_m = 0.5 * nearest_s(soundings) * steering.sound_speed_mps;
  model.normal_excess_db = config.image.normal_strength_db - config.image.oblique_strength_db;
  model.crossover_rad = config.image.crossover_rad;

  msg::SeabedImage message;
  message.stamp_ns = snippets.stamp_ns;
  message.ping = snippets.ping;
  message.sample_period_s = snippets.sample_period_s;
  message.beam = snippets.beam;
  message.first_sample_s = snippets.first_sample_s;
  message.centre = snippets.centre;
  message.offset = snippets.offset;
  message.strength_db = msg::Array<float>({snippets.amplitude_upa.size()});
  for (std::size_t i = 0; i < snippets.beam.size(); ++i) {
    const auto& sector = sectors[steering.beam_sector[snippets.beam[i]]];
    model.transmit_length_in_waves = lines.transmit_in_waves * sector.frequency_hz / config.frequency_hz;
    model.receive_length_in_waves = lines.receive_in_waves * sector.frequency_hz / config.frequency_hz;
    const std::size_t from = snippets.offset[i], count = snippets.offset[i + 1] - from;
    // A sample holds the echoes that began within a tone before it, or those of chirps about it.
    const double first_s = static_cast<double>(snippets.first_sample_s[i]) - sector.delay_s - received.middle_s;
    const double step_s = snippets.sample_period_s;
    detect::seabed_image_db(model, snippets.amplitude_upa.flat().subspan(from, count),
                            0.5 * std::max(first_s, step_s) * steering.sound_speed_mps,
                            0.5 * step_s * steering.sound_speed_mps, message.strength_db.flat().subspan(from, count));
  }
  message.spreading_db = 40.0;
  message.absorption_dbpm = model.absorption_dbpm;
  message.normal_incidence_range_m = model.nearest_range_m;
  message.normal_incidence_strength_db = config.image.normal_strength_db;
  message.oblique_strength_db = config.image.oblique_strength_db;
  message.crossover_angle_rad = config.image.crossover_rad;
  message.lambert_removed = true;
  return message;
}

}  // namespace ensonify
