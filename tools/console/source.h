#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "messages/codec.h"
#include "messages/console.h"
#include "tools/console/flow.h"

namespace ensonify::console {

using Take = std::function<void(msg::Packet)>;

/// Where messages come from: a live run, or a record that is played. None of the calls waits for anybody.
class Source {
 public:
  virtual ~Source() = default;

  /// Kind, name, state and topics; what is the viewer's own stays empty.
  virtual msg::ConsoleState state() const = 0;
  /// Axis from which the beam angles of a head count: "down" or "forward".
  virtual std::string beam_axis(const std::string& publisher) const = 0;
  /// The topics that somebody watches, by their names in the run; none: the source may rest.
  virtual void want(const std::set<std::string>& topics) = 0;
  /// Folder of the run's results or of the record; empty: not known.
  virtual std::string folder() const = 0;
  /// Text of the scenario; empty: not known. It holds the truth, and goes to no viewer.
  virtual std::string scenario() const { return ""; }
  /// Hands over what has come, for at most `budget` of wall time.
  virtual void poll(WallTime now, std::chrono::milliseconds budget, const Take& take) = 0;
  /// Throws UserError for what cannot be done.
  virtual void command(const msg::ConsoleCommand& command) = 0;
};

struct RecordOptions {
  double speed = 1.0;  // sim seconds per wall second; 0: as fast as viewers' requests allow
  bool loop = false;   // from the start again at its end; times and numbers go on
};

/// A live run by what `--run` takes; waits for one that is not there yet, and for its name to come back.
std::unique_ptr<Source> live_source(const std::string& run);
/// Throws UserError for a file that is no record.
std::unique_ptr<Source> record_source(const std::string& file, const RecordOptions& options);

}  // namespace ensonify::console
