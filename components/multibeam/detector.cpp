#include "components/multibeam/detector.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "kernels/base/profile/profile.h"

namespace ensonify {
namespace {

/// Angle in the plane across the track between the head's z axis and the vertical: where a level seabed lies for it.
double seabed_tilt_rad(const frames::HeadPose& head) {
  const frames::Vec3 down = head.enu_from_head.conjugate() * -frames::Vec3::UnitZ();
  return std::atan2(down.y(), down.z());
}

}  // namespace

Detector::Detector(const MultibeamConfig& config, const ArrayDesign& arrays)
    : config_(config), sectors_(arrays.sectors) {}

detect::Settings Detector::settings_of(const InstrumentPing& ping, double echo_s) const {
  detect::Settings settings;
  settings.gates.snr_db = config_.detection_threshold_db;
  settings.gates.min_range_m = config_.least_range_m;
  settings.max_detections = config_.detections_per_beam;
  settings.second_echo.refused = config_.refuse_second_echo;
  settings.pulse_length_s = echo_s;
  settings.absorption_dbpm = ping.settings.gain_absorption_dbpm;
  settings.sound_speed_mps = ping.steering.sound_speed_mps;
  if (!ping.estimate.empty()) {
    const frames::HeadPose head = ping.head_pose(config_.mounting.measured, ping.event.transmit);
    settings.seabed_tilt_rad = seabed_tilt_rad(head);
    const double water_level_m = config_.world->vertical.tide.at(seconds(ping.event.transmit)).height_m;
    settings.second_echo.head_depth_m = std::max(water_level_m - head.position_enu_m.z(), 0.0);
  }
  return settings;
}

Detected Detector::detect(const InstrumentPing& ping, std::span<const SectorBeams> received, Memory& memory) const {
  const profile::Span span(profile::Stage::kDetection);
  const Steering& steering = ping.steering;
  detect::Settings settings = settings_of(ping, received.front().echo_s);
  std::vector<detect::Detection>& detections = memory.detections;
  std::vector<Echo> echoes;
  std::size_t first = 0;  // place of the sector's first sounding
  for (std::size_t sector = 0; sector < sectors_.size(); ++sector) {
    settings.receive_length_in_waves = sectors_[sector].receive_in_waves;
    settings.phase_centres_in_waves = sectors_[sector].phase_centres_in_waves;
    const SteeredSector& beams = steering.sectors[sector];
    const auto begin = steering.beam_of_sounding.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = std::lower_bound(begin, steering.beam_of_sounding.end(), beams.first_beam + beams.beams);
    const auto count = static_cast<std::size_t>(end - begin);
    const auto sines = std::span(steering.sin_soundings).subspan(first, count);
    const SectorBeams& as_formed = received[sector];
    const SectorBeams at = steering.high_density()
                               ? at_places(steering, sector, as_formed,
                                           std::span(steering.beam_of_sounding).subspan(first, count), sines, memory)
                               : as_formed;
    detect::detect_bottom(settings, sines, at.image, at.halves, detections);
    for (std::size_t i = 0; i < detections.size(); ++i) {
      const auto place = static_cast<int>(first + i / static_cast<std::size_t>(settings.max_detections));
      const auto detection = static_cast<int>(i % static_cast<std::size_t>(settings.max_detections));
      if (detection > 0 && !detections[i].valid) continue;
      echoes.push_back({steering.beam_of_sounding[static_cast<std::size_t>(place)], detection, static_cast<int>(sector),
                        place, detections[i]});
    }
    first += count;
  }
  return {std::move(echoes), received.front().echo_s, received.front().image.period_s};
}

/// The beams nearest to places in the swath, their halves turned from their axes to these places: what turns is the
/// phase between the halves, what the beams receive stays.
SectorBeams Detector::at_places(const Steering& steering, std::size_t sector, const SectorBeams& beams,
                                std::span<const int> beam_of_place, std::span<const float> sin_places,
                                Memory& memory) const {
  auto& amplitude_upa = memory.amplitude_upa;
  auto &positive_upa = memory.positive_upa, &negative_upa = memory.negative_upa;
  const auto samples = static_cast<std::size_t>(beams.image.samples), count = sin_places.size();
  const bool phase = !beams.halves.positive_upa.empty();
  amplitude_upa.resize(count * samples);
  positive_upa.resize(phase ? count * samples : 0);
  negative_upa.resize(positive_upa.size());
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const auto beam = static_cast<std::size_t>(beam_of_place[i]);
    const std::size_t from = (beam - static_cast<std::size_t>(steering.sectors[sector].first_beam)) * samples;
    const auto to = static_cast<std::ptrdiff_t>(i * samples);
    std::ranges::copy(beams.image.amplitude_upa.subspan(from, samples), amplitude_upa.begin() + to);
    if (!phase) return;
    std::ranges::copy(beams.halves.negative_upa.subspan(from, samples), negative_upa.begin() + to);
    const double off_axis = static_cast<double>(sin_places[i]) - static_cast<double>(steering.sin_beams[beam]);
    const std::complex<float> turn(
        std::polar(1.0, -2.0 * std::numbers::pi * sectors_[sector].phase_centres_in_waves * off_axis));
    std::ranges::transform(beams.halves.positive_upa.subspan(from, samples), positive_upa.begin() + to,
                           [&](std::complex<float> value) { return value * turn; });
  });
  SectorBeams at = beams;
  at.image.beams = static_cast<int>(count);
  at.image.amplitude_upa = amplitude_upa;
  at.halves = {positive_upa, negative_upa};
  return at;
}

}  // namespace ensonify
