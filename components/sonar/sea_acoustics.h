#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "components/runtime/sim_time.h"
#include "components/sonar/effects.h"
#include "components/sonar/environment.h"
#include "components/sonar/quality.h"
#include "kernels/acoustics/array/pattern.h"
#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/body_echoes.h"
#include "kernels/acoustics/echo/interference.h"
#include "kernels/acoustics/echo/multipath.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/echo/scatterer.h"
#include "kernels/acoustics/echo/speckle_cells.h"
#include "kernels/acoustics/echo/volume.h"
#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/acoustics/trace/views.h"
#include "kernels/base/frames/pose.h"
#include "kernels/water/refraction/path_table.h"

namespace ensonify {

/// One transmission: its number, when it left and how far it is received.
struct PingEvent {
  std::int64_t ping = 0;
  SimTime transmit{0};
  double range_m = 0.0;
  std::vector<echo::InterferingTransmission> interfering = {};  // what other heads send meanwhile
  bool picture = false;  // its samples are wanted by viewers: nothing but for_viewers may follow from it

  std::uint64_t number() const { return static_cast<std::uint64_t>(ping); }  // as random draws count pings
};

/// Height of a head above the seabed straight below it, by the tiles' posts; nothing over a hole, where no tile is held
/// or below the seabed.
std::optional<double> altitude_m(const trace::Scene& seabed, const frames::HeadPose& head);

/// Summary of a ping's trace.
struct TraceSummary {
  int rays_that_hit = 0;             // anything within the range ...
  int rays_in_lobe = 0;              // ... and within 10 dB of the transmit axis
  double range_m = 0.0;              // of reception
  std::optional<double> altitude_m;  // as above
};

/// Reason, for health, that such a ping has no echo; "" when it need not be.
std::string no_echo_reason(const TraceSummary& trace_summary);

/// Rays through the water of a run: bent by its profile, or straight where the speed of sound is one everywhere or
/// refraction is switched off. Depths of the profile count from z = 0.
class WaterPaths {
 public:
  /// exact: each path is followed from the head, none is taken from a table.
  WaterPaths(const refraction::SoundSpeedProfile& profile, bool refraction, bool exact)
      : profile_(profile), refracted_(refraction && profile.knots().size() > 1), exact_(exact) {}

  bool refracted() const { return refracted_; }

  /// The speed of sound at the head, m/s.
  double sound_speed_mps(const frames::HeadPose& head) const { return profile_.speed_mps(depth_m(head)); }

  /// The seabed as a transmission needs it that sends rays into this volume from this pose: fine where it points.
  trace::Mesh mesh(const trace::Scene& seabed, const frames::HeadPose& head, const trace::TransmitVolume& volume,
                   double max_range_m) const {
    lod::Water water;
    if (refracted_ && seabed.detail().enabled) {
      const auto heights = seabed.heights_near(head.position_enu_m.head<2>(), max_range_m);
      water = trace::water_above(profile_, depth_m(head), heights ? -heights->lowest_m : depth_m(head));
    }
    return seabed.adapted(trace::views_of(volume, head, max_range_m, water, seabed.detail().side_lobes));
  }

  /// The table of the paths from this head, in memory of the caller's; null where paths are straight.
  const refraction::PathTable* tabulate(const trace::Mesh& seabed, const frames::HeadPose& head, double max_range_m,
                                        refraction::PathTable& memory) const {
    if (!refracted_) return nullptr;
    if (exact_) {
      memory.build(profile_, depth_m(head), depth_m(head));
    } else {
      seabed.tabulate(profile_, head, depth_m(head), static_cast<float>(max_range_m), memory);
    }
    return &memory;
  }

  /// trace::Mesh::trace through this water, of which `refracted` is the table.
  void trace(const trace::Mesh& seabed, const frames::HeadPose& head, const trace::Rays& rays, double max_range_m,
             const refraction::PathTable* refracted, trace::Hits& hits, std::uint32_t behind = trace::kNoise) const {
    const auto range_m = static_cast<float>(max_range_m);
    if (!refracted) return seabed.trace(head, rays, range_m, hits, sound_speed_mps(head), behind);
    seabed.trace(head, rays, range_m, hits, *refracted, behind);
  }

 private:
  static double depth_m(const frames::HeadPose& head) { return -head.position_enu_m.z(); }

