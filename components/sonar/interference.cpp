#include "components/sonar/interference.h"

#include <algorithm>

#include "components/sonar/sight.h"

namespace ensonify {

Interference::Interference(Ports& ports, const HeadInputs& inputs, const std::vector<OtherHead>& others,
                           SimTime latency)
    : inputs_(inputs), others_(others) {
  if (others_.empty()) return;
  std::vector<std::string> topics;
  for (const OtherHead& other : others_) topics.push_back(other.process + "/transmit");
  ports.in_topics<msg::Transmit>(
      "transmits", topics,
      [this](const std::string& publisher, const msg::Transmit& sent) {
        const auto from = std::find_if(others_.begin(), others_.end(),
                                       [&](const OtherHead& other) { return other.process == publisher; });
        heard_.push_back({&*from, sent});
        while (!inputs_.truth().empty() && heard_.front().sent.stamp_ns < inputs_.truth().oldest_ns())
          heard_.pop_front();
      },
      {.delay = latency});
}

std::vector<echo::ForeignTransmission> Interference::during(SimTime transmit, SimTime listening) const {
  std::vector<echo::ForeignTransmission> sounds;
  if (heard_.empty()) return sounds;
  const auto pose_at = [&](std::int64_t t_ns) {
    return *inputs_.truth().at(t_ns, frames::PoseHistory::Outside::kNearest);
  };
  const auto altitude =
      altitude_m(inputs_.seabed(), frames::head_pose(pose_at(transmit.count()), inputs_.mounting().actual));
  for (const auto& [from, sent] : heard_) {
    if (SimTime{sent.stamp_ns} > transmit + listening) continue;
    echo::ForeignTransmission sound;
    sound.time_s = seconds(SimTime{sent.stamp_ns} - transmit);
    sound.source_enu_m = pose_at(sent.stamp_ns).enu_from_body * from->from_us_body_m;
    sound.source_level_db = sent.source_level_db - from->isolation_db;
    sound.frequency_hz = sent.frequency_hz;
    sound.sweep_hz = sent.bandwidth_hz;
    sound.duration_s = sent.pulse_length_s;
    sound.rejection_db = from->rejection_db;
    sounds.push_back(sound);
    if (!altitude) continue;
    sound.source_enu_m.z() = -2.0 * *altitude - sound.source_enu_m.z();
    sound.source_level_db = sent.source_level_db - from->bottom_loss_db;
    sounds.push_back(sound);
  }
  return sounds;
}

}  // namespace ensonify
