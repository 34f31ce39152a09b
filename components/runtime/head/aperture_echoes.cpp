#include "components/runtime/head/aperture_echoes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/runtime/head/head_motion.h"
#include "kernels/echo/multipath.h"
#include "kernels/echo/noise.h"
#include "kernels/water/noise.h"

namespace ensonify {
namespace {

constexpr double kPatchesPerLobe = 4.0;  // of seabed that answers as one point, across the lobe at the nearest range
constexpr double kVolumeReach = 4.0;     // widths of the narrow lobe, to either side, in which the water is heard

double power_of(double level_db) { return std::pow(10.0, 0.1 * level_db); }

double patch_m(const Apertures& a) {
  return std::min(0.5 * a.resolution_m, a.nearest_m * a.narrowest_rad / kPatchesPerLobe);
}

std::string stream_name(const Apertures& a, const char* what) {
  return fmt::format("{}/{:.0f}/{}", a.process, a.frequency_hz, what);
}

}  // namespace

ApertureEchoes::ApertureEchoes(const Apertures& apertures, const Environment& environment, const Effects& effects)
    : apertures_(apertures),
      environment_(environment),
      effects_(effects),
      noise_(apertures.seed, stream_name(apertures, "noise")),
      volume_(apertures.seed, stream_name(apertures, "volume")),
      paths_(environment.profile(), effects.refraction),
      scatterers_(patch_m(apertures), {apertures.seed, "seabed"}),
      gains_(apertures.patterns.size()) {
  if (!effects.volume || environment.scattering_layers().empty()) return;
  const double reach = std::min(1.0, kVolumeReach * apertures.narrowest_rad);
  for (const AperturePattern& pattern : apertures_.patterns) {
    const auto two_way = [&](const Eigen::Vector3f& direction) {
      const double heard = static_cast<double>(pattern(direction));
      return transmitted_power(direction) * heard * heard;
    };
    volume_directions_.push_back(
        echo::VolumeDirections::of(two_way, apertures.narrow_axis_head, -reach, reach, 0.1 * apertures.narrowest_rad));
  }
}

/// Of all apertures at once: the fringes between them, finer than any lobe, are averaged.
double ApertureEchoes::transmitted_power(const Eigen::Vector3f& direction_head) const {
  double power = 0.0;
  for (const AperturePattern& pattern : apertures_.patterns) {
    const double amplitude = static_cast<double>(pattern(direction_head));
    power += amplitude * amplitude;
  }
  return power;
}

void ApertureEchoes::move(std::span<const frames::HeadPose> poses) {
  poses_.assign(poses.begin(), effects_.motion ? poses.end() : poses.begin() + 1);
  receivers_.set({0.0, seconds(kTrackPeriod), poses_});
}

void ApertureEchoes::trace(const trace::Scene& seabed, std::span<const trace::Ray> rays, double range_m,
                           std::vector<trace::Hit>& hits) {
  paths_.trace(seabed, transmit_pose(), rays, range_m, hits);
}

echo::Image& ApertureEchoes::listen(const Emission& emission, const echo::Pulse& pulse,
                                    std::span<const trace::Ray> rays, std::span<const trace::Hit> hits) {
  const echo::Sampling sampling{0.0, emission.sample_period_s,
                                static_cast<int>(std::ceil(emission.listening_s / emission.sample_period_s))};
  const echo::SampledPulse sampled(pulse, sampling.period_s);
  light(emission, rays, hits);
  arrive(emission, rays, hits);
  hear(sampled, sampling);
  add_volume(emission, pulse, sampled, sampling);
  add_noise(emission, pulse);
  return image_;
}

void ApertureEchoes::light(const Emission& emission, std::span<const trace::Ray> rays,
                           std::span<const trace::Hit> hits) {
  // What bubbles under the hull take on the way out and on the way back is the same for all paths.
  const double source = power_of(emission.source_level_db - 2.0 * environment_.bubble_loss_db());
  source_upa2m2_.resize(rays.size());
  backscatter_.resize(rays.size());
  rays_that_hit_ = 0;
  double height_m = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].hit()) continue;
    ++rays_that_hit_;
    height_m += hits[i].position_enu_m.z();
    source_upa2m2_[i] = static_cast<float>(source * transmitted_power(rays[i].direction_head));
    backscatter_[i] = environment_.backscatter()(hits[i].sediment, hits[i].sin_grazing);
  }
  const double head_depth_m = -transmit_pose().position_enu_m.z();
  seabed_depth_m_ = rays_that_hit_ > 0 ? -height_m / rays_that_hit_ : head_depth_m;
  absorption_dbpm_ = effects_.absorption ? environment_.absorption_dbpm(head_depth_m, seabed_depth_m_) : 0.0;
}

