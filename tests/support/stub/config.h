#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/config/config_reader.h"
#include "components/runtime/sim_time.h"

namespace ensonify {

/// A process that publishes and takes messages of any size and rate, and misbehaves on request: for tests of the
/// runtime and for benchmarks, never part of a survey.
struct StubConfig {
  struct Out {
    std::string port;
    std::string type;
    std::int64_t hz = 10;
    std::int64_t bytes = 16;
  };
  struct In {
    std::string port;
    std::string type;
    double delay_ms = 0.0;
  };
  std::int64_t rate_hz = 10;  // events per second
  std::vector<Out> outs;
  std::vector<In> ins;
  bool read_every_byte = false;    // sums up what arrives, as a real consumer would touch it
  double jitter_ms = 0.0;          // random wall-clock pauses before events, up to this long
  std::optional<double> finish_s;  // asks for the run's end
  std::optional<double> throw_s;   // throws
  std::optional<double> spin_s;    // never returns
  std::optional<double> die_s;     // kills itself with SIGKILL
  std::optional<double> stop_s;    // stops itself with SIGSTOP

  static StubConfig read(ConfigReader& from);
};

}  // namespace ensonify
