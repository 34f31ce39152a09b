#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "components/runtime/sim_time.h"
#include "messages/codec.h"

namespace ensonify::record_tool {

/// What came of one topic, and what did not, by its seq.
struct Kept {
  std::uint64_t received = 0;
  std::uint64_t missed = 0;  // between the first and the last that came
  std::uint64_t next_seq = 0;
};

/// Puts messages of several publishers, each in its own order, into the order of records: (t_sim, publisher, topic,
/// seq). Holds those of the newest `hold` of sim time, by which one publisher may run ahead of another, but at most
/// `most_bytes`. A message that comes behind its place is missed.
class LiveOrder {
 public:
  using Write = std::function<void(const msg::Packet&)>;

  LiveOrder(Write write, SimTime hold, std::size_t most_bytes);

  void take(msg::Packet packet);
  /// Writes what is held.
  void finish();
  /// By topic, those of which something came.
  const std::map<std::string, Kept>& kept() const { return kept_; }

 private:
  using Place = std::tuple<std::int64_t, std::uint32_t, std::uint32_t, std::uint64_t>;

  void write_first();

  Write write_;
  SimTime hold_;
  std::size_t most_bytes_;
  std::size_t held_bytes_ = 0;
  std::map<Place, msg::Packet> held_;
  Place written_to_{INT64_MIN, 0, 0, 0};
  std::int64_t newest_ns_ = INT64_MIN;
  std::map<std::string, Kept> kept_;
};

struct LiveOptions {
  std::string run;                  // as --run takes it
  std::string file;                 // MCAP
  std::vector<std::string> topics;  // names or patterns; empty: all
  double timeout_s = 0.0;           // wall time after which to stop; 0: at the end of the run
};

struct LiveRecord {
  std::map<std::string, Kept> topics;  // every topic that was asked for
  bool run_ended = false;
  bool reset = false;  // another epoch has begun, which is not in the record
};

/// Records a live run as an observer, from when it runs until it ends or is reset, the time is over or Ctrl-C comes.
/// The run is not slowed; what is missed is counted in the result and in the record, but for what follows the last
/// message that came: of a topic of which nothing came it is not known whether there was any. Throws UserError and
/// DataLost.
LiveRecord record_live(const LiveOptions& options);

}  // namespace ensonify::record_tool
