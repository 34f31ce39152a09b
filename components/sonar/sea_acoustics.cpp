#include "components/sonar/sea_acoustics.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/parallel_reduce.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "components/sonar/head_motion.h"
#include "kernels/acoustics/echo/eigenray_echoes.h"

namespace ensonify {
namespace {

constexpr double kInLobe = 0.1;  // -10 dB of the transmission
constexpr std::size_t kRaysPerTask = 4096, kArrivalsPerTask = 4096;

array::Directions part_of(const trace::VectorColumns<float>& directions, std::size_t first, std::size_t count) {
  return array::Directions{directions.x, directions.y, directions.z}.part(first, count);
}

std::optional<double> mean_depth_m(const trace::Hits& hits) {
  double height_m = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits.hit(i)) continue;
    height_m += hits.position_enu_m.z[i];
    ++count;
  }
  return count > 0 ? std::optional(-height_m / count) : std::nullopt;
}

}  // namespace

std::optional<double> altitude_m(const trace::Scene& seabed, const frames::HeadPose& head) {
  const auto height_m = seabed.height_m(head.position_enu_m.head<2>());
  if (!height_m || *height_m > head.position_enu_m.z()) return std::nullopt;
  return head.position_enu_m.z() - *height_m;
}

std::string no_echo_reason(const TraceSummary& trace_summary) {
  if (trace_summary.rays_in_lobe > 0) return "";
  if (!trace_summary.altitude_m) {
    return fmt::format("nothing within the range of {:.1f} m, and no seabed below the head: the terrain has a hole",
                       trace_summary.range_m);
  }
  if (*trace_summary.altitude_m > trace_summary.range_m) {
    return fmt::format("the range of {:.1f} m is below the altitude of {:.1f} m", trace_summary.range_m,
                       *trace_summary.altitude_m);
  }
  return fmt::format(
      "nothing within the range of {:.1f} m where the head points{}: it points over the seabed {:.1f} m "
      "below, or is mounted or tilted the wrong way",
      trace_summary.range_m, trace_summary.rays_that_hit > 0 ? " (side lobes hit something)" : "",
      *trace_summary.altitude_m);
}

SeaAcoustics::SeaAcoustics(std::shared_ptr<const Environment> environment, double frequency_hz, const Effects& effects,
                           const Quality& quality)
    : environment_(std::move(environment)),
      frequency_hz_(frequency_hz),
      effects_(effects),
      exact_(quality.reference),
      paths_(environment_->profile(), effects.refraction, exact_) {}

