#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "components/runtime/lockstep/local_bus.h"

namespace ensonify {

/// Several nodes on one `local:` bus, in the lock step of a launch: the same wiring, conductor and order of delivery.
/// Stand-ins publish what a test says; what a test watches it gets in the order of sim time.
///
///   NodesUnderTest nodes;
///   nodes.add<VehicleNode>("auv", vehicle_config);
///   nodes.add<AutopilotNode>("pilot", pilot_config);
///   nodes.play<msg::Estimate>("nav", "estimate", 100_ms, [&](SimTime now) { return estimate_at(now); });
///   nodes.watch<msg::MissionState>("pilot/mission", [&](const msg::MissionState& mission) { ... });
///   const bool ended = nodes.run_until(600_s);
class NodesUnderTest {
 public:
  /// Ranks are in the order of the calls. The node lives as long as this.
  template <class Node>
  Node& add(const std::string& process, const typename Node::Config& config,
            const std::filesystem::path& out_dir = ".") {
    Node* made = nullptr;
    bus_.add(process, process, out_dir, [&](Ports& ports) {
      auto holder = std::make_unique<NodeHolder<Node>>(config, ports);
      made = &holder->node();
      return holder;
    });
    return *made;
  }

  /// A stand-in that publishes what `make` returns, from time 0 on; nothing where that is std::nullopt.
  template <msg::Message M>
  void play(const std::string& process, const std::string& port, SimTime period,
            std::function<std::optional<M>(SimTime)> make, std::size_t max_bytes = 4096) {
    bus_.add(process, "stand-in", ".", [&](Ports& ports) -> std::unique_ptr<AnyNode> {
      const Rate rate{1'000'000'000, period.count()};
      return std::make_unique<StandIn>(
          period, [out = ports.out<M>(port, {.max_bytes = max_bytes, .rate = rate}), make](SimTime now) mutable {
            if (const std::optional<M> message = make(now)) out.send(*message);
          });
    });
  }

  /// Messages of a topic, until the event at which a node asks for the end of the run.
  template <msg::Message M>
  void watch(const std::string& topic, std::function<void(const M&)> handler) {
    const std::string port = "watched" + std::to_string(watched_.size());
    rules_.push_back({"watch." + port, topic, SimTime{-1}, ""});
    watched_.push_back([this, port, handler = std::move(handler)](Ports& ports) {
      ports.in_raw(port, M::kType, [this, handler](const msg::Packet& packet) {
        const SimTime at{packet.envelope.t_sim_ns};
        if (bus_.finished_at() && at > *bus_.finished_at()) return;
        now_ = at;
        handler(msg::decode<M>(packet.body, packet.body.size()));
      });
    });
  }

  /// What is watched of a topic, kept as long as this.
  template <msg::Message M>
  const std::vector<M>& collect(const std::string& topic) {
    const auto all = std::make_shared<std::vector<M>>();
    watch<M>(topic, [all](const M& message) { all->push_back(message); });
    return *all;
  }

  /// An input wired by hand, as in a launch file: wire("auv.command", "pilot/command").
  void wire(const std::string& input, const std::string& topic) { rules_.push_back({input, topic, SimTime{-1}, ""}); }

  /// Runs every event up to and including `end`; true where a node asked for the end of the run. Once.
  bool run_until(SimTime end) {
    bus_.add("watch", "stand-in", ".", [&](Ports& ports) -> std::unique_ptr<AnyNode> {
      for (const auto& declare : watched_) declare(ports);
      return std::make_unique<StandIn>(100_ms, [](SimTime) {});
    });
    bus_.connect(rules_, {}, {});
    Conductor conductor = conductor_of(bus_.graph(), bus_.declarations(), 1_s);
    conductor.end_at(end);
    while (!conductor.finished()) bus_.advance(conductor);
    return bus_.finished_at().has_value();
  }

  /// Time of the message watched last.
  SimTime now() const { return now_; }

 private:
  class StandIn : public AnyNode {
   public:
    StandIn(SimTime period, std::function<void(SimTime)> act) : period_(period), act_(std::move(act)) {}
    SimTime step(SimTime now) override {
      act_(now);
      return now + period_;
    }
    void finish_run() override {}
    int exit_code() const override { return 0; }

   private:
    SimTime period_;
    std::function<void(SimTime)> act_;
  };

  LocalBus bus_;
  std::vector<WireRule> rules_;
  std::vector<std::function<void(Ports&)>> watched_;
  SimTime now_{0};
};

}  // namespace ensonify