void ApertureEchoes::arrive(const Emission& emission, std::span<const trace::Ray> rays,
                            std::span<const trace::Hit> hits) {
  const echo::Carrier carrier{apertures_.frequency_hz, absorption_dbpm_,
                              effects_.speckle ? echo::Sum::kPressure : echo::Sum::kMeanSquare};
  const auto scatterers = scatterers_.find({transmit_pose(), rays, hits, source_upa2m2_, backscatter_});
  arrivals_.clear();
  echo::add_direct_echoes(carrier, transmit_pose().position_enu_m, scatterers, receivers_, arrivals_);
  if (!effects_.multipath) return;
  echo::MultipathHead head;
  head.source_level_db = emission.source_level_db - 2.0 * environment_.bubble_loss_db();
  head.transmit = [this](const Eigen::Vector3f& direction) { return transmitted_power(direction); };
  echo::SurfaceMirror surface;
  surface.sound_speed_mps = paths_.sound_speed_mps(transmit_pose());
  surface.rms_height_m = environment_.rms_wave_height_m();
  echo::add_multipath(carrier, head, surface, {}, transmit_pose(), scatterers, receivers_, arrivals_);
}

void ApertureEchoes::hear(const echo::SampledPulse& pulse, const echo::Sampling& sampling) {
  std::vector<std::span<const float>> rows;
  for (std::size_t row = 0; row < gains_.size(); ++row) {
    gains_[row].resize(arrivals_.size());
    for (std::size_t i = 0; i < arrivals_.size(); ++i) {
      const float gain = apertures_.patterns[row](arrivals_[i].direction_head);
      gains_[row][i] = effects_.speckle ? gain : gain * gain;
    }
    rows.push_back(gains_[row]);
  }
  receiver_.form(arrivals_, rows, effects_.speckle ? pulse : pulse.squared(), sampling, image_);
  if (effects_.speckle) return;
  for (auto& value : image_.envelope_upa) value = std::sqrt(value.real());
}

void ApertureEchoes::add_volume(const Emission& emission, const echo::Pulse& pulse, const echo::SampledPulse& sampled,
                                const echo::Sampling& sampling) {
  if (volume_directions_.empty()) return;
  echo::VolumeLayers layers;
  layers.backscatter_per_m = [this](double depth_m) {
    return power_of(water::volume_scattering_db(environment_.scattering_layers(), depth_m));
  };
  layers.deepest_m = seabed_depth_m_;
  echo::reverberation_upa2(emission.source_level_db - 2.0 * environment_.bubble_loss_db(), absorption_dbpm_,
                           paths_.sound_speed_mps(transmit_pose()), volume_directions_, layers, transmit_pose(), pulse,
                           sampling, volume_upa2_);
  reverberation_.add(volume_upa2_, sampled, static_cast<std::uint64_t>(emission.shot.ping), volume_, image_);
}

void ApertureEchoes::add_noise(const Emission& emission, const echo::Pulse& pulse) {
  if (!effects_.noise) return;
  const double density_db =
      10.0 * std::log10(power_of(environment_.noise_level_db() - apertures_.directivity_index_db) +
                        power_of(apertures_.electronic_noise_db));
  echo::add_noise(water::in_band_level_db(density_db, pulse.noise_bandwidth_hz, 0.0),
                  static_cast<std::uint64_t>(emission.shot.ping), noise_, image_);
}

}  // namespace ensonify
