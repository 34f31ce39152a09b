#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "messages/console.h"

namespace ensonify::console {

/// The newest lines of the logs in a folder, PROCESS.log, as they grow. Links are not followed. Viewers fetch what is
/// new to them.
class Logs {
 public:
  static constexpr std::size_t kMostFiles = 64;
  static constexpr std::size_t kMostLines = 1000;       // kept, of all files
  static constexpr std::size_t kMostLinesAtOnce = 200;  // in one message
  static constexpr std::size_t kMostBytes = 500;        // of a line
  static constexpr std::size_t kMostRead = 64 * 1024;   // of a file at once, and of what was there before

  /// Reads what is new. Another folder, or a file that has become shorter, begins anew.
  void read(const std::string& folder);
  void clear();

  /// How far a viewer has come.
  struct Seen {
    std::int64_t generation = 0;
    std::int64_t lines = 0;
  };
  std::optional<msg::ConsoleLog> news(Seen& seen) const;

 private:
  struct File {
    std::int64_t at = -1;  // -1: not read yet
    std::string rest;      // a line without its end
    double time_s = 0.0;   // of the line before
  };
  struct Line {
    double time_s = 0.0;
    msg::ConsoleLogLine line;
  };

  bool read_file(const std::string& path, const std::string& process, std::deque<Line>& fresh);

  std::int64_t generation_ = 1;
  std::string folder_;
  std::map<std::string, File> files_;  // by process
  std::deque<msg::ConsoleLogLine> lines_;
  std::int64_t first_ = 0;  // index of the oldest
};

/// error, warning or info, by the words of a line.
std::string level_of(const std::string& line);

}  // namespace ensonify::console
