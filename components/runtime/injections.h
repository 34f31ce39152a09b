#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "components/runtime/sim_time.h"
#include "messages/codec.h"

namespace ensonify {

/// Name of the fact that holds a launch's injections, as JSON: a list of maps.
inline constexpr const char* kInjectFact = "inject";

/// A fault that a launch file asks for (`inject:`), in sim time of an epoch.
struct Injection {
  enum class Kind { kMute, kDrop, kDelay, kCorrupt, kKill, kPause };

  Kind kind = Kind::kMute;
  std::string target;                                    // PROCESS/PORT, or PROCESS: all its outputs but `health`
  SimTime from{0};                                       // of kKill and kPause: when
  SimTime to{std::numeric_limits<SimTime::rep>::max()};  // not any more
  double share = 1.0;                                    // kDrop: of the messages, at random
  SimTime by{0};                                         // kDelay
  std::string field, value;                              // kCorrupt: its path, and a number, text, true, false or nan
  int signal = 9;                                        // kKill
  double wall_s = 0.0;                                   // kPause
  std::string place = {};                                // in the launch file, for messages; no fact

  /// Whether it is about this output.
  bool hits(const std::string& process, const std::string& port) const;
};

/// Thrown at the event before which the launch kills this process (kKill). What it has published before is still to
/// leave; then it ends itself by the signal, so that the others see the same messages in every run.
struct InjectedKill {
  int signal = 0;
};

/// As the fact has them. Throws std::invalid_argument for a text that is not.
std::vector<Injection> injections_of(const std::string& fact);
std::string fact_of(const std::vector<Injection>& injections);

/// Does to a process's outputs, and to the process, what is to be injected. What is lost here was never sent: sequence
/// numbers have no gap, and every reader, record and expectation sees the same.
class Injector {
 public:
  /// Nothing is injected.
  Injector() = default;
  /// `ports` are its outputs by index. Draws of kDrop follow from the seed, the topic and the number of the message.
  /// `say` is called once for each injection, when it first does something.
  using Say = std::function<void(const std::string& what)>;
  Injector(std::vector<Injection> all, std::string process, std::vector<std::string> ports, std::uint64_t seed,
           Say say);

  /// Publishes one of the process's messages, now.
  using Publish = std::function<void(std::size_t port, msg::Body, msg::Buffer wall_facts)>;

  /// Throws InjectedKill, or stops the process, if it is time; then publishes what has been delayed until now.
  void begin_event(SimTime now, const Publish& publish);
  /// A message of the process's: published, changed, kept for later or lost.
  void pass(SimTime now, std::size_t port, msg::Body body, msg::Buffer wall_facts, const Publish& publish);

 private:
  struct Late {
    SimTime due{0};
    msg::Body body;
    msg::Buffer wall_facts;
  };
  struct Port {
    std::vector<std::size_t> injections;  // about it
    std::uint64_t passed = 0;             // messages
    std::deque<Late> late;
  };
  void say_once(std::size_t injection, const std::string& what);

  std::vector<Injection> all_;
  std::vector<bool> said_;
  std::vector<std::size_t> of_process_;  // kKill and kPause
  std::string process_;
  std::vector<std::string> names_;
  std::vector<Port> ports_;
  std::uint64_t seed_ = 0;
  Say say_;
};

}  // namespace ensonify