Insonified SeaAcoustics::insonify(const Shot& shot, const trace::Mesh& seabed,
                                  const trace::RayDistribution& distribution, const echo::SpeckleCells& cells,
                                  double range_m, ShotMemory& memory) const {
  const frames::HeadPose& pose = shot.pose();
  const refraction::PathTable* refracted = paths_.tabulate(seabed, pose, range_m, memory.paths);
  const auto trace = [&](const trace::Rays& rays, trace::Hits& hits) {
    paths_.trace(seabed, pose, rays, range_m, refracted, hits);
  };
  // Rays to the seabed are planned as if no body stood there, and losses follow from its depth alone: with or without
  // a body, echoes of all the rest are the same.
  std::optional<double> seabed_depth_m;
  const auto probe = [&](const trace::Rays& rays, trace::Hits& hits) {
    paths_.trace(seabed, pose, rays, range_m, refracted, hits, trace::kAllBodies);
    seabed_depth_m = mean_depth_m(hits);
  };
  const double wavelength_m = sound_speed_mps(pose) / frequency_hz_;
  distribution.aim(pose, shot.steer, {seabed, wavelength_m, cells.cell_m()}, static_cast<float>(range_m), refracted,
                   probe, memory.plan);

  const seabed::ClassTables& backscatter =
      environment_->backscatter(seabed.facet_mean_square_slope(), memory.facet_laws);
  HitSums sums;
  memory.insonified.clear();
  memory.bodies.clear();
  // While one batch is merged the next ones are traced. Merged are they in their order, whoever is ready first.
  std::size_t next = 0;
  const std::size_t batches = (memory.plan.rays() + shot.rays_per_batch - 1) / shot.rays_per_batch;
  const std::size_t ahead =
      profile::measured() ? 1 : ShotMemory::kAhead;  // stages that overlap have no processor time of their own
  tbb::parallel_pipeline(ahead, tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order,
                                                                    [&](tbb::flow_control& flow) {
                                                                      if (next == batches) flow.stop();
                                                                      return next == batches ? next : next++;
                                                                    }) &
                                    tbb::make_filter<std::size_t, ShotMemory::OfBatch*>(
                                        tbb::filter_mode::parallel,
                                        [&](std::size_t number) {
                                          ShotMemory::OfBatch& own = memory.batches[number % ShotMemory::kAhead];
                                          distribution.trace(memory.plan, number * shot.rays_per_batch,
                                                             shot.rays_per_batch, trace, own.batch);
                                          weigh(shot, backscatter, seabed.contributors(), own);
                                          find_parts(pose, cells, own);
                                          return &own;
                                        }) &
                                    tbb::make_filter<ShotMemory::OfBatch*, void>(
                                        tbb::filter_mode::serial_in_order, [&](ShotMemory::OfBatch* own) {
                                          sums = sums + own->sums;
                                          const profile::Span span(profile::Stage::kMerge);
                                          const echo::Insonification batch = own->insonification(pose);
                                          echo::take_bodies(batch, own->batch.to_bodies,
                                                            2.0 * std::numbers::pi / wavelength_m, cells.responses(),
                                                            own->batch.hits, memory.bodies);
                                          cells.add(batch, own->parts, memory.insonified);
                                        }));
  const profile::Span span(profile::Stage::kMerge);
  return {echo::SpeckleCells::gather(memory.insonified, memory.bodies.rough), memory.bodies.smooth, sums,
          seabed_depth_m};
}

/// What a batch brings to the cells of the seabed: rays to bodies, its last, bring nothing.
void SeaAcoustics::find_parts(const frames::HeadPose& pose, const echo::SpeckleCells& cells, ShotMemory::OfBatch& own) {
  const profile::Span span(profile::Stage::kMerge);
  cells.find_parts(own.insonification(pose), own.batch.hits.size() - own.batch.to_bodies.size(), own.parts);
}

/// What bubbles under the hull take on the way out and on the way back is the same for all paths.
double SeaAcoustics::sent_db(double source_level_db) const {
  return source_level_db - 2.0 * environment_->bubble_loss_db();
}

Echoed SeaAcoustics::echoes(const Shot& shot, const Insonified& insonified, ShotMemory& memory) const {
  const auto& [found, smooth, sums, seabed_depth_m] = insonified;
  const profile::Span span(profile::Stage::kEchoes, found.size());
  const frames::HeadPose& pose = shot.pose();
  const double head_depth_m = -pose.position_enu_m.z();
  memory.receivers.set({0.0, seconds(kTrackPeriod), effects_.motion ? shot.poses : shot.poses.first(1)});
  Echoed echoed{.arrivals = memory.arrivals, .coherent = memory.coherent, .receivers = memory.receivers};
  echoed.rays_that_hit = sums.hits;
  echoed.rays_in_lobe = sums.in_lobe;
  echoed.seabed_depth_m = seabed_depth_m.value_or(head_depth_m);
  echoed.absorption_dbpm =
      effects_.absorption ? environment_->absorption_dbpm(head_depth_m, echoed.seabed_depth_m) : 0.0;
  const echo::Carrier carrier{frequency_hz_, echoed.absorption_dbpm, sum()};
  std::optional<echo::Multipath> multipath;
  if (effects_.multipath) {
    multipath.emplace();
    multipath->head = {.source_level_db = sent_db(shot.source_level_db), .transmit = shot.transmit};
    multipath->surface.level_enu_m = environment_->water_level_m(shot.transmit_s);
    multipath->surface.sound_speed_mps = sound_speed_mps(pose);
    multipath->surface.rms_height_m = environment_->rms_wave_height_m();
    multipath->latest_s = shot.latest_s;
  }
  const echo::Multipath* by = multipath ? &*multipath : nullptr;
  echoed.paired = echo::make_echoes(carrier, pose, found, memory.receivers, by, memory.echoes, memory.arrivals);
  if (exact_ && paths_.refracted()) {
    echo::take_eigenrays(carrier, environment_->profile(), pose.position_enu_m, found, memory.receivers, 0,
                         memory.arrivals);
  }
  memory.coherent.clear();
  add_echoes_of_smooth_bodies(shot, smooth, echoed.absorption_dbpm, memory.receivers,
                              effects_.speckle ? memory.arrivals : memory.coherent);
  return echoed;
}

