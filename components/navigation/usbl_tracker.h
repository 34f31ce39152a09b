#pragma once

#include <optional>

#include "components/navigation/mounted_instrument.h"
#include "messages/navigation.h"

namespace ensonify {

/// An array under this vehicle that finds the transponder of another one.
class UsblTracker {
 public:
  UsblTracker(const UsblConfig& config, std::uint64_t seed, const std::string& process, Ports& ports);

  SimTime next() const { return array_.due.next(); }
  /// Asks when it is due; without a moment time passes and nothing is asked.
  void step(SimTime now, const Moment* moment, Outbox& outbox);

  /// Reason that the last interrogation had no answer; empty when it had one.
  const std::string& silence() const { return silence_; }

 private:
  /// Place of the transponder when it sent the reply received now; empty while the target is not known.
  std::optional<frames::Vec3> answered_enu_m(const Moment& moment, const frames::Vec3& array_enu_m) const;
  std::string why_silent(const frames::Vec3& place_array_m) const;

  MountedInstrument<UsblConfig, random::Stream> array_;
  frames::PoseHistory target_;
  std::string silence_;
  Ports::Out<msg::UsblFix> fixes_out_;
};

}  // namespace ensonify
