#pragma once

#include <string>
#include <vector>

#include "components/errors/exit_error.h"

namespace ensonify {

/// Place of a value: in a file (line and column count from 1), or on the command line (line 0, `file` is then the
/// option as it was typed, e.g. "--set bow.frequency_hz").
struct ConfigPlace {
  std::string file;
  int line = 0;
  int column = 0;

  bool operator==(const ConfigPlace&) const = default;
};

/// One mistake in a user's file. `key` is the path from the root of the document, e.g. "mission.runlines[2].to_m".
struct ConfigProblem {
  ConfigPlace place;
  std::string key;
  std::string message;

  /// "head.yaml:1:15: frequency_hz: 50000 is outside [100000, 1e+06]".
  std::string text() const;
};

/// Everything that is wrong with what the user wrote, sorted by place. what() is one line per problem. Exit code 2.
class ConfigError : public UserError {
 public:
  explicit ConfigError(std::vector<ConfigProblem> problems);

  const std::vector<ConfigProblem>& problems() const { return problems_; }

 private:
  std::vector<ConfigProblem> problems_;
};

}  // namespace ensonify
