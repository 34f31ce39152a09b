#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "components/runtime/protocol.h"
#include "components/runtime/rate_limit.h"
#include "components/runtime/wiring.h"

namespace ensonify::clock {

/// Grants that a participant may be given while its time moves by less than its finest period.
inline constexpr int kMostGrantsPerPeriod = 1000;

/// What a participant did that ends the run.
struct Breach {
  int code = 0;
  std::string text;  // "broke the protocol: DONE: ...", to be said of the process
};

/// Judges each DONE before anything follows from it, so that the process that is wrong is named and nobody else.
class Referee {
 public:
  Referee(std::uint32_t epoch, const Graph& graph, const std::vector<Declaration>& processes);

  /// What is wrong with this answer of `rank`, which had promised `promised` and was granted time up to `granted`. What
  /// is not wrong is counted.
  std::optional<Breach> judge(std::size_t rank, const protocol::Done& done, SimTime promised, SimTime granted);

  /// Messages published on a topic, as of the last DONE.
  std::uint64_t published(std::size_t topic) const { return topics_[topic].published; }

 private:
  struct Topic {
    std::string name;
    std::size_t publisher = 0;
    RateLimit limit;
    std::uint64_t published = 0;
  };
  struct Runner {
    bool may_finish = false;
    SimTime finest{0};        // its shortest period
    SimTime counted_from{0};  // its time when `grants` began
    int grants = 0;
  };
  std::optional<Breach> count(std::size_t rank, const protocol::Done& done, SimTime until);
  std::optional<Breach> watch_creep(std::size_t rank, SimTime next);

  std::uint32_t epoch_;
  std::vector<Topic> topics_;
  std::vector<Runner> runners_;
};

}  // namespace ensonify::clock
