#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/runtime/bus/keys.h"
#include "messages/codec.h"

namespace ensonify::bus {

/// Watches topics on the live plane: what it cannot take in time is dropped, and no run is slowed by it. Gaps show in
/// the envelopes' seq.
class Observer {
 public:
  using WallTime = std::chrono::steady_clock::time_point;
  struct Topic {
    std::string name;
    std::string endpoint;  // of its publisher's live plane, from the registry
  };

  /// Messages kept per publisher for an observer that does not keep up, unless it says otherwise.
  static constexpr int kQueue = 8;

  /// Throws UserError for an endpoint that cannot be connected to.
  explicit Observer(const std::vector<Topic>& topics, const std::optional<Keys>& keys = std::nullopt,
                    int queue = kQueue);
  ~Observer();

  /// The next message, or nothing once `until` has passed, a signal came or every publisher is gone. Throws
  /// msg::DecodeError for what is no message.
  std::optional<msg::Packet> next(std::optional<WallTime> until);
  /// Every publisher is gone: the run has ended.
  bool ended() const;

 private:
  struct Sockets;
  std::unique_ptr<Sockets> sockets_;
};

}  // namespace ensonify::bus
