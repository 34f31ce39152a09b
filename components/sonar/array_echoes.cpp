#include "components/sonar/array_echoes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace ensonify {
namespace {

random::Stream stream_of(const ReceiveArray& array, const char* what) {
  return {array.seed, array.process + "/" + what + array.suffix};
}

/// A beam's amplitude by sine off its axis.
array::PatternTable beam_pattern(const echo::ElementLine& line, std::span<const float> weights) {
  const double middle = 0.5 * static_cast<double>(weights.size() - 1);
  const auto pattern = [&](double sine) {
    std::complex<double> sum;
    for (std::size_t m = 0; m < weights.size(); ++m) {
      const double turns = line.spacing_in_waves * (static_cast<double>(m) - middle) * sine;
      sum += static_cast<double>(weights[m]) * std::polar(1.0, 2.0 * std::numbers::pi * turns);
    }
    return sum;
  };
  return {pattern, std::max(line.spacing_in_waves * middle, 0.5)};
}

}  // namespace

ArrayEchoes::ArrayEchoes(const ReceiveArray& array, std::shared_ptr<const Environment> environment,
                         const Effects& effects, const Quality& quality)
    : array_(array),
      effects_(effects),
      sea_(std::move(environment), array.frequency_hz, effects, quality),
      ambient_(stream_of(array, "noise")),
      electronic_(stream_of(array, "electronic")),
      volume_(stream_of(array, "volume")),
      receiver_(array.elements, !effects.speckle) {
  const echo::Sum sum = effects.speckle ? echo::Sum::kPressure : echo::Sum::kMeanSquare;
  for (const std::vector<float>& weights : array.weights) wanted_.emplace_back(weights, sum);
  if (effects.speckle) return;
  shared_.emplace(echo::shared_by_beams(array.elements, array.weights.front()));
  beam_.emplace(beam_pattern(array.elements, array.weights.front()));
}

std::vector<echo::VolumeDirections> ArrayEchoes::volume_directions(
    const std::function<double(const Eigen::Vector3f& direction_head)>& transmitted, double step_rad) const {
  if (!sea_.water_scatters()) return {};
  const auto two_way = [&](const Eigen::Vector3f& direction) {
    const auto received = static_cast<double>(array_.element.amplitude(direction));
    return transmitted(direction) * received * received;
  };
  return echo::directions_of_cells(receiver_, two_way, step_rad);
}

echo::EchoSet ArrayEchoes::weighed(const Shot& shot, const echo::Arrivals& arrivals, const echo::PairedArrivals& paired,
                                   std::vector<float>& gain) const {
  gain.resize(arrivals.size());
  sea_.gains(array_.element, shot.pose(), arrivals, paired, shared_ ? &*shared_ : nullptr, gain);
  return {arrivals, gain};
}

echo::EchoSet ArrayEchoes::weighed_coherent(const Shot& shot, const Echoed& echoed, std::vector<float>& gain) const {
  gain.resize(echoed.coherent.size());
  sea_.amplitude_gains(array_.element, shot.pose(), echoed.coherent, gain);
  return {echoed.coherent, gain};
}

std::span<const echo::Image> ArrayEchoes::beamform(const Shot& shot, const Echoed& echoed, const ShotDesign& design,
                                                   const ArrayReception& reception, Memory& memory) const {
  const std::array sets{weighed(shot, echoed.arrivals, echoed.paired, memory.gain),
                        weighed(shot, reception.foreign, {}, memory.foreign_gain)};
  const std::array coherent{weighed_coherent(shot, echoed, memory.coherent_gain)};
  const echo::Background noise = background(shot, echoed, design.pulse, reception, memory.volume_upa2);
  memory.images.resize(wanted_.size());
  receiver_.form({.echoes = sets,
                  .pulse = design.sampled,
                  .sampling = reception.sampling,
                  .background = noise,
                  .squared = &design.squared,
                  .amplitude_upa = reception.amplitude_upa,
                  .coherent = std::span(coherent).first(echoed.coherent.empty() ? 0 : 1)},
                 reception.sin_beams, wanted_, memory.images, memory.receiver);
  return memory.images;
}

std::vector<SourceEnergy> ArrayEchoes::energies(const Shot& shot, const Echoed& echoed, const ShotDesign& design,
                                                const ArrayReception& reception, Memory& memory) const {
  const echo::Background noise = background(shot, echoed, design.pulse, reception, memory.volume_upa2);
  std::vector<SourceEnergy> energies{noise_energy(noise, reception)};
  if (noise.volume) energies.push_back(volume_energy(noise, reception));
  const auto form = [&](std::span<const echo::EchoSet> echoes, std::span<const echo::EchoSet> coherent,
                        echo::SampleWindow window) {
    memory.images.resize(1);
    receiver_.form({.echoes = echoes,
                    .pulse = design.sampled,
                    .sampling = window.of(reception.sampling),
                    .squared = &design.squared,
                    .coherent = coherent},
                   reception.sin_beams, {&wanted_.front(), 1}, {memory.images.data(), 1}, memory.receiver);
    std::vector<float> upa2;
    upa2.reserve(memory.images.front().envelope_upa.size());
    for (const std::complex<float> value : memory.images.front().envelope_upa) upa2.push_back(std::norm(value));
    return upa2;
  };
  add_energies(
      weighed(shot, echoed.arrivals, echoed.paired, memory.gain), weighed_coherent(shot, echoed, memory.coherent_gain),
      weighed(shot, reception.foreign, {}, memory.foreign_gain), design.sampled, reception.sampling, form, energies);
  return energies;
}

