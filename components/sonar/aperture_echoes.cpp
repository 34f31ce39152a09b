#include "components/sonar/aperture_echoes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kernels/acoustics/echo/image.h"
#include "kernels/water/noise.h"

namespace ensonify {
namespace {

constexpr double kPatchesPerLobe = 4.0;  // of seabed that answers as one point, across the lobe at the nearest range
constexpr double kVolumeReach = 4.0;     // widths of the narrow lobe, to either side, in which the water is received

double patch_m(const Apertures& a) {
  return std::min(0.5 * a.resolution_m, a.nearest_m * a.narrowest_rad / kPatchesPerLobe);
}

std::string stream_name(const Apertures& a, const char* what) {
  return fmt::format("{}/{:.0f}/{}", a.process, a.frequency_hz, what);
}

}  // namespace

ApertureEchoes::ApertureEchoes(const Apertures& apertures, std::shared_ptr<const Environment> environment,
                               const Effects& effects, const Quality& quality)
    : apertures_(apertures),
      effects_(effects),
      noise_(apertures.drawn_seed, stream_name(apertures, "noise")),
      volume_(apertures.drawn_seed, stream_name(apertures, "volume")),
      sea_(std::move(environment), apertures.frequency_hz, effects, quality),
      cells_(patch_m(apertures), {apertures.seed, "seabed", apertures.drawn_seed}) {
  if (!sea_.water_scatters()) return;
  const double reach = std::min(1.0, kVolumeReach * apertures.narrowest_rad);
  for (const array::Pattern& pattern : apertures_.patterns.receive) {
    const auto two_way = [&](const Eigen::Vector3f& direction) {
      const auto received = static_cast<double>(pattern.amplitude(direction));
      return array::power(apertures_.patterns.transmit, direction) * received * received;
    };
    volume_directions_.push_back(
        echo::VolumeDirections::of(two_way, apertures.narrow_axis_head, -reach, reach, 0.1 * apertures.narrowest_rad));
  }
}

/// Without speckle the seabed's mean-square pressure is summed, and its root is the envelope before noise.
const echo::Image& ApertureEchoes::beamform(const Shot& shot, const Echoed& echoed, const ShotDesign& design,
                                            const ApertureReception& reception, Memory& memory) const {
  const auto& [ping, sampling, foreign] = reception;
  const std::array sets{weighed(echoed.arrivals, echoed.paired, shot.pose(), memory.gain),
                        weighed(foreign, {}, shot.pose(), memory.foreign_gain)};
  const int rows = static_cast<int>(apertures_.patterns.receive.size());
  if (effects_.speckle) {
    echo::form_apertures(sets, rows, design.sampled, sampling, memory.index, memory.image);
  } else {
    const std::array coherent{weighed_coherent(shot, echoed, memory.coherent_gain)};
    form_mean_squares(sets, std::span(coherent).first(echoed.coherent.empty() ? 0 : 1), rows, design, sampling, memory);
    for (auto& value : memory.image.envelope_upa) value = std::sqrt(std::max(0.0F, value.real()));
  }
  if (sea_.water_scatters()) {
    sea_.reverberation_upa2(shot, echoed, volume_directions_, design.pulse, sampling, memory.volume_upa2);
    memory.background.add_reverberation(memory.volume_upa2, design.sampled, ping, volume_, memory.image);
  }
  if (effects_.noise) memory.background.add_noise(noise_db(design.pulse), design.sampled, ping, noise_, memory.image);
  return memory.image;
}

std::vector<float> ApertureEchoes::expected_background_upa2(const echo::Pulse& pulse, const echo::Sampling& sampling,
                                                            const Memory& memory) const {
  const std::size_t rows = apertures_.patterns.receive.size(), samples = static_cast<std::size_t>(sampling.count);
  const double noise_upa2 = effects_.noise ? power_of(noise_db(pulse)) : 0.0;
  std::vector<float> expected(rows * samples, static_cast<float>(noise_upa2));
  if (!sea_.water_scatters()) return expected;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t k = 0; k < samples; ++k) expected[row * samples + k] += memory.volume_upa2[k * rows + row];
  }
  return expected;
}

