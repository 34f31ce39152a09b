#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/nav_out/config.h"
#include "components/nav_out/instruments.h"
#include "components/nav_out/pace.h"
#include "components/nav_out/sinks.h"
#include "components/nav_out/vessels.h"
#include "components/runtime/ports.h"
#include "messages/feed.h"

namespace ensonify {

/// Says what the vehicle's instruments measure, as instruments say it: sentences and frames to those that the launch
/// file names.
class NavOutNode {
 public:
  using Config = NavOutConfig;
  static constexpr const char* kComponent = "nav_out";

  NavOutNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);
  void finish_run();

 private:
  /// One kind of sentence of one output.
  struct Line {
    std::size_t output;
    nav_out::KindInfo kind;
    double hz;
    std::optional<nav_out::Pace> pace;  // of an instrument, from the first event on
    std::optional<Periodic> due;        // of the clock
  };
  struct Waiting {
    SimTime leaves;
    std::size_t output;
    std::string bytes;
  };

  void connect();
  void begin();
  template <class Message>
  void measured(nav_out::Source source, const Message& message);
  void report_vessels();
  void say_time(SimTime now);
  void send_due(SimTime now);
  void count_sent();
  double highest_hz(nav_out::Source source) const;
  bool says(nav_out::Source source) const { return highest_hz(source) > 0.0; }

  Config config_;
  Ports& ports_;
  Periodic due_;
  nav_out::Instruments instruments_;
  std::vector<Line> lines_;
  std::vector<Waiting> fresh_;                  // said at this event
  std::multimap<SimTime, Waiting> waiting_;     // in the order in which they were said
  std::optional<nav_out::Vessels> vessels_;     // with VDM, from the first event on
  std::optional<nav_out::Sinks> sinks_;         // from the first event on: a check of the launch file takes no port
  std::map<std::string, std::int64_t> counts_;  // of health
  Ports::Out<msg::FeedData> sent_;
  bool compass_ = false;
};

}  // namespace ensonify
