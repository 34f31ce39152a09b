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
      receiver_(array.elements),
      power_weights_{echo::power_weights(array.weights.front())} {
  if (effects.speckle) return;
  power_receiver_.emplace(echo::power_line(array.elements));
  shared_.emplace(echo::shared_by_beams(array.elements, array.weights.front()));
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

/// Without speckle the seabed's mean-square pressure is summed apart, and its root stands in the background's field.
std::span<const echo::Image> ArrayEchoes::beamform(const Shot& shot, const Echoed& echoed, const ShotDesign& design,
                                                   const ArrayReception& reception, Memory& memory) const {
  const auto gains = [&](const echo::Arrivals& arrivals, const echo::PairedArrivals& paired, std::vector<float>& gain) {
    gain.resize(arrivals.size());
    sea_.gains(array_.element, shot.pose(), arrivals, paired, shared_ ? &*shared_ : nullptr, gain);
    return echo::EchoSet{arrivals, gain};
  };
  const std::array sets{gains(echoed.arrivals, echoed.paired, memory.gain),
                        gains(reception.foreign, {}, memory.foreign_gain)};
  const echo::Background noise = background(shot, echoed, design.pulse, reception, memory.volume_upa2);
  const auto [sampling, beams] = std::pair(reception.sampling, reception.sin_beams);
  memory.images.resize(array_.weights.size());
  if (effects_.speckle) {
    receiver_.form({sets, design.sampled, sampling, noise}, beams, array_.weights, memory.images, memory.receiver);
    return memory.images;
  }
  memory.mean_square.resize(1);
  power_receiver_->form({sets, design.squared, sampling, {}}, beams, power_weights_, memory.mean_square,
                        memory.receiver);
  receiver_.form({{}, design.sampled, sampling, noise}, beams, std::span(array_.weights).first(1),
                 std::span(memory.images).first(1), memory.receiver);
  const auto& mean_square = memory.mean_square[0].envelope_upa;
  auto& envelope = memory.images[0].envelope_upa;
  for (std::size_t i = 0; i < envelope.size(); ++i) envelope[i] += std::sqrt(std::max(0.0F, mean_square[i].real()));
  return std::span(memory.images).first(1);
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