/// What their facets send has phase, whether the seabed's is drawn or not.
void SeaAcoustics::add_echoes_of_smooth_bodies(const Shot& shot, const echo::Scatterers& facets, double absorption_dbpm,
                                               const echo::Receivers& receivers, echo::Arrivals& arrivals) const {
  const echo::Carrier carrier{frequency_hz_, absorption_dbpm, echo::Sum::kPressure};
  const frames::Vec3& from = shot.pose().position_enu_m;
  if (exact_ && paths_.refracted()) {
    echo::add_eigenray_echoes(carrier, environment_->profile(), from, facets, receivers, arrivals);
  } else {
    echo::add_direct_echoes(carrier, from, facets, receivers, arrivals);
  }
}

/// What the rays of a batch carry to what they hit, and how strongly that scatters.
void SeaAcoustics::weigh(const Shot& shot, const seabed::ClassTables& backscatter,
                         const trace::Contributors& contributors, ShotMemory::OfBatch& memory) const {
  const profile::Span span(profile::Stage::kWeigh);
  const trace::Rays& rays = memory.batch.rays;
  const trace::Hits& hits = memory.batch.hits;
  const double source = power_of(sent_db(shot.source_level_db));
  memory.source_upa2m2.resize(rays.size());
  memory.backscatter.resize(rays.size());
  memory.sums = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, rays.size(), kRaysPerTask), HitSums{},
      [&](const auto& range, HitSums so_far) {
        std::array<double, kRaysPerTask> transmitted;
        array::powers(shot.transmit, part_of(rays.direction_head, range.begin(), range.size()),
                      std::span(hits.path_length_m).subspan(range.begin(), range.size()),
                      std::span(transmitted).first(range.size()));
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          if (!hits.hit(i)) continue;
          const double power = transmitted[i - range.begin()];
          ++so_far.hits;
          so_far.in_lobe += power > kInLobe ? 1 : 0;
          memory.source_upa2m2[i] = static_cast<float>(source * power);
          memory.backscatter[i] = backscatter(contributors[hits.contributor[i]].sediment, hits.sin_grazing[i]);
        }
        return so_far;
      },
      [](const HitSums& a, const HitSums& b) { return a + b; });
}

void SeaAcoustics::probe(const Shot& shot, const Echoed& echoed, const trace::Mesh& mesh, const trace::Rays& rays,
                         double range_m, std::uint32_t behind, const ShotMemory& memory, ProbeMemory& probed) const {
  constexpr float kLeastGrazing = 1e-3F;  // as of echo::SpeckleCells
  const frames::HeadPose& pose = shot.pose();
  paths_.trace(mesh, pose, rays, range_m, paths_.refracted() ? &memory.paths : nullptr, probed.hits, behind);
  const trace::Hits& hits = probed.hits;
  probed.power.resize(rays.size());
  array::powers(shot.transmit, part_of(rays.direction_head, 0, rays.size()), hits.path_length_m, probed.power);

  probed.rays.clear();
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    if (hits.hit(i)) probed.rays.push_back(i);
  }
  const seabed::ClassTables& backscatter = environment_->backscatter(mesh.facet_mean_square_slope(), probed.facet_laws);
  const auto source = power_of(sent_db(shot.source_level_db));
  const Eigen::Matrix3d enu_from_head = pose.enu_from_head.toRotationMatrix();
  probed.scatterers.resize(probed.rays.size());
  for (std::size_t k = 0; k < probed.rays.size(); ++k) {
    const std::uint32_t i = probed.rays[k];
    const trace::Hit hit = hits[i];
    const float sine = std::max(kLeastGrazing, hit.sin_grazing);
    const frames::Vec3 launched = enu_from_head * rays.direction_head[i].cast<double>();
    const frames::Vec3 straight = (hit.position_enu_m - pose.position_enu_m) / static_cast<double>(hit.range_m);
    echo::Scatterer scatterer;
    scatterer.position_enu_m = hit.position_enu_m;
    scatterer.bend_enu = (launched - straight).cast<float>();
    scatterer.slowness_spm = hit.travel_time_s / hit.range_m;
    scatterer.stretch = hit.path_length_m / hit.range_m;
    scatterer.spreading = hit.tube_m2 / (hit.range_m * hit.range_m);
    scatterer.scattered_upa2m2 = static_cast<float>(source * probed.power[i]) *
                                 backscatter(mesh.contributors()[hit.contributor].sediment, hit.sin_grazing) / sine;
    scatterer.contributor = hit.contributor;
    probed.scatterers.set(k, scatterer);
  }
  probed.arrivals.clear();
  echo::add_direct_echoes({frequency_hz_, echoed.absorption_dbpm, echo::Sum::kMeanSquare}, pose.position_enu_m,
                          probed.scatterers, echoed.receivers, probed.arrivals);
}

