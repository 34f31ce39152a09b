#include "components/logger/xtf/sidescan_assembly.h"

#include <algorithm>
#include <cmath>

namespace ensonify::logger {

SidescanAssembly::SidescanAssembly(const msg::HeadDeclaration& head) {
  for (const msg::ChannelDeclaration& channel : head.channels)
    frequencies_hz_.push_back(channel.sectors.empty() ? 0.0 : channel.sectors.front().frequency_hz);
  if (frequencies_hz_.empty()) frequencies_hz_.push_back(0.0);
}

void SidescanAssembly::take(const msg::Ping& ping) {
  const auto nearest = std::min_element(frequencies_hz_.begin(), frequencies_hz_.end(), [&](double a_hz, double b_hz) {
    return std::abs(a_hz - ping.applied.frequency_hz) < std::abs(b_hz - ping.applied.frequency_hz);
  });
  pings_[ping.ping].transmissions[static_cast<std::size_t>(nearest - frequencies_hz_.begin())] = ping;
}

void SidescanAssembly::take(const msg::BottomTrack& bottom) {
  if (bottom.valid) pings_[bottom.ping].altitude_m = bottom.altitude_m;
}

std::vector<SidescanPing> SidescanAssembly::complete() {
  const auto is_whole = [this](const auto& entry) {
    return entry.second.transmissions.size() == frequencies_hz_.size();
  };
  const auto last = std::find_if(pings_.rbegin(), pings_.rend(), is_whole);
  if (last == pings_.rend()) return {};
  std::vector<SidescanPing> found;
  const auto end = last.base();
  for (auto entry = pings_.begin(); entry != end; ++entry) {
    SidescanPing ping{.altitude_m = entry->second.altitude_m};
    for (auto& [number, transmission] : entry->second.transmissions)
      ping.transmissions.push_back(std::move(transmission));
    if (!ping.transmissions.empty()) found.push_back(std::move(ping));
  }
  pings_.erase(pings_.begin(), end);
  return found;
}

}  // namespace ensonify::logger
