#pragma once

#include <tbb/parallel_for.h>

#include <functional>
#include <span>
#include <vector>

#include "components/sonar/effects.h"
#include "components/sonar/environment.h"
#include "components/sonar/trace_summary.h"
#include "components/sonar/water_paths.h"
#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/interference.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/echo/scatterer.h"
#include "kernels/acoustics/echo/volume.h"

namespace ensonify {

/// Arrivals of one transmission at a head of one frequency: echoes of the seabed and those by
/// way of the surface, by the true motion and the true water. A function of the transmission, the poses, the rays and
/// the tiles. What the head receives of it by its receive patterns, and the noise, are the head's.
class Arrivals {
 public:
  /// Power of the transmission in a direction (unit vector, head frame) as it is at this range, times the range
  /// squared; 1 on its axis far away (range infinite). Called from several threads.
  using TransmittedPower = std::function<double(const Eigen::Vector3f& direction_head, float range_m)>;

  Arrivals(const Environment& environment, double frequency_hz, const Effects& effects, TransmittedPower transmitted);

  /// True poses of the head from transmission on, which is at sim time `t_s`; frames::HeadPose per kTrackPeriod. Comes
  /// before the others.
  void move(std::span<const frames::HeadPose> poses, double t_s);
  const frames::HeadPose& transmit_pose() const { return poses_.front(); }
  /// The true one, at the head.
  double sound_speed_mps() const { return paths_.sound_speed_mps(transmit_pose()); }

  /// The rays of the transmission, as the seabed asks for them (trace::RayDistribution), and the first seabed that each
  /// hits from the pose of transmission, within a slant range. The seabed's mesh becomes that of this transmission.
  void insonify(trace::Scene& seabed, trace::RayDistribution& distribution, double range_m,
                std::vector<trace::Ray>& rays, std::vector<trace::Hit>& hits);

  /// Echoes with their direction and time, valid until the next call; amplitudes are pressures, or with speckle
  /// switched off mean squares. `rays` and `hits` are those of insonify(), the patches of seabed that answer as one
  /// point those of `scatterers`.
  const std::vector<echo::Arrival>& receive_echoes(double source_level_db, echo::Scatterers& scatterers,
                                                   std::span<const trace::Ray> rays, std::span<const trace::Hit> hits);

  /// Echoes of the last call of receive_echoes(), without what was added since.
  std::span<const echo::Arrival> echoes() const { return std::span(arrivals_).first(echoes_); }

  /// The same and another sector's echoes: `other` gives what was sent.
  const std::vector<echo::Arrival>& add_echoes_of(const echo::InterferingTransmission& other,
                                                  std::span<const echo::Arrival> echoes, const echo::Pulse& pulse);

  /// The same and what other heads send meanwhile, as the filter of this pulse receives it.
  const std::vector<echo::Arrival>& add_interference(std::span<const echo::InterferingTransmission> interfering,
                                                     const echo::Pulse& pulse);

  /// Mean squares of what the water column sends back towards these receive directions, down to the seabed that the
  /// last call of receive_echoes() found; sample by direction. Nobody needs them where the water does not scatter or
  /// that is off.
  bool water_scatters() const { return effects_.volume && !environment_.scattering_layers().empty(); }
  /// Mean squares of that (sample by direction) of these receive directions, down to the depth of the seabed that
  /// the last call of receive_echoes() hit.
  const std::vector<float>& reverberation_upa2(double source_level_db,
                                               std::span<const echo::VolumeDirections> receive_directions,
                                               const echo::Pulse& pulse, const echo::Sampling& sampling);

  /// Gain of a receive pattern (amplitude by arrival) for each arrival: that amplitude, or with speckle switched off
  /// its square.
  template <class Pattern>
  void gains(const Pattern& pattern, std::vector<float>& gains) const {
    constexpr std::size_t kPerTask = 4096;
    gains.resize(arrivals_.size());
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, gains.size(), kPerTask),
        [&](const auto& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const float amplitude = pattern(arrivals_[i]);
            gains[i] = effects_.speckle ? amplitude : amplitude * amplitude;
          }
        },
        tbb::simple_partitioner());
  }

  const Environment& environment() const { return environment_; }
  /// Number of rays of the last ping that hit the seabed.
  int rays_that_hit() const { return rays_that_hit_; }
  /// Summary of the hits, for health.
  TraceSummary trace_summary(double range_m, const trace::Scene& seabed) const {
    return {rays_that_hit_, rays_in_lobe_, range_m, altitude_m(seabed, transmit_pose())};
  }

 private:
  echo::ReceiverBand band() const { return {frequency_hz_, sound_speed_mps(), absorption_dbpm_, sum()}; }
  echo::Sum sum() const { return effects_.speckle ? echo::Sum::kPressure : echo::Sum::kMeanSquare; }
  void set_source_levels(double source_level_db, std::span<const trace::Ray> rays, std::span<const trace::Hit> hits);
  double sent_db(double source_level_db) const;

  Environment environment_;
  double frequency_hz_;
  Effects effects_;
  TransmittedPower transmitted_;
  WaterPaths paths_;
  echo::Receivers receivers_;

  // Of the last ping.
  double water_level_m_ = 0.0;
  std::vector<frames::HeadPose> poses_;
  std::vector<float> source_upa2m2_, backscatter_;
  std::vector<echo::Arrival> arrivals_;
  std::size_t echoes_ = 0;  // the first of them
  std::vector<float> volume_upa2_;
  double seabed_depth_m_ = 0.0;  // mean over the hits
  double absorption_dbpm_ = 0.0;
  int rays_that_hit_ = 0, rays_in_lobe_ = 0;
};

}  // namespace ensonify