void SeaAcoustics::gains(const array::Pattern& pattern, const frames::HeadPose& pose, const echo::Arrivals& arrivals,
                         const echo::PairedArrivals& paired, const echo::SharedByBeams* shared,
                         std::span<float> gains) const {
  amplitude_gains(pattern, pose, arrivals, gains);
  const profile::Span span(profile::Stage::kPatterns);
  if (!effects_.speckle) echo::power_gains(arrivals, paired, shared, gains);
}

void SeaAcoustics::amplitude_gains(const array::Pattern& pattern, const frames::HeadPose& pose,
                                   const echo::Arrivals& arrivals, std::span<float> gains) const {
  const profile::Span span(profile::Stage::kPatterns);
  const double half_speed_mps = 0.5 * sound_speed_mps(pose);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, gains.size(), kArrivalsPerTask),
      [&](const auto& range) {
        std::array<float, kArrivalsPerTask> range_m;
        for (std::size_t i = 0; i < range.size(); ++i)
          range_m[i] = static_cast<float>(half_speed_mps * arrivals.time_s[range.begin() + i]);
        pattern.amplitudes(part_of(arrivals.direction_head, range.begin(), range.size()),
                           std::span(range_m).first(range.size()), gains.subspan(range.begin(), range.size()));
      },
      tbb::simple_partitioner());
}

void SeaAcoustics::add_echoes_of(const Shot& shot, const Echoed& echoed, const echo::InterferingTransmission& other,
                                 const echo::Arrivals& echoes, const echo::Pulse& pulse,
                                 echo::Arrivals& foreign) const {
  if (effects_.interference) echo::add_echoes_of(other, echoes, band(shot, echoed), pulse, foreign);
}

void SeaAcoustics::add_interference(const Shot& shot, const Echoed& echoed,
                                    std::span<const echo::InterferingTransmission> interfering,
                                    const echo::Pulse& pulse, echo::Arrivals& foreign) const {
  if (effects_.interference) echo::add_interference(interfering, band(shot, echoed), pulse, echoed.receivers, foreign);
}

void SeaAcoustics::reverberation_upa2(const Shot& shot, const Echoed& echoed,
                                      std::span<const echo::VolumeDirections> receive_directions,
                                      const echo::Pulse& pulse, const echo::Sampling& sampling,
                                      std::vector<float>& mean_square_upa2) const {
  echo::VolumeLayers layers;
  layers.backscatter_per_m = [this](double depth_m) {
    return power_of(water::volume_scattering_db(environment_->scattering_layers(), depth_m));
  };
  layers.deepest_m = echoed.seabed_depth_m;
  echo::reverberation_upa2(sent_db(shot.source_level_db), echoed.absorption_dbpm, sound_speed_mps(shot.pose()),
                           receive_directions, layers, shot.pose(), pulse, sampling, mean_square_upa2);
}

}  // namespace ensonify