  refraction::SoundSpeedProfile profile_;
  bool refracted_, exact_;
};

inline double power_of(double level_db) { return std::pow(10.0, 0.1 * level_db); }

/// One transmission as it truly is.
struct Shot {
  std::span<const frames::HeadPose> poses;  // of the head from transmission on, one per kTrackPeriod; at least one
  double transmit_s = 0.0;                  // sim time
  double source_level_db = 0.0;
  std::span<const array::Pattern> transmit;  // of all transducers that send at once
  trace::RayDistribution::Steer steer = {};  // of the volume that its rays go to
  /// So many rays are in memory at a time; a multiple of 16. No result depends on it.
  std::size_t rays_per_batch = 16'384;
  /// After transmission. Nobody receives echoes that arrive later (latest_arrival_s).
  double latest_s = std::numeric_limits<double>::infinity();

  const frames::HeadPose& pose() const { return poses.front(); }  // at transmission
};

/// Echoes of a pulse that arrive later than this reach none of the samples.
inline double latest_arrival_s(const echo::Sampling& sampling, const echo::Pulse& pulse) {
  return sampling.start_s + sampling.count * sampling.period_s - pulse.start_s;
}

/// Number of rays that hit something.
struct HitSums {
  int hits = 0, in_lobe = 0;

  HitSums operator+(const HitSums& other) const { return {hits + other.hits, in_lobe + other.in_lobe}; }
};

/// Seabed and bodies that a shot insonified.
struct Insonified {
  const echo::Scatterers& scatterers;
  const echo::Scatterers& smooth;  // facets of smooth bodies
  HitSums sums;
  std::optional<double> seabed_depth_m;  // mean over what probes hit, as if no body stood there
};

/// Echoes of a shot, and what was found on the way. Amplitudes are pressures, or with speckle switched off mean
/// squares.
struct Echoed {
  const echo::Arrivals& arrivals;
  const echo::Arrivals& coherent;    // without speckle: those that are pressures all the same, of smooth bodies
  const echo::Receivers& receivers;  // where the head receives
  echo::PairedArrivals paired;       // which of the arrivals add as pressures even without speckle
  double absorption_dbpm = 0.0;
  double seabed_depth_m = 0.0;  // mean over what probes hit; the head's own where they hit nothing
  int rays_that_hit = 0, rays_in_lobe = 0;

  /// Summary for health.
  TraceSummary summary(const Shot& shot, double range_m, const trace::Scene& seabed) const {
    return {rays_that_hit, rays_in_lobe, range_m, altitude_m(seabed, shot.pose())};
  }
};

/// Memory of the stages of a shot, sized by the first ones of a range. Results lie in it until it is used again.
struct ShotMemory {
  trace::RayDistribution::Plan plan;
  refraction::PathTable paths;
  Environment::FacetLaws facet_laws;
  struct OfBatch {
    trace::RayDistribution::Batch batch;
    std::vector<float> source_upa2m2, backscatter;
    HitSums sums;
    echo::CellParts parts;
    echo::Insonification insonification(const frames::HeadPose& pose) const {
      return {pose, batch.rays, batch.hits, source_upa2m2, backscatter};
    }
  };
  /// Batches that are traced and weighed while those before them are merged.
  static constexpr std::size_t kAhead = 3;
  std::array<OfBatch, kAhead> batches;
  // Of all.
  echo::SpeckleCells::Accumulator insonified;
  echo::BodyScatterers bodies;
  echo::Receivers receivers;
  echo::EchoMemory echoes;
  echo::Arrivals arrivals, coherent;
  echo::Arrivals foreign;  // of other transmissions
};

/// Memory of SeaAcoustics::probe, where its results lie: hits by ray, and an arrival for each of them that hit.
struct ProbeMemory {
  trace::Hits hits;
  std::vector<std::uint32_t> rays;  // that hit
  echo::Arrivals arrivals;          // of these: mean squares
  // Scratch.
  Environment::FacetLaws facet_laws;
  std::vector<double> power;
  echo::Scatterers scatterers;
};

/// The sea for a head of one frequency: seabed, surface, water column and other heads, by the true motion and the true
/// water. What a head makes of it by its receive patterns, and the noise, are the head's.
class SeaAcoustics {
 public:
  /// Of `quality` only whether it is the reference counts here: rays and cells are the caller's.
  SeaAcoustics(std::shared_ptr<const Environment> environment, double frequency_hz, const Effects& effects,
               const Quality& quality);

  const Environment& environment() const { return *environment_; }
  /// Whether paths bend.
  bool refracts() const { return paths_.refracted(); }
  /// The true one, at the head.
  double sound_speed_mps(const frames::HeadPose& pose) const { return paths_.sound_speed_mps(pose); }

