#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "components/multibeam/arrays.h"
#include "components/multibeam/config.h"
#include "components/multibeam/steering.h"
#include "components/sonar/arrivals.h"
#include "components/sonar/ping_event.h"
#include "components/sonar/trace_summary.h"
#include "kernels/acoustics/echo/line_receiver.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/echo/scatterer.h"
#include "kernels/acoustics/echo/volume.h"
#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/pose.h"
#include "kernels/base/random/stream.h"

namespace ensonify {

/// The acoustics of one transmit sector: what its beams receive of its transmission. Uses the true motion, the actual
/// mounting and the true water, as the sea does. Of other sectors it receives what its filter lets through, by its own
/// beams' side lobes and where sectors join.
class SectorEchoes {
 public:
  SectorEchoes(const MultibeamConfig& config, std::size_t sector);
  SectorEchoes(const SectorEchoes&) = delete;
  SectorEchoes& operator=(const SectorEchoes&) = delete;

  /// Its transmission: rays from the true pose when it is sent, echoes at the true poses at reception. `truth` has a
  /// pose.
  void send(const PingEvent& event, const HeadSettings& settings, const Steering& steering,
            const frames::PoseHistory& truth, trace::Scene& seabed);
  /// Beams of the sector when `all` sectors of the ping, itself among them, have been sent; with noise at the array's
  /// elements. Both together are a function of the shot, the settings, the steering, the poses and the tiles.
  void beamform(const PingEvent& event, const HeadSettings& settings, const std::deque<SectorEchoes>& all);

  /// The sector's beams of the last ping, as all of the receive line receives them, and as its starboard and its port
  /// half do (empty without speckle: sums of mean squares have no phase). Times count from the sector's own
  /// transmission.
  const echo::Image& whole() const { return images_[0]; }
  const echo::Image& starboard() const { return images_[1]; }
  const echo::Image& port() const { return images_[2]; }
  const echo::Sampling& sampling() const { return sampling_; }
  /// Echo of a point in them.
  const echo::Pulse& pulse() const { return design_->pulse; }

  /// Summary of the last ping's hits.
  TraceSummary trace_summary(double range_m, const trace::Scene& seabed) const {
    return arrivals_.trace_summary(range_m, seabed);
  }

 private:
  /// Design shared by pings of the same pulse and swath.
  struct PingDesign {
    double pulse_length_s, swath_rad;
    double centre_rad;  // of the sector
    echo::Pulse pulse;
    echo::SampledPulse sampled, squared;
    echo::Scatterers scatterers;
    trace::RayDistribution rays;
    std::vector<echo::VolumeDirections> volume_directions;  // empty: the water does not scatter
  };

  PingDesign design_for(double pulse_length_s, double swath_rad);
  void prepare(const PingEvent& event, const HeadSettings& settings, const frames::PoseHistory& truth);
  void aim(const Steering& steering);
  void insonify(trace::Scene& seabed);
  echo::Background background(std::int64_t ping, double source_level_db);
  void form_beams(std::span<const echo::Arrival> arrivals, const echo::Background& background);

  MultibeamConfig config_;
  std::size_t sector_;
  double frequency_hz_, delay_s_;
  SectorPattern pattern_;
  Arrivals arrivals_;
  random::Stream ambient_, electronic_, volume_;
  echo::LineReceiver receiver_;
  std::optional<echo::LineReceiver> power_receiver_;  // without speckle
  std::vector<std::vector<float>> weights_;           // of the whole line, its starboard half, its port half
  std::vector<std::vector<float>> power_weights_;     // of the whole line
  std::optional<PingDesign> design_;

  // Memory of the ping path, sized by the first pings of a range.
  echo::Sampling sampling_;
  std::vector<frames::HeadPose> poses_;  // from transmission on
  std::vector<trace::Ray> rays_;
  std::vector<trace::Hit> hits_;
  std::vector<float> gain_, sin_beams_;
  std::vector<echo::Image> images_, mean_square_;
};

}  // namespace ensonify
