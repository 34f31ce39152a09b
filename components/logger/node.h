#pragma once

#include <optional>
#include <string>

#include "components/logger/all_log.h"
#include "components/logger/config.h"
#include "components/record/record_file.h"
#include "components/runtime/ports.h"

namespace ensonify {

/// Writes what the instruments know as hydrographic software reads it.
class LoggerNode {
 public:
  using Config = LoggerConfig;
  static constexpr const char* kComponent = "logger";

  LoggerNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);
  /// Closes the file.
  void finish_run();

 private:
  void check_head() const;
  void put(const formats::Bytes& bytes);

  LoggerConfig config_;
  Ports& ports_;
  Periodic due_;
  std::string file_name_;
  logger::AllLog log_;
  std::optional<frames::LocalProjection> world_;
  std::optional<record::RecordFile> file_;
  std::int64_t counted_ = 0;  // pings left out, as health has it
};

}  // namespace ensonify
