#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "components/record/writer.h"
#include "components/recorder/config.h"
#include "components/runtime/ports.h"

namespace ensonify {

class RecorderNode {
 public:
  using Config = RecorderConfig;
  static constexpr const char* kComponent = "recorder";

  RecorderNode(const Config& config, Ports& ports);

  /// Messages have been appended when it is called; it keeps the period.
  SimTime step(SimTime now);
  /// Completes the file.
  void finish_run();

 private:
  void keep(const msg::Packet& packet);
  record::RecordWriter& open();

  RecorderConfig config_;
  Ports& ports_;
  Periodic due_;
  std::optional<record::RecordWriter> writer_;
  std::map<std::uint32_t, std::uint64_t> every_;  // by topic id
};

}  // namespace ensonify
