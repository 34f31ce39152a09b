#pragma once

#include <optional>
#include <vector>

#include "components/forward_looking/faces.h"
#include "components/sonar/arrivals.h"
#include "components/sonar/ping_event.h"
#include "kernels/acoustics/echo/line_receiver.h"
#include "kernels/acoustics/echo/scatterer.h"
#include "kernels/acoustics/echo/volume.h"
#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/base/random/stream.h"
#include "messages/sonar.h"

namespace ensonify {

/// The acoustics of a forward-looking head: what its beams receive. Uses the true motion, the actual mounting and the
/// true water, as the sea does; steering and range use the sound speed that the head knows.
class ForwardLookingHead {
 public:
  explicit ForwardLookingHead(const ForwardLookingConfig& config);
  ForwardLookingHead(const ForwardLookingHead&) = delete;
  ForwardLookingHead& operator=(const ForwardLookingHead&) = delete;

  /// The image of a ping. A function of the shot, the settings, the sound speed that the head knows, the poses while it
  /// receives, and the tiles. The track is left to the caller.
  msg::Ping receive_echoes(const PingEvent& event, const HeadSettings& settings, double known_sound_speed_mps,
                           const frames::PoseHistory& truth, trace::Scene& seabed);

  /// Summary of the last ping's hits.
  const TraceSummary& trace_summary() const { return trace_summary_; }

  RangedPulse pulse_for(const HeadSettings& settings) const {
    return pulse_at(config_.pulse, settings.range_m, config_.sound_speed_mps, settings.pulse_length_s);
  }
  std::size_t max_ping_bytes() const;
  /// Beam axes, azimuth from the head's x axis, positive to starboard.
  const std::vector<float>& beam_angle_rad() const { return beam_angle_rad_; }
  /// Range at which the receive array's far field begins, m; nearer, a real head focuses its beams, as is assumed here.
  double near_field_m() const;

 private:
  /// Design of a pulse and its samples, for the next pings with the same.
  struct PingDesign {
    RangedPulse ranged;
    echo::Pulse pulse;
    echo::SampledPulse sampled, squared;
    echo::Scatterers scatterers;
    trace::RayDistribution rays;
  };

  void prepare(const HeadSettings& settings);
  void insonify(trace::Scene& seabed);
  void point_beams(double known_sound_speed_mps);
  echo::Background background(const PingEvent& event, double source_level_db);
  void form_beams(std::span<const echo::Arrival> arrivals, const echo::Background& background);

  ForwardLookingConfig config_;
  array::LineArray array_;
  ForwardFaces faces_;
  Arrivals arrivals_;
  random::Stream ambient_, electronic_, volume_;
  std::vector<float> beam_angle_rad_;
  std::vector<float> weights_;  // of elements
  echo::LineReceiver receiver_;
  std::optional<echo::LineReceiver> power_receiver_;       // without speckle
  std::vector<echo::VolumeDirections> volume_directions_;  // empty: the water does not scatter
  double noise_share_;
  std::optional<PingDesign> design_;

  // Of the last ping.
  std::vector<frames::HeadPose> poses_;
  std::vector<trace::Ray> rays_;
  std::vector<trace::Hit> hits_;
  std::vector<float> gain_, sin_beams_;
  std::vector<echo::Image> images_, mean_square_;  // one each
  TraceSummary trace_summary_;
};

}  // namespace ensonify
