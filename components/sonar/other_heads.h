#pragma once

#include <string>
#include <vector>

#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

/// Another head of the same vehicle, as this one receives it.
struct OtherHead {
  std::string process;
  double isolation_db = 40.0;  // of its source level, what does not come straight to this head: by where it points, by
                               // baffles and hull
  double bottom_loss_db = 40.0;  // of its source level, what the seabed below does not mirror: by the seabed, by where
                                 // it points
  double rejection_db = 80.0;    // by our receiver, of what lies outside its band
  frames::Vec3 from_us_body_m = frames::Vec3::Zero();  // where it truly is; from the scenario

  /// The parameters.
  bool operator==(const OtherHead& o) const {
    return process == o.process && isolation_db == o.isolation_db && bottom_loss_db == o.bottom_loss_db &&
           rejection_db == o.rejection_db;
  }
};

/// Reads the section `interference:`, heads by name; left out, no other head is received. They are among those that the
/// scenario mounts on the vehicle that carries `process`. Without a latency from the last echo to the computation, none
/// can be received.
std::vector<OtherHead> read_interference(ConfigReader& from, const World& world, const std::string& process,
                                         double processing_latency_s);

}  // namespace ensonify