echo::EchoSet ApertureEchoes::weighed_coherent(const Shot& shot, const Echoed& echoed, std::vector<float>& gain) const {
  const echo::Arrivals& arrivals = echoed.coherent;
  const auto& patterns = apertures_.patterns.receive;
  gain.resize(patterns.size() * arrivals.size());
  for (std::size_t row = 0; row < patterns.size(); ++row) {
    sea_.amplitude_gains(patterns[row], shot.pose(), arrivals,
                         std::span(gain).subspan(row * arrivals.size(), arrivals.size()));
  }
  return {arrivals, gain};
}

/// Sums of mean squares, and to them those of what has phase without speckle too; in memory.image.
void ApertureEchoes::form_mean_squares(std::span<const echo::EchoSet> echoes, std::span<const echo::EchoSet> coherent,
                                       int rows, const ShotDesign& design, const echo::Sampling& sampling,
                                       Memory& memory) {
  echo::form_apertures(echoes, rows, design.squared, sampling, memory.index, memory.image);
  if (coherent.empty()) return;
  echo::form_apertures(coherent, rows, design.sampled, sampling, memory.index, memory.coherent);
  for (std::size_t i = 0; i < memory.image.envelope_upa.size(); ++i)
    memory.image.envelope_upa[i] += std::norm(memory.coherent.envelope_upa[i]);
}

std::vector<SourceEnergy> ApertureEchoes::energies(const Shot& shot, const Echoed& echoed, const ShotDesign& design,
                                                   const ApertureReception& reception, Memory& memory) const {
  const echo::Sampling& sampling = reception.sampling;
  const std::size_t rows = apertures_.patterns.receive.size(), samples = static_cast<std::size_t>(sampling.count);
  const double noise_upa2 = effects_.noise ? power_of(noise_db(design.pulse)) : 0.0;
  const echo::SampleWindow all{0, sampling.count};
  std::vector<SourceEnergy> energies;
  energies.push_back({SourceEnergy::Source::kNoise, trace::kNoise, all,
                      std::vector<float>(rows * samples, static_cast<float>(noise_upa2))});
  if (sea_.water_scatters()) {
    sea_.reverberation_upa2(shot, echoed, volume_directions_, design.pulse, sampling, memory.volume_upa2);
    SourceEnergy& volume = energies.emplace_back(SourceEnergy{SourceEnergy::Source::kVolume, trace::kNoise, all, {}});
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t k = 0; k < samples; ++k) volume.upa2.push_back(memory.volume_upa2[k * rows + row]);
    }
  }
  const auto form = [&](std::span<const echo::EchoSet> echoes, std::span<const echo::EchoSet> coherent,
                        echo::SampleWindow window) {
    form_mean_squares(echoes, coherent, static_cast<int>(rows), design, window.of(sampling), memory);
    std::vector<float> upa2;
    upa2.reserve(memory.image.envelope_upa.size());
    for (const std::complex<float> value : memory.image.envelope_upa) upa2.push_back(value.real());
    return upa2;
  };
  add_energies(weighed(echoed.arrivals, echoed.paired, shot.pose(), memory.gain),
               weighed_coherent(shot, echoed, memory.coherent_gain),
               weighed(reception.foreign, {}, shot.pose(), memory.foreign_gain), design.sampled, sampling, form,
               energies);
  return energies;
}

echo::EchoSet ApertureEchoes::weighed(const echo::Arrivals& arrivals, const echo::PairedArrivals& paired,
                                      const frames::HeadPose& pose, std::vector<float>& gain) const {
  const auto& patterns = apertures_.patterns.receive;
  gain.resize(patterns.size() * arrivals.size());
  for (std::size_t row = 0; row < patterns.size(); ++row) {
    sea_.gains(patterns[row], pose, arrivals, paired, nullptr,
               std::span(gain).subspan(row * arrivals.size(), arrivals.size()));
  }
  return {arrivals, gain};
}

/// Of one aperture, in its band.
double ApertureEchoes::noise_db(const echo::Pulse& pulse) const {
  const double density_db =
      10.0 * std::log10(power_of(sea_.environment().noise_level_db() - apertures_.directivity_index_db) +
                        power_of(apertures_.electronic_noise_db));
  return water::in_band_level_db(density_db, pulse.noise_bandwidth_hz, 0.0);
}

}  // namespace ensonify
