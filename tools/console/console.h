#pragma once

#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/console/desk.h"
#include "tools/console/doors.h"
#include "tools/console/server/server.h"

namespace ensonify::console {

class Viewer;

struct ConsoleOptions {
  std::string first;                  // id of what viewers see when they enter; "": a list
  std::string folder;                 // where records may be opened; "": none
  std::vector<std::string> launches;  // to name, not to start
  RecordOptions record;
  AlarmLimits alarms;
  bool blind = false;  // the truth is withheld: blind.h, and nothing else can be opened
};

/// The desks and the viewers at them. One thread.
class Console {
 public:
  static constexpr std::size_t kMostDesks = 4;
  static constexpr std::size_t kMostViewers = 16;

  Console(ConsoleOptions options, Doors& doors);
  ~Console();

  /// Nothing when there are kMostViewers.
  std::unique_ptr<Visitor> enter(Line& line);
  void leave(Viewer& viewer);
  void tick(WallTime now);
  bool watched() const { return !viewers_.empty(); }

  /// The desk of an item, opened if need be. Throws UserError.
  std::shared_ptr<Desk> desk(const std::string& id);
  const std::string& first() const { return options_.first; }
  /// For who enters from now on.
  void set_first(std::string id) { options_.first = std::move(id); }
  std::vector<msg::ConsoleItem> items() const;
  const std::vector<std::string>& launches() const { return options_.launches; }
  const Doors& doors() const { return doors_; }

  /// The exit code of the run that this console started, once it has ended.
  void set_exit_code(int code) { exit_code_ = code; }
  std::optional<int> exit_code() const { return exit_code_; }
  /// Messages and requests that were refused, by reason.
  void count_refused(const std::string& why) { ++refused_[why]; }
  const std::map<std::string, std::int64_t>& refused() const { return refused_; }

 private:
  ConsoleOptions options_;
  Doors& doors_;
  std::map<std::string, std::shared_ptr<Desk>> desks_;
  std::list<Viewer*> viewers_;
  std::optional<int> exit_code_;
  std::map<std::string, std::int64_t> refused_;
};

}  // namespace ensonify::console
