#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/config/parameters.h"
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

    static void parameters(auto& self, auto&& visit) {
      visit("port", "", must(any()), "name of the port", self.port);
      visit("type", "", must(any()), "type of its messages", self.type);
      visit("hz", "Hz", in(1, 1000), "messages per second", self.hz);
      visit("bytes", "", in(0, 100'000'000), "size of a message", self.bytes);
    }
  };
  struct In {
    std::string port;
    std::string type;
    double delay_ms = 0.0;

    static void parameters(auto& self, auto&& visit) {
      visit("port", "", must(any()), "name of the port", self.port);
      visit("type", "", must(any()), "type of its messages", self.type);
      visit("delay_ms", "", in(0, 10000), "milliseconds of sim time", self.delay_ms);
    }
  };
  std::int64_t rate_hz = 10;
  std::vector<Out> outs;
  std::vector<In> ins;
  bool read_every_byte = false;
  double jitter_ms = 0.0;
  double first_ms = 0.0;
  std::optional<double> finish_s, throw_s, spin_s, die_s, stop_s;

  static void parameters(auto& self, auto&& visit) {
    const Allowed time = in(0, 1e6);
    visit("rate_hz", "Hz", in(1, 1000), "events per second", self.rate_hz);
    visit("out", "ports that it publishes on", self.outs);
    visit("in", "ports that it takes from", self.ins);
    visit("read_every_byte", "", any(), "sums up what arrives, as a real consumer would touch it",
          self.read_every_byte);
    visit("jitter_ms", "", in(0, 1000), "random wall-clock pauses before events, up to so many milliseconds",
          self.jitter_ms);
    visit("first_ms", "", in(0, 10000), "wall-clock milliseconds that its event at 0 takes", self.first_ms);
    visit("finish_s", "s", time, "asks for the run's end", self.finish_s);
    visit("throw_s", "s", time, "throws", self.throw_s);
    visit("spin_s", "s", time, "never returns", self.spin_s);
    visit("die_s", "s", time, "kills itself with SIGKILL", self.die_s);
    visit("stop_s", "s", time, "stops itself with SIGSTOP", self.stop_s);
  }

  static StubConfig read(ConfigReader& from);
};

}  // namespace ensonify
