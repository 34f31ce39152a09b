#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "components/forward_looking/config.h"
#include "components/sonar/array_echoes.h"
#include "components/sonar/line_design.h"
#include "components/sonar/sea_acoustics.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/array/pattern.h"
#include "messages/sonar.h"

namespace ensonify {

/// Directivity of the faces of a forward-looking head (unit vectors, head frame): what is not the receive
/// array's beams.
///
/// In elevation both faces are uniform lines across the tilted axis. In azimuth the transmission falls as a power of
/// the cosine, to -3 dB at the edges of the aperture, and each receive element is as long as its spacing. Behind the
/// face both are 40 dB lower. With directivity switched off all are 1 in front and behind.
struct ForwardFaces {
  /// element_in_waves: length of a receive element.
  ForwardFaces(const ForwardLookingConfig& config, double element_in_waves);

  array::Pattern transmit;
  array::Pattern element;  // of a receive element

  /// Isotropic noise that an element lets in, over what a point would: its pattern's mean around the receive line.
  double noise_share() const;
};

/// The acoustics of a forward-looking head: what its beams receive. Uses the true motion, the actual mounting and the
/// true water, as the sea does; steering and range use the sound speed that the head knows.
class ForwardLookingHead {
 public:
  explicit ForwardLookingHead(const ForwardLookingConfig& config);
  ForwardLookingHead(const ForwardLookingHead&) = delete;
  ForwardLookingHead& operator=(const ForwardLookingHead&) = delete;

  struct Received {
    msg::Ping ping;  // without a track
    TraceSummary trace;
  };
  /// The image of a ping. A function of the shot, the settings, the sound speed that the head knows, the poses while it
  /// receives, and the tiles.
  Received receive_echoes(const PingEvent& event, const HeadSettings& settings, double known_sound_speed_mps,
                          const frames::PoseHistory& truth, const trace::Scene& seabed);

  RangedPulse pulse_for(const HeadSettings& settings) const {
    return pulse_at(config_.pulse, settings.range_m, config_.sound_speed_mps, settings.pulse_length_s);
  }
  std::size_t max_ping_bytes() const;
  /// Beam axes, azimuth from the head's x axis, positive to starboard.
  const std::vector<float>& beam_angle_rad() const { return beam_angle_rad_; }

 private:
  /// Design shared by pings of the same pulse.
  struct PingDesign {
    RangedPulse ranged;
    ArrayPulse array;
  };

  void prepare(const HeadSettings& settings);
  void point_beams(double true_mps, double known_mps);
  msg::Ping ping_message(const PingEvent& event, const HeadSettings& settings, double known_sound_speed_mps) const;

  ForwardLookingConfig config_;
  LineDesign line_;
  ForwardFaces faces_;
  ArrayEchoes echoes_;
  std::vector<float> beam_angle_rad_;
  std::vector<echo::VolumeDirections> volume_directions_;  // empty: the water does not scatter
  std::optional<PingDesign> design_;

  // Memory of the ping path.
  std::vector<frames::HeadPose> poses_;
  ShotMemory shot_;
  echo::Arrivals foreign_;
  std::vector<float> sin_beams_;
  ArrayEchoes::Memory beams_;
};

/// Range at which the receive array's far field begins, m; nearer, a real head focuses its beams, as is assumed here.
double near_field_m(const ForwardLookingConfig& config);

}  // namespace ensonify
