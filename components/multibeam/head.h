#pragma once

#include <memory>
#include <vector>

#include "components/multibeam/config.h"
#include "components/multibeam/steering.h"
#include "components/runtime/head/environment.h"
#include "components/runtime/head/shot.h"
#include "components/runtime/head/water_paths.h"
#include "kernels/array/pattern_table.h"
#include "kernels/detect/bottom.h"
#include "kernels/echo/arrival.h"
#include "kernels/echo/line_receiver.h"
#include "kernels/echo/pulse.h"
#include "kernels/echo/scatterer.h"
#include "kernels/frames/pose.h"
#include "kernels/random/stream.h"
#include "kernels/trace/ray_distribution.h"
#include "kernels/trace/scene.h"
#include "messages/sonar.h"

namespace ensonify {

/// The acoustics of a Mills-cross head: what its beams hear. Uses the true motion and the actual mounting, as the sea
/// does; what the instrument makes of it is in soundings.h.
class MultibeamHead {
 public:
  explicit MultibeamHead(const MultibeamConfig& config);

  /// The beams of a ping against time, as all of the receive line and as each half of it hears them.
  struct Heard {
    detect::Amplitudes image;
    detect::HalfApertures halves;
  };
  /// Rays from the true pose at transmission, echoes at the true poses at reception, noise at the array's elements. A
  /// function of the shot, the steering, the poses and the tiles. Valid until the next call. `truth` has a pose.
  Heard listen(const Shot& shot, const Steering& steering, const frames::PoseHistory& truth,
               const trace::Scene& seabed);

  /// How many rays of the last ping met the seabed within its range.
  int rays_that_hit() const { return rays_that_hit_; }

  /// The last image as a message; it shares the samples.
  msg::Ping ping_message(const Shot& shot, const Steering& steering) const;
  /// The settings that a ping was made with.
  msg::AppliedSettings applied(const Shot& shot, const Steering& steering) const;
  std::size_t max_ping_bytes() const;

 private:
  void trace_rays(const Shot& shot, const Steering& steering, const trace::Scene& seabed);
  void form_beams(const Shot& shot, const Steering& steering);
  echo::Sampling sampling(const Shot& shot) const;

  MultibeamConfig config_;
  echo::SampledPulse pulse_;
  random::Stream noise_;
  Environment environment_;
  WaterPaths paths_;
  trace::RayDistribution distribution_;
  array::PatternTable transmit_pattern_;  // against the sine from the steered fan

  // Memory of the ping path, sized by the first pings of a range.
  std::vector<trace::Ray> rays_;
  std::vector<float> source_upa2m2_;  // by ray
  std::vector<trace::Hit> hits_;
  std::vector<float> backscatter_;
  std::vector<frames::HeadPose> poses_;  // from transmission on
  std::vector<float> sin_beams_true_;
  double absorption_dbpm_ = 0.0;
  echo::Scatterers scatterers_;
  echo::Receivers receivers_;
  std::vector<echo::Arrival> arrivals_;
  echo::LineReceiver receiver_;
  std::vector<std::vector<float>> weights_;            // of the whole line, its starboard half, its port half
  std::vector<echo::Image> images_;                    // likewise
  std::shared_ptr<std::vector<float>> amplitude_upa_;  // a new one while messages still hold the last
  int rays_that_hit_ = 0;
};

}  // namespace ensonify
