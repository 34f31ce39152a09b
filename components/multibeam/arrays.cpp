#include "components/multibeam/arrays.h"

#include <algorithm>
#include <cmath>

#include "kernels/acoustics/array/beam_layout.h"
#include "kernels/acoustics/array/line.h"

namespace ensonify {
namespace {

constexpr array::Shading kNoSideLobes{array::Shading::Window::kDolphChebyshev, 60.0};

constexpr double kEdgeReach = 0.1;  // sine from an edge at which its pattern is that of the inside, or nothing

double wavelength_m(const MultibeamConfig& config, double frequency_hz) {
  return config.sound_speed_mps / frequency_hz;
}

ReceiveLine receive_line(const MultibeamConfig& config) {
  ReceiveLine line;
  line.wavelength_m = wavelength_m(config, config.frequency_hz);
  line.whole = array::line_array_of_width(config.receive_beamwidth_rad, line.wavelength_m, config.receive_shading);
  if (!config.effects.side_lobes) line.whole.weights = array::shading_weights(kNoSideLobes, line.whole.elements());
  line.halves = array::split_aperture(line.whole);
  return line;
}

/// One edge of a wide sector.
std::shared_ptr<const array::PatternTable> edge_pattern(double error) {
  const array::SectorBeam beam = array::sector_beam(1.0, 0.0, 1.0, SectorPattern::kRollOff);
  return std::make_shared<array::PatternTable>(beam.array, 1.0, beam.sin_steer, error);
}

}  // namespace

ArrayDesign::ArrayDesign(const MultibeamConfig& config)
    : transmit(array::line_array_of_width(config.transmit_beamwidth_rad, wavelength_m(config, config.frequency_hz),
                                          config.transmit_shading)),
      receive(receive_line(config)),
      edge(edge_pattern(config.quality.pattern_error())) {
  const double transmit_m = array::effective_length_m(transmit), receive_m = array::effective_length_m(receive.whole);
  area = {transmit_m / receive.wavelength_m, receive_m / receive.wavelength_m};
  const double sent_in_waves = array::length_in_waves_for(config.transmit_beamwidth_rad);
  const double received_in_waves = array::length_in_waves_for(config.receive_beamwidth_rad);
  const double apart_in_waves = receive.halves.baseline_m / receive.wavelength_m;
  for (const auto& sector : config.all_sectors()) {
    const double frequency_hz = sector.frequency_hz, wave_m = wavelength_m(config, frequency_hz);
    sectors.push_back(
        {.frequency_hz = frequency_hz,
         .delay_s = sector.delay_s,
         .wavelength_m = wave_m,
         .transmit_in_waves = sent_in_waves * frequency_hz / config.frequency_hz,
         .receive_in_waves = received_in_waves * frequency_hz / config.frequency_hz,
         .area = {transmit_m / wave_m, receive_m / wave_m},
         .transmit_null = array::first_null(transmit, wave_m),
         .phase_centres_in_waves = apart_in_waves * frequency_hz / config.frequency_hz,
         .transmit = std::make_shared<array::PatternTable>(transmit, wave_m, 0.0, config.quality.pattern_error())});
  }
}

SectorPattern::SectorPattern(const MultibeamConfig& config, const ArrayDesign& design, std::size_t sector)
    : line_(design.sectors[sector].transmit),
      edge_(design.edge),
      end_(static_cast<float>(config.effects.side_lobes ? 2.0 : design.sectors[sector].transmit_null)),
      face_{.face = array::Face(0.0, config.effects.directivity ? config.back_loss_db : 0.0)} {}

void SectorPattern::steer(const SteeredSector& sector, array::Pattern& transmit) const {
  transmit.clear();
  transmit.times_power(array::LineFactor{.table = line_, .sin_steer = sector.sin_transmit, .end = end_})
      .times_power(face_)
      .times_power(array::EdgeFactor{edge_, sector.lower_sine, true, kEdgeReach})
      .times_power(array::EdgeFactor{edge_, sector.upper_sine, false, kEdgeReach});
}

array::Pattern SectorPattern::element() const { return array::Pattern().times(face_); }

double SectorPattern::noise_share() const {
  const double behind = face_.face.amplitude(-1.0);
  return 0.5 * (1.0 + behind * behind);
}

}  // namespace ensonify
