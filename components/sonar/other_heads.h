#pragma once

#include <string>
#include <vector>

#include "components/config/parameters.h"
#include "scenarios/world/world.h"

namespace ensonify {

/// Another head of the same vehicle, as this one receives it.
struct OtherHead {
  std::string process;
  double isolation_db = 40.0;  // of its source level, what does not come straight to this head: by where it points, by
                               // baffles and hull
  double bottom_loss_db = 40.0;  // of its source level, what the seabed below does not mirror: by the seabed, by where
                                 // it points
  double rejection_db = 80.0;    // by our receiver, of what lies outside its band
  frames::Vec3 from_us_body_m = frames::Vec3::Zero();  // where it truly is; from the scenario

  static constexpr auto kNamedBy = &OtherHead::process;
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("isolation_db", "dB", in(0, 300), "of its source level, what does not come straight to this head",
          self.isolation_db);
    visit("bottom_loss_db", "dB", in(0, 300), "of its source level, what the seabed below does not mirror",
          self.bottom_loss_db);
    visit("rejection_db", "dB", in(0, 300), "by our receiver, of what lies outside its band", self.rejection_db);
  }
};

/// Takes from the scenario where the heads are that are received. They are among those that it mounts on the vehicle
/// that carries `process`. Without a latency from the last echo to the computation, none can be received.
void place_other_heads(const ConfigReader& from, const World& world, const std::string& process,
                       double processing_latency_s, std::vector<OtherHead>& others);

}  // namespace ensonify