SourceEnergy ArrayEchoes::noise_energy(const echo::Background& noise, const ArrayReception& reception) const {
  const int samples = reception.sampling.count;
  SourceEnergy energy{SourceEnergy::Source::kNoise, trace::kNoise, {0, samples}, {}};
  const echo::WantedImage& image = wanted_.front();
  for (const float sine : reception.sin_beams) {
    const double squares = image.power_weights[image.power_weights.size() / 2];  // of the weights
    const double upa2 = noise.isotropic_upa2 * receiver_.isotropic_power(image, static_cast<double>(sine)) +
                        noise.electronic_upa2 * squares;
    energy.upa2.insert(energy.upa2.end(), static_cast<std::size_t>(samples), static_cast<float>(upa2));
  }
  return energy;
}

/// Out to some side lobes; as the water's level varies little beyond, the rest of a beam's power is counted in there.
SourceEnergy ArrayEchoes::volume_energy(const echo::Background& noise, const ArrayReception& reception) const {
  constexpr double kLobes = 10.0;
  const int samples = reception.sampling.count, cells = receiver_.cells();
  const echo::ElementLine& line = receiver_.line();
  const double length_in_waves = line.elements * line.spacing_in_waves, period = 1.0 / line.spacing_in_waves;
  const auto reach = static_cast<int>(std::min(0.5, kLobes / length_in_waves / period) * cells);
  const double all =
      cells * static_cast<double>(wanted_.front().power_weights[wanted_.front().power_weights.size() / 2]);
  SourceEnergy energy{SourceEnergy::Source::kVolume, trace::kNoise, {0, samples}, {}};
  energy.upa2.resize(reception.sin_beams.size() * static_cast<std::size_t>(samples));
  tbb::parallel_for(std::size_t{0}, reception.sin_beams.size(), [&](std::size_t beam) {
    const auto axis = static_cast<double>(reception.sin_beams[beam]);
    const int middle = static_cast<int>(std::floor((axis - receiver_.cell_sine(0)) / period * cells + 0.5));
    std::vector<std::size_t> which;
    std::vector<float> power;
    double sum = 0.0;
    for (int step = -reach; step < reach; ++step) {
      const int cell = ((middle + step) % cells + cells) % cells;
      const double off = std::remainder(receiver_.cell_sine(cell) - axis, period);
      which.push_back(static_cast<std::size_t>(cell));
      power.push_back(std::norm(beam_->amplitude(off)));
      sum += static_cast<double>(power.back());
    }
    for (float& one : power) one *= static_cast<float>(all / sum);
    for (std::size_t k = 0; k < static_cast<std::size_t>(samples); ++k) {
      const float* const mean_square = noise.volume_upa2.data() + k * static_cast<std::size_t>(cells);
      float upa2 = 0.0F;
      for (std::size_t i = 0; i < which.size(); ++i) upa2 += power[i] * mean_square[which[i]];
      energy.upa2[beam * static_cast<std::size_t>(samples) + k] = upa2;
    }
  });
  return energy;
}

std::vector<float> ArrayEchoes::expected_background_upa2(const echo::Pulse& pulse, const ArrayReception& reception,
                                                         const label::MainLobe& lobe, const Memory& memory) const {
  double per_element_upa2 = 0.0;
  if (effects_.noise) {
    const double density = power_of(sea_.environment().noise_level_db()) * array_.noise_share;
    per_element_upa2 = (density + power_of(array_.electronic_noise_db)) * pulse.noise_bandwidth_hz;
  }
  double squares = 0.0;  // of the weights: what is left of noise that elements do not have in common
  for (const float weight : wanted_.front().weights)
    squares += static_cast<double>(weight) * static_cast<double>(weight);
  const auto samples = static_cast<std::size_t>(reception.sampling.count), beams = reception.sin_beams.size();
  std::vector<float> expected(beams * samples, static_cast<float>(per_element_upa2 * squares));
  if (!sea_.water_scatters()) return expected;
  const auto cells = static_cast<std::size_t>(receiver_.cells());
  for (std::size_t beam = 0; beam < beams; ++beam) {
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const double off = receiver_.cell_sine(static_cast<int>(cell)) - static_cast<double>(reception.sin_beams[beam]);
      const float power = lobe.at(off);
      if (power <= 0.0F) continue;
      for (std::size_t k = 0; k < samples; ++k)
        expected[beam * samples + k] += power * memory.volume_upa2[k * cells + cell];
    }
  }
  return expected;
}

echo::Background ArrayEchoes::background(const Shot& shot, const Echoed& echoed, const echo::Pulse& pulse,
                                         const ArrayReception& reception, std::vector<float>& volume_upa2) const {
  echo::Background background;
  background.ping = reception.ping;
  if (effects_.noise) {
    background.isotropic_upa2 =
        power_of(sea_.environment().noise_level_db()) * pulse.noise_bandwidth_hz * array_.noise_share;
    background.isotropic = &ambient_;
    background.electronic_upa2 = power_of(array_.electronic_noise_db) * pulse.noise_bandwidth_hz;
    background.electronic = &electronic_;
  }
  if (sea_.water_scatters()) {
    sea_.reverberation_upa2(shot, echoed, reception.volume, pulse, reception.sampling, volume_upa2);
    background.volume_upa2 = volume_upa2;
    background.volume = &volume_;
  }
  return background;
}

}  // namespace ensonify
