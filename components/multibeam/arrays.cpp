#include "components/multibeam/arrays.h"

#include <algorithm>
#include <cmath>

#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/array/sectors.h"

namespace ensonify {
namespace {

constexpr array::Shading kNoSideLobes{array::Shading::Window::kDolphChebyshev, 60.0};

constexpr double kEdgeReach = 0.1;  // sine from an edge at which its pattern is that of the inside, or nothing

double wavelength_m(const MultibeamConfig& config, double frequency_hz) {
  return config.sound_speed_mps / frequency_hz;
}

/// The edge of a sector at sine 0, whose inside lies at positive sines: one edge of a wide sector.
array::PatternTable edge_pattern() {
  const array::SectorBeam beam = array::sector_beam(1.0, 0.0, 1.0, SectorPattern::kRollOff);
  return {beam.array, 1.0, beam.sin_steer};
}

}  // namespace

ReceiveLine receive_line(const MultibeamConfig& config) {
  ReceiveLine line;
  line.wavelength_m = wavelength_m(config, config.frequency_hz);
  line.whole = array::line_array_of_width(config.receive_beamwidth_rad, line.wavelength_m, config.receive_shading);
  if (!config.effects.side_lobes) line.whole.weights = array::shading_weights(kNoSideLobes, line.whole.elements());
  line.halves = array::split_aperture(line.whole);
  return line;
}

array::LineArray transmit_line(const MultibeamConfig& config) {
  return array::line_array_of_width(config.transmit_beamwidth_rad, wavelength_m(config, config.frequency_hz),
                                    config.transmit_shading);
}

double transmit_null(const MultibeamConfig& config, double frequency_hz) {
  return array::first_null(transmit_line(config), wavelength_m(config, frequency_hz));
}

double transmit_length_in_waves(const MultibeamConfig& config, double frequency_hz) {
  return array::length_in_waves_for(config.transmit_beamwidth_rad) * frequency_hz / config.frequency_hz;
}

double receive_length_in_waves(const MultibeamConfig& config, double frequency_hz) {
  return array::length_in_waves_for(config.receive_beamwidth_rad) * frequency_hz / config.frequency_hz;
}

AreaLengths area_lengths(const MultibeamConfig& config, double frequency_hz) {
  const double wave_m = wavelength_m(config, frequency_hz);
  return {array::effective_length_m(transmit_line(config)) / wave_m,
          array::effective_length_m(receive_line(config).whole) / wave_m};
}

SectorPattern::SectorPattern(const MultibeamConfig& config, double frequency_hz)
    : line_(transmit_line(config), wavelength_m(config, frequency_hz)),
      edge_(edge_pattern()),
      first_null_(config.effects.side_lobes ? 2.0 : transmit_null(config, frequency_hz)),
      behind_(config.effects.directivity ? static_cast<float>(std::pow(10.0, -0.05 * config.back_loss_db)) : 1.0F) {}

float SectorPattern::edge(double sine_inside) const {
  if (sine_inside >= kEdgeReach) return 1.0F;
  const float amplitude = sine_inside > -kEdgeReach ? edge_.amplitude(sine_inside).real() : 0.0F;
  return amplitude * amplitude;
}

float SectorPattern::transmitted_power(const Eigen::Vector3f& direction) const {
  const double along = static_cast<double>(direction.x()) - sector_.sin_transmit;
  if (std::abs(along) > first_null_) return 0.0F;
  const double across = static_cast<double>(direction.y());
  const float front = element_amplitude(direction);
  return line_.power(along) * front * front * edge(across - sector_.lower_sine) * edge(sector_.upper_sine - across);
}

}  // namespace ensonify
