#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/expect/config.h"
#include "components/runtime/sim_time.h"
#include "messages/codec.h"

namespace ensonify::expect {

/// A message as checks examine it. Its content is decoded when somebody asks, once.
class Observation {
 public:
  explicit Observation(const msg::Packet& packet) : packet_(packet) {}

  const std::string& topic() const { return packet_.topic; }
  SimTime t() const { return SimTime{packet_.envelope.t_sim_ns}; }
  std::uint64_t seq() const { return packet_.envelope.seq; }
  const msg::Body& body() const { return packet_.body; }
  const msg::Value& value() const {
    if (!value_) value_ = msg::decode_value(packet_.body, packet_.body.size());
    return *value_;
  }

 private:
  const msg::Packet& packet_;
  mutable std::optional<msg::Value> value_;
};

/// Outcome of an expectation. `t` is when it failed, or when it could no longer fail.
struct Verdict {
  bool ok = false;
  SimTime t{0};
  std::string message;  // what was seen; when not ok, why that is wrong
};

/// Watches a run for one expectation. A check that has seen nothing to judge by fails.
class Check {
 public:
  virtual ~Check() = default;
  /// A message on one of topics(), in the order of delivery.
  virtual void see(const Observation& message) = 0;
  /// The run has ended.
  virtual Verdict close(SimTime end) = 0;

  /// Topics that it watches; patterns are allowed.
  virtual std::vector<std::string> topics() const = 0;
  /// Fields that it searches for: (topic, path, place in the user's file).
  struct Field {
    std::string topic, path;
    ConfigPlace place;
  };
  virtual std::vector<Field> fields() const = 0;
};

/// Throws UserError when a record cannot be read (same_as).
std::unique_ptr<Check> make_check(const Expectation& expectation);

}  // namespace ensonify::expect
