#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "components/runtime/bus/link.h"

namespace ensonify::bus {

using WallTime = std::chrono::steady_clock::time_point;

/// The clock's end of the control plane, and a live plane for what viewers may want to know of it. It has no sync
/// plane: nothing that it says reaches a participant as data.
class ControlPlane {
 public:
  virtual ~ControlPlane() = default;

  struct Message {
    std::string from;  // routing id: a participant's name, or one that ZeroMQ made up for a tool
    std::string text;
    std::string address;  // of whoever sent it, over tcp
  };
  /// The next message; nothing at `until`, after a signal, or now and then before: check the time and call again.
  virtual std::optional<Message> wait(std::optional<WallTime> until) = 0;
  /// False if that peer is gone.
  virtual bool send(const std::string& to, std::string_view text) = 0;

  virtual const std::string& live_endpoint() const = 0;
  /// To whoever watches; never waits.
  virtual void publish_live(const msg::Packet& packet) = 0;
};

/// The control plane by sockets: a ROUTER with mandatory routing and no handover.
class Router : public ControlPlane {
 public:
  /// Binds `<run_dir>/clock` and `<run_dir>/clock.live`, or ports.
  explicit Router(const Address& address);
  ~Router() override;

  const std::string& endpoint() const;

  std::optional<Message> wait(std::optional<WallTime> until) override;
  /// What has come already.
  std::optional<Message> take();
  bool send(const std::string& to, std::string_view text) override;

  const std::string& live_endpoint() const override;
  void publish_live(const msg::Packet& packet) override;

 private:
  struct Sockets;
  std::unique_ptr<Sockets> sockets_;
};

/// A tool's end: asks the clock and waits for the answer.
class ClockQuery {
 public:
  explicit ClockQuery(const std::string& clock_endpoint, const std::optional<Keys>& keys = std::nullopt);
  ~ClockQuery();
  /// The answer, or nothing when none came within `patience`.
  std::optional<std::string> ask(std::string_view request, std::chrono::milliseconds patience);

 private:
  struct Sockets;
  std::unique_ptr<Sockets> sockets_;
};

}  // namespace ensonify::bus
