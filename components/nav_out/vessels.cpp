#include "components/nav_out/vessels.h"

namespace ensonify::nav_out {

Vessels::Vessels(const std::vector<std::string>& names, std::uint32_t first_mmsi) {
  for (const std::string& name : names) vessels_[name].mmsi = first_mmsi++;
}

void Vessels::take(const std::string& name, const Motion& motion, const Earth& earth) {
  const auto found = vessels_.find(name);
  if (found == vessels_.end() || !earth.world) return;
  found->second.motion = motion;
  found->second.turning.take(motion.stamp_ns, earth.heading_of(motion));
}

std::vector<std::string> Vessels::reports(const std::string& output, double hz, const Earth& earth) {
  std::vector<std::string> sentences;
  for (auto& [name, vessel] : vessels_) {
    if (!vessel.motion || vessel.motion->position_enu_m.z() < -kSilentBelow_m) continue;
    Pace& pace = vessel.paces.try_emplace(output, hz, kFastest_hz, earth.start_unix_ns).first->second;
    if (!pace.take(vessel.motion->stamp_ns)) continue;
    sentences.push_back(formats::ais::vdm(report_of(*vessel.motion, vessel.turning, earth, vessel.mmsi)));
  }
  return sentences;
}

}  // namespace ensonify::nav_out
