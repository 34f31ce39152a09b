#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "components/record/reader.h"
#include "components/replay/config.h"
#include "components/runtime/ports.h"

namespace ensonify {

class ReplayNode {
 public:
  using Config = ReplayConfig;
  static constexpr const char* kComponent = "replay";

  /// Reads the whole record once: its topics are the ports, its densest second their rate.
  ReplayNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);

 private:
  void declare_ports();
  void declare_again();
  std::string port_of(const std::string& topic) const;
  void check_topics() const;
  bool read_next();

  ReplayConfig config_;
  Ports& ports_;
  record::RecordReader reader_;
  std::map<std::uint16_t, std::size_t> out_of_;  // channel -> index of the port
  record::RecordedMessage next_;
  bool has_next_ = false;
};

}  // namespace ensonify
