#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "components/runtime/bus/observer.h"
#include "components/runtime/clock_client.h"
#include "tools/topic/verbs.h"

namespace ensonify::topic_tool {

/// Time to leave, or nothing for never.
inline std::optional<bus::Observer::WallTime> deadline(const Options& options) {
  using Clock = std::chrono::steady_clock;
  if (options.timeout_s <= 0.0) return std::nullopt;
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.timeout_s));
}

/// Subscribes to the live plane of these topics.
inline bus::Observer observe(const ClockClient& clock, const std::vector<TopicEntry>& topics) {
  std::vector<bus::Observer::Topic> watched;
  for (const TopicEntry& topic : topics) watched.push_back({topic.name, topic.endpoint});
  return bus::Observer(watched, clock.keys());
}

}  // namespace ensonify::topic_tool
