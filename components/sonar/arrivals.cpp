#include "components/sonar/arrivals.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <cmath>
#include <limits>

#include "components/sonar/head_motion.h"
#include "kernels/acoustics/echo/multipath.h"
#include "kernels/acoustics/trace/reserve.h"

namespace ensonify {
namespace {

constexpr float kFarAway_m = std::numeric_limits<float>::infinity();
constexpr double kInLobe = 0.1;  // -10 dB of the transmission
constexpr std::size_t kRaysPerTask = 4096;

/// What rays hit.
struct HitSums {
  int hits = 0, in_lobe = 0;
  double height_m = 0.0;  // sum of z
};

double power_of(double level_db) { return std::pow(10.0, 0.1 * level_db); }

}  // namespace

Arrivals::Arrivals(const Environment& environment, double frequency_hz, const Effects& effects,
                   TransmittedPower transmitted)
    : environment_(environment),
      frequency_hz_(frequency_hz),
      effects_(effects),
      transmitted_(std::move(transmitted)),
      paths_(environment.profile(), effects.refraction) {}

void Arrivals::move(std::span<const frames::HeadPose> poses, double t_s) {
  water_level_m_ = environment_.water_level_m(t_s);
  poses_.assign(poses.begin(), effects_.motion ? poses.end() : poses.begin() + 1);
  receivers_.set({0.0, seconds(kTrackPeriod), poses_});
}

void Arrivals::insonify(trace::Scene& seabed, trace::RayDistribution& distribution, double range_m,
                        std::vector<trace::Ray>& rays, std::vector<trace::Hit>& hits) {
  paths_.adapt(seabed, transmit_pose(), distribution, range_m);
  paths_.trace(seabed, transmit_pose(), distribution.probes(), range_m, hits);
  distribution.fill(transmit_pose(), hits, seabed.objects(), static_cast<float>(range_m), rays, paths_.refracted());
  paths_.trace(seabed, transmit_pose(), rays, range_m, hits);
  distribution.settle(rays, hits);
  environment_.set_facet_slopes(seabed.facet_mean_square_slope());
}

/// What bubbles under the hull take on the way out and on the way back is the same for all paths.
double Arrivals::sent_db(double source_level_db) const { return source_level_db - 2.0 * environment_.bubble_loss_db(); }

const std::vector<echo::Arrival>& Arrivals::receive_echoes(double source_level_db, echo::Scatterers& scatterers,
                                                           std::span<const trace::Ray> rays,
                                                           std::span<const trace::Hit> hits) {
  set_source_levels(source_level_db, rays, hits);
  const frames::HeadPose& pose = transmit_pose();
  const echo::Carrier carrier{frequency_hz_, absorption_dbpm_, sum()};
  const auto found = scatterers.find({pose, rays, hits, source_upa2m2_, backscatter_});
  arrivals_.clear();
  trace::make_room(arrivals_, (effects_.multipath ? 1 + echo::kMostMultipathEach : 1) * found.size() + 1);
  echo::add_direct_echoes(carrier, pose.position_enu_m, found, receivers_, arrivals_);
  if (effects_.multipath) {
    const echo::MultipathHead head{
        .source_level_db = sent_db(source_level_db),
        .transmit = [this](const Eigen::Vector3f& direction) { return transmitted_(direction, kFarAway_m); }};
    echo::SurfaceMirror surface;
    surface.level_enu_m = water_level_m_;
    surface.sound_speed_mps = sound_speed_mps();
    surface.rms_height_m = environment_.rms_wave_height_m();
    echo::add_multipath(carrier, head, surface, {}, pose, found, receivers_, arrivals_);
  }
  echoes_ = arrivals_.size();
  return arrivals_;
}

const std::vector<echo::Arrival>& Arrivals::add_echoes_of(const echo::InterferingTransmission& other,
                                                          std::span<const echo::Arrival> echoes,
                                                          const echo::Pulse& pulse) {
  if (effects_.interference) echo::add_echoes_of(other, echoes, band(), pulse, arrivals_);
  return arrivals_;
}

const std::vector<echo::Arrival>& Arrivals::add_interference(std::span<const echo::InterferingTransmission> interfering,
                                                             const echo::Pulse& pulse) {
  if (effects_.interference) echo::add_interference(interfering, band(), pulse, receivers_, arrivals_);
  return arrivals_;
}

/// What rays carry to what they hit.
void Arrivals::set_source_levels(double source_level_db, std::span<const trace::Ray> rays,
                                 std::span<const trace::Hit> hits) {
  const double source = power_of(sent_db(source_level_db));
  source_upa2m2_.resize(rays.size());
  backscatter_.resize(rays.size());
  const HitSums sums = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, rays.size(), kRaysPerTask), HitSums{},
      [&](const auto& range, HitSums so_far) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          if (!hits[i].hit()) continue;
          const double transmitted = transmitted_(rays[i].direction_head, hits[i].path_length_m);
          ++so_far.hits;
          so_far.in_lobe += transmitted > kInLobe ? 1 : 0;
          so_far.height_m += hits[i].position_enu_m.z();
          source_upa2m2_[i] = static_cast<float>(source * transmitted);
          backscatter_[i] = environment_.backscatter()(hits[i].sediment, hits[i].sin_grazing);
        }
        return so_far;
      },
      [](const HitSums& a, const HitSums& b) {
        return HitSums{a.hits + b.hits, a.in_lobe + b.in_lobe, a.height_m + b.height_m};
      });
  rays_that_hit_ = sums.hits;
  rays_in_lobe_ = sums.in_lobe;
  const double head_depth_m = -transmit_pose().position_enu_m.z();
  seabed_depth_m_ = sums.hits > 0 ? -sums.height_m / sums.hits : head_depth_m;
  absorption_dbpm_ = effects_.absorption ? environment_.absorption_dbpm(head_depth_m, seabed_depth_m_) : 0.0;
}

const std::vector<float>& Arrivals::reverberation_upa2(double source_level_db,
                                                       std::span<const echo::VolumeDirections> receive_directions,
                                                       const echo::Pulse& pulse, const echo::Sampling& sampling) {
  echo::VolumeLayers layers;
  layers.backscatter_per_m = [this](double depth_m) {
    return power_of(water::volume_scattering_db(environment_.scattering_layers(), depth_m));
  };
  layers.deepest_m = seabed_depth_m_;
  echo::reverberation_upa2(sent_db(source_level_db), absorption_dbpm_, sound_speed_mps(), receive_directions, layers,
                           transmit_pose(), pulse, sampling, volume_upa2_);
  return volume_upa2_;
}

}  // namespace ensonify
