#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "components/forward_looking/config.h"
#include "components/sonar/array_echoes.h"
#include "components/sonar/expected_echoes.h"
#include "components/sonar/head_node.h"
#include "components/sonar/labeller.h"
#include "components/sonar/line_design.h"
#include "components/sonar/shot_design.h"
#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/array/pattern.h"
#include "messages/labels.h"
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

/// A forward-looking head: an image per ping, of what its beams receive. Uses the true motion, the actual mounting and
/// the true water, as the sea does; steering and range use the sound speed that the head knows. It neither detects nor
/// places: of the five stages it has the first three.
class ForwardLooking {
 public:
  using Config = ForwardLookingConfig;
  static constexpr const char* kComponent = "forward_looking";
  using Report = HeadReport<msg::Ping, msg::Labels, msg::Energies>;

  /// What follows from the settings of a ping.
  struct Design {
    double range_m, held_pulse_length_s;  // 0: the pulse follows the range
    RangedPulse ranged;
    ShotDesign shot;

    bool fits(const HeadSettings& settings) const {
      return range_m == settings.range_m && held_pulse_length_s == settings.pulse_length_s;
    }
  };

  static HeadPlan plan(const Config& config);

  /// The configuration outlives the head.
  ForwardLooking(const Config& config, std::size_t channel);

  HeadOutputs<msg::Ping, msg::Labels, msg::Energies> outputs() const;
  SentPing transmit(SimTime now, const HeadSettings& settings, const Surroundings& around) const;
  Design prepare(const HeadSettings& settings) const;
  Report ping(const PingEvent& event, const SentPing& sent, const Surroundings& around);

 private:
  RangedPulse pulse_for(const HeadSettings& settings) const;
  void point_beams(double true_mps, double known_mps, std::vector<float>& sin_beams) const;
  msg::Ping ping_message(const PingEvent& event, const SentPing& sent, const Design& design,
                         const echo::Image& image) const;

  msg::Labels labels_of(const PingEvent& event, const Shot& shot, const trace::Mesh& mesh, const Echoed& echoed,
                        const Design& design, const ArrayReception& reception, double reach_m);

  /// Scratch: its contents do not matter.
  struct Memory {
    std::optional<Design> design;  // of the newest ping
    std::vector<frames::HeadPose> poses;
    ShotMemory shot;
    std::vector<float> sin_beams;
    ArrayEchoes::Memory beams;
    Labeller::Memory labels;
    ExpectedEchoes<ArrayEchoes>::Memory expected;
  };

  const Config& config_;
  LineDesign line_;
  ForwardFaces faces_;
  ArrayEchoes echoes_;
  std::vector<float> beam_angle_rad_;                      // azimuth from the head's x axis, positive to starboard
  std::vector<echo::VolumeDirections> volume_directions_;  // empty: the water does not scatter
  LabelView label_view_;
  std::optional<Labeller> labeller_;
  std::optional<ExpectedEchoes<ArrayEchoes>> expectation_;
  Memory memory_;
};

/// Range at which the receive array's far field begins, m; nearer, a real head focuses its beams, as is assumed here.
double near_field_m(const ForwardLookingConfig& config);

}  // namespace ensonify
