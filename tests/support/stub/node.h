#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "components/runtime/ports.h"
#include "messages/array.h"
#include "tests/support/stub/config.h"

namespace ensonify {

/// What stubs exchange, under any type name.
struct Blob {
  std::int64_t stamp_ns = 0;
  std::int64_t received = 0;
  std::uint64_t digest = 0;
  msg::Array<std::uint8_t> data;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "event that published it", self.stamp_ns);
    visit("received", "1", "messages taken so far by its publisher", self.received);
    visit("digest", "1", "FNV-1a over (t_sim, publisher, topic, seq) of every message taken, in order", self.digest);
    visit("data", "1", "filler, the same in every message", self.data);
  }
};

class StubNode {
 public:
  using Config = StubConfig;
  static constexpr const char* kComponent = "stub";

  StubNode(const Config& config, Ports& ports);
  SimTime step(SimTime now);

 private:
  struct Output {
    std::size_t index;
    Periodic due;
    msg::Array<std::uint8_t> filler;
  };
  void take(const msg::Packet& packet);
  void misbehave(SimTime now);
  void pause_at_random();

  Config config_;
  Ports& ports_;
  Periodic events_;
  std::vector<Output> outs_;
  std::int64_t received_ = 0;
  std::uint64_t digest_ = 0xcbf29ce484222325U;
  std::uint64_t byte_sum_ = 0;
  std::mt19937_64 wall_jitter_;  // wall-clock disturbance only; no message depends on it
};

}  // namespace ensonify
