#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "components/runtime/ports.h"
#include "messages/sonar.h"
#include "messages/soundings.h"
#include "messages/view.h"

namespace ensonify {

/// Pictures of a head's pings for viewers, on a port of their own that no participant and no record reads. Made only
/// while somebody watches, at most kMostPerSecond in a second of wall time; of a head with fewer than three beams,
/// whose pings are the lines of a waterfall, of each ping. None while the run waits for this head.
class PingPictures {
 public:
  static constexpr int kMostPerSecond = 30;

  PingPictures(Ports& ports, const std::string& port, std::size_t max_bytes, std::string beam_axis);

  /// Whether the ping to come is to be shown.
  bool wanted();
  /// `soundings` of the same ping, or null.
  void show(const msg::Ping& ping, const msg::Soundings* soundings);

 private:
  using Clock = std::chrono::steady_clock;

  const Ports& ports_;
  Ports::LiveOut<msg::View> out_;
  std::string beam_axis_;
  bool are_lines_ = false;  // so was the newest ping
  std::optional<Clock::time_point> shown_;
  std::int64_t left_out_ = 0;
};

}  // namespace ensonify