  /// The seabed's mesh for a shot. The next shot's may be made while this one's is in use.
  trace::Mesh mesh(const Shot& shot, const trace::Scene& seabed, const trace::RayDistribution& distribution,
                   double range_m) const {
    return paths_.mesh(seabed, shot.pose(), distribution.volume(shot.steer), range_m);
  }

  /// First stage: rays as the seabed and bodies ask for them (trace::RayDistribution), planned once; then batch by
  /// batch what they hit within a slant range, and its energy in `cells`, the patches of seabed that answer as one
  /// point, or in the facets of smooth bodies.
  Insonified insonify(const Shot& shot, const trace::Mesh& seabed, const trace::RayDistribution& distribution,
                      const echo::SpeckleCells& cells, double range_m, ShotMemory& memory) const;

  /// Rays of an examination beside the ping, after its echoes(): what each hits within a slant range, `behind` as of
  /// trace::Mesh, and what comes straight back of it, of a steradian of such rays, before any receive pattern. Smooth
  /// bodies scatter by their sediment's law here.
  void probe(const Shot& shot, const Echoed& echoed, const trace::Mesh& mesh, const trace::Rays& rays, double range_m,
             std::uint32_t behind, const ShotMemory& memory, ProbeMemory& probed) const;

  /// Second stage: echoes of seabed and bodies, and those by way of the surface; smooth bodies have direct ones only.
  Echoed echoes(const Shot& shot, const Insonified& insonified, ShotMemory& memory) const;

  /// Appends what this receiver's filter lets through of another transmission's echoes ...
  void add_echoes_of(const Shot& shot, const Echoed& echoed, const echo::InterferingTransmission& other,
                     const echo::Arrivals& echoes, const echo::Pulse& pulse, echo::Arrivals& foreign) const;
  /// ... and of what other heads send meanwhile; ...
  void add_interference(const Shot& shot, const Echoed& echoed,
                        std::span<const echo::InterferingTransmission> interfering, const echo::Pulse& pulse,
                        echo::Arrivals& foreign) const;

  /// ... or that alone, in the memory.
  const echo::Arrivals& interference(const Shot& shot, const Echoed& echoed,
                                     std::span<const echo::InterferingTransmission> interfering,
                                     const echo::Pulse& pulse, ShotMemory& memory) const {
    memory.foreign.clear();
    add_interference(shot, echoed, interfering, pulse, memory.foreign);
    return memory.foreign;
  }

  /// Whether the water column sends anything back.
  bool water_scatters() const { return effects_.volume && !environment_->scattering_layers().empty(); }
  /// Mean squares of that (sample by direction) towards these receive directions, down to the seabed's depth.
  void reverberation_upa2(const Shot& shot, const Echoed& echoed,
                          std::span<const echo::VolumeDirections> receive_directions, const echo::Pulse& pulse,
                          const echo::Sampling& sampling, std::vector<float>& mean_square_upa2) const;

  /// Gain of a receive pattern for each arrival: the pattern's amplitude, or with speckle switched off that of powers
  /// (echo::power_gains, which see for `shared`).
  void gains(const array::Pattern& pattern, const frames::HeadPose& pose, const echo::Arrivals& arrivals,
             const echo::PairedArrivals& paired, const echo::SharedByBeams* shared, std::span<float> gains) const;
  /// The pattern's amplitude for each arrival.
  void amplitude_gains(const array::Pattern& pattern, const frames::HeadPose& pose, const echo::Arrivals& arrivals,
                       std::span<float> gains) const;

 private:
  echo::ReceiverBand band(const Shot& shot, const Echoed& echoed) const {
    return {frequency_hz_, sound_speed_mps(shot.pose()), echoed.absorption_dbpm, sum()};
  }
  echo::Sum sum() const { return effects_.speckle ? echo::Sum::kPressure : echo::Sum::kMeanSquare; }
  void weigh(const Shot& shot, const seabed::ClassTables& backscatter, const trace::Contributors& contributors,
             ShotMemory::OfBatch& memory) const;
  void add_echoes_of_smooth_bodies(const Shot& shot, const echo::Scatterers& facets, double absorption_dbpm,
                                   const echo::Receivers& receivers, echo::Arrivals& arrivals) const;
  static void find_parts(const frames::HeadPose& pose, const echo::SpeckleCells& cells, ShotMemory::OfBatch& own);
  double sent_db(double source_level_db) const;

  std::shared_ptr<const Environment> environment_;
  double frequency_hz_;
  Effects effects_;
  bool exact_;
  WaterPaths paths_;
};

}  // namespace ensonify
