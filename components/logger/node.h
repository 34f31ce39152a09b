#pragma once

#include <map>
#include <optional>
#include <string>

#include "components/logger/config.h"
#include "components/logger/log_files.h"
#include "components/logger/sent_files.h"
#include "components/logger/survey_log.h"
#include "components/logger/xtf/sidescan_assembly.h"
#include "components/runtime/ports.h"

namespace ensonify {

/// Writes what the instruments know as hydrographic software reads it, and sends it to those that the launch file
/// names.
class LoggerNode {
 public:
  using Config = LoggerConfig;
  static constexpr const char* kComponent = "logger";

  LoggerNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);
  /// Ends the files.
  void finish_run();

 private:
  void check_head() const;
  logger::SurveyLog& log();
  void count_sent();

  LoggerConfig config_;
  Ports& ports_;
  Periodic due_;
  logger::LogFiles files_;
  std::optional<logger::SentFiles> sent_;  // where there are receivers
  std::optional<logger::SurveyLog> log_;   // made for the first message, when it is known who declares what
  std::optional<logger::SidescanAssembly> sidescan_;
  std::optional<frames::LocalProjection> world_;
  std::int64_t counted_ = 0;                         // pings left out, as health has it
  std::map<std::string, std::int64_t> sent_counts_;  // of streams, as health has them
};

}  // namespace ensonify
