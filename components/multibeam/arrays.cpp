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
array::PatternTable edge_pattern() {
  const array::SectorBeam beam = array::sector_beam(1.0, 0.0, 1.0, SectorPattern::kRollOff);
  return {beam.array, 1.0, beam.sin_steer};
}

}  // namespace

ArrayDesign::ArrayDesign(const MultibeamConfig& config)
    : transmit(array::line_array_of_width(config.transmit_beamwidth_rad, wavelength_m(config, config.frequency_hz),
                                          config.transmit_shading)),
      receive(receive_line(config)),
      edge(edge_pattern()) {
  const double transmit_m = array::effective_length_m(transmit), receive_m = array::effective_length_m(receive.whole);
  area = {transmit_m / receive.wavelength_m, receive_m / receive.wavelength_m};
  const double sent_in_waves = array::length_in_waves_for(config.transmit_beamwidth_rad);
  const double received_in_waves = array::length_in_waves_for(config.receive_beamwidth_rad);
  const double apart_in_waves = receive.halves.baseline_m / receive.wavelength_m;
  for (const auto& sector : config.all_sectors()) {
    const double frequency_hz = sector.frequency_hz, wave_m = wavelength_m(config, frequency_hz);
    sectors.push_back({.frequency_hz = frequency_hz,
                       .delay_s = sector.delay_s,
                       .wavelength_m = wave_m,
                       .transmit_in_waves = sent_in_waves * frequency_hz / config.frequency_hz,
                       .receive_in_waves = received_in_waves * frequency_hz / config.frequency_hz,
                       .area = {transmit_m / wave_m, receive_m / wave_m},
                       .transmit_null = array::first_null(transmit, wave_m),
                       .phase_centres_in_waves = apart_in_waves * frequency_hz / config.frequency_hz,
                       .transmit = {transmit, wave_m}});
  }
}

SectorPattern::SectorPattern(const MultibeamConfig& config, const ArrayDesign& design, std::size_t sector)
    : line_(design.sectors[sector].transmit),
      edge_(design.edge),
      first_null_(config.effects.side_lobes ? 2.0 : design.sectors[sector].transmit_null),
      behind_(config.effects.directivity ? static_cast<float>(std::pow(10.0, -0.05 * config.back_loss_db)) : 1.0F) {}

float SectorPattern::edge(double sine_inside) const {
  if (sine_inside >= kEdgeReach) return 1.0F;
  const float amplitude = sine_inside > -kEdgeReach ? edge_.amplitude(sine_inside).real() : 0.0F;
  return amplitude * amplitude;
}

float SectorPattern::transmitted_power(const Eigen::Vector3f& direction, const SteeredSector& sector) const {
  const double along = static_cast<double>(direction.x()) - sector.sin_transmit;
  if (std::abs(along) > first_null_) return 0.0F;
  const double across = static_cast<double>(direction.y());
  const float front = element_amplitude(direction);
  return line_.power(along) * front * front * edge(across - sector.lower_sine) * edge(sector.upper_sine - across);
}

}  // namespace ensonify
