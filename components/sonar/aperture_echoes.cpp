#include "components/sonar/aperture_echoes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/acoustics/echo/noise.h"
#include "kernels/water/noise.h"

namespace ensonify {
namespace {

constexpr float kFarAway_m = std::numeric_limits<float>::infinity();
constexpr double kPatchesPerLobe = 4.0;  // of seabed that answers as one point, across the lobe at the nearest range
constexpr double kVolumeReach = 4.0;     // widths of the narrow lobe, to either side, in which the water is received

double power_of(double level_db) { return std::pow(10.0, 0.1 * level_db); }

double patch_m(const Apertures& a) {
  return std::min(0.5 * a.resolution_m, a.nearest_m * a.narrowest_rad / kPatchesPerLobe);
}

std::string stream_name(const Apertures& a, const char* what) {
  return fmt::format("{}/{:.0f}/{}", a.process, a.frequency_hz, what);
}

/// Of all apertures at once: the fringes between them, finer than any lobe, are averaged.
Arrivals::TransmittedPower all_of(const std::vector<AperturePattern>& patterns) {
  return [patterns](const Eigen::Vector3f& direction, float range_m) {
    double power = 0.0;
    for (const AperturePattern& pattern : patterns) {
      const double amplitude = static_cast<double>(pattern(direction, range_m));
      power += amplitude * amplitude;
    }
    return power;
  };
}

}  // namespace

ApertureEchoes::ApertureEchoes(const Apertures& apertures, const Environment& environment, const Effects& effects,
                               const trace::RayDistribution& rays)
    : apertures_(apertures),
      effects_(effects),
      noise_(apertures.seed, stream_name(apertures, "noise")),
      volume_(apertures.seed, stream_name(apertures, "volume")),
      arrivals_(environment, apertures.frequency_hz, effects, all_of(apertures.patterns.transmit)),
      scatterers_(patch_m(apertures), {apertures.seed, "seabed"}),
      distribution_(rays),
      gains_(apertures.patterns.receive.size()) {
  if (!arrivals_.water_scatters()) return;
  const double reach = std::min(1.0, kVolumeReach * apertures.narrowest_rad);
  const auto transmitted = all_of(apertures.patterns.transmit);
  for (const AperturePattern& pattern : apertures_.patterns.receive) {
    const auto two_way = [&](const Eigen::Vector3f& direction) {
      const double gain = static_cast<double>(pattern(direction, kFarAway_m));
      return transmitted(direction, kFarAway_m) * gain * gain;
    };
    volume_directions_.push_back(
        echo::VolumeDirections::of(two_way, apertures.narrow_axis_head, -reach, reach, 0.1 * apertures.narrowest_rad));
  }
}

echo::Image& ApertureEchoes::receive_echoes(const Emission& emission, const echo::Pulse& pulse,
                                            std::span<const frames::HeadPose> poses, trace::Scene& seabed) {
  arrivals_.move(poses, seconds(emission.event.transmit));
  arrivals_.insonify(seabed, distribution_, emission.event.range_m, rays_, hits_);
  const echo::Sampling sampling{0.0, emission.sample_period_s,
                                static_cast<int>(std::ceil(emission.reception_s / emission.sample_period_s))};
  const echo::SampledPulse sampled(pulse, sampling.period_s);
  arrivals_.receive_echoes(emission.source_level_db, scatterers_, rays_, hits_);
  beamform(arrivals_.add_interference(emission.event.interfering, pulse), sampled, sampling);
  if (arrivals_.water_scatters()) {
    const auto& volume = arrivals_.reverberation_upa2(emission.source_level_db, volume_directions_, pulse, sampling);
    reverberation_.add(volume, sampled, static_cast<std::uint64_t>(emission.event.ping), volume_, image_);
  }
  if (effects_.noise) add_noise(emission, pulse);
  return image_;
}

void ApertureEchoes::beamform(std::span<const echo::Arrival> arrivals, const echo::SampledPulse& pulse,
                              const echo::Sampling& sampling) {
  const double half_speed_mps = 0.5 * arrivals_.sound_speed_mps();
  std::vector<std::span<const float>> rows;
  for (std::size_t row = 0; row < gains_.size(); ++row) {
    const AperturePattern& pattern = apertures_.patterns.receive[row];
    const auto gain = [&](const echo::Arrival& arrival) {
      return pattern(arrival.direction_head, static_cast<float>(half_speed_mps * arrival.time_s));
    };
    arrivals_.gains(gain, gains_[row]);
    rows.push_back(gains_[row]);
  }
  receiver_.form(arrivals, rows, effects_.speckle ? pulse : pulse.squared(), sampling, image_);
  if (effects_.speckle) return;
  for (auto& value : image_.envelope_upa) value = std::sqrt(value.real());
}

void ApertureEchoes::add_noise(const Emission& emission, const echo::Pulse& pulse) {
  const double density_db =
      10.0 * std::log10(power_of(arrivals_.environment().noise_level_db() - apertures_.directivity_index_db) +
                        power_of(apertures_.electronic_noise_db));
  echo::add_noise(water::in_band_level_db(density_db, pulse.noise_bandwidth_hz, 0.0),
                  static_cast<std::uint64_t>(emission.event.ping), noise_, image_);
}

}  // namespace ensonify
