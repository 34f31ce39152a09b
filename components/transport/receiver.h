#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "components/transport/channel.h"

namespace ensonify {

/// Takes what comes by a channel as it comes, and stamps it; whoever uses it asks when it has time. It keeps 4 MiB at
/// most: what comes beyond that is dropped and counted.
class Receiver {
 public:
  using Clock = std::chrono::steady_clock;
  struct Arrival {
    Channel::Piece piece;
    Clock::time_point at;
  };
  struct State {
    std::uint64_t refused = 0;        // Channel::refused
    std::uint64_t dropped_bytes = 0;  // for want of room
    std::string trouble;              // Channel::trouble
  };

  explicit Receiver(std::unique_ptr<Channel> channel);
  ~Receiver();
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  /// The next piece that has arrived; nothing when none has. Does not wait.
  std::optional<Arrival> take();
  State state() const;

  static constexpr std::size_t kMostBytes = 4U << 20U;
  static constexpr std::size_t kMostPieces = 1U << 17U;

 private:
  void run();

  std::unique_ptr<Channel> channel_;  // of the thread
  mutable std::mutex mutex_;
  std::deque<Arrival> arrived_;
  std::size_t bytes_ = 0;
  State state_;
  std::atomic<bool> stop_{false};
  std::thread thread_;  // last: it uses all of the others
};

}  // namespace ensonify
