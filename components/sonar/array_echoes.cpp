#include "components/sonar/array_echoes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ensonify {
namespace {

random::Stream stream_of(const ReceiveArray& array, const char* what) {
  return {array.seed, array.process + "/" + what + array.suffix};
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
  if (!effects.speckle) shared_.emplace(echo::shared_by_beams(array.elements, array.weights.front()));
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

std::span<const echo::Image> ArrayEchoes::beamform(const Shot& shot, const Echoed& echoed, const ShotDesign& design,
                                                   const ArrayReception& reception, Memory& memory) const {
  const auto gains = [&](const echo::Arrivals& arrivals, const echo::PairedArrivals& paired, std::vector<float>& gain) {
    gain.resize(arrivals.size());
    sea_.gains(array_.element, shot.pose(), arrivals, paired, shared_ ? &*shared_ : nullptr, gain);
    return echo::EchoSet{arrivals, gain};
  };
  const std::array sets{gains(echoed.arrivals, echoed.paired, memory.gain),
                        gains(reception.foreign, {}, memory.foreign_gain)};
  memory.coherent_gain.resize(echoed.coherent.size());
  sea_.amplitude_gains(array_.element, shot.pose(), echoed.coherent, memory.coherent_gain);
  const std::array coherent{echo::EchoSet{echoed.coherent, memory.coherent_gain}};
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
