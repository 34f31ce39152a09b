#include "components/sonar/interference.h"

#include <algorithm>

#include "components/sonar/trace_summary.h"

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
        received_.push_back({&*from, sent});
        while (!inputs_.truth().empty() && received_.front().sent.stamp_ns < inputs_.truth().oldest_ns())
          received_.pop_front();
      },
      {.delay = latency});
}

std::vector<echo::InterferingTransmission> Interference::during(SimTime transmit, SimTime reception) const {
  std::vector<echo::InterferingTransmission> transmissions;
  if (received_.empty()) return transmissions;
  const auto pose_at = [&](std::int64_t t_ns) {
    return *inputs_.truth().at(t_ns, frames::PoseHistory::Outside::kNearest);
  };
  const auto altitude =
      altitude_m(inputs_.seabed(), frames::head_pose(pose_at(transmit.count()), inputs_.mounting().actual));
  for (const auto& [from, sent] : received_) {
    if (SimTime{sent.stamp_ns} > transmit + reception) continue;
    echo::InterferingTransmission transmission;
    transmission.time_s = seconds(SimTime{sent.stamp_ns} - transmit);
    transmission.source_enu_m = pose_at(sent.stamp_ns).enu_from_body * from->from_us_body_m;
    transmission.source_level_db = sent.source_level_db - from->isolation_db;
    transmission.frequency_hz = sent.frequency_hz;
    transmission.sweep_hz = sent.bandwidth_hz;
    transmission.duration_s = sent.pulse_length_s;
    transmission.rejection_db = from->rejection_db;
    transmissions.push_back(transmission);
    if (!altitude) continue;
    transmission.source_enu_m.z() = -2.0 * *altitude - transmission.source_enu_m.z();
    transmission.source_level_db = sent.source_level_db - from->bottom_loss_db;
    transmissions.push_back(transmission);
  }
  return transmissions;
}

}  // namespace ensonify
