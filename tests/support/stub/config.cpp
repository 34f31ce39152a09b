#include "tests/support/stub/config.h"

namespace ensonify {

StubConfig StubConfig::read(ConfigReader& from) {
  StubConfig config;
  from.optional("rate_hz", config.rate_hz, 1, 1000);
  from.optional("read_every_byte", config.read_every_byte);
  from.optional("jitter_ms", config.jitter_ms, 0.0, 1000.0);
  const auto time = [&](const char* key, std::optional<double>& at_s) {
    if (!from.has(key)) return;
    at_s.emplace();
    from.required(key, *at_s, 0.0, 1e6);
  };
  time("finish_s", config.finish_s);
  time("throw_s", config.throw_s);
  time("spin_s", config.spin_s);
  time("die_s", config.die_s);
  time("stop_s", config.stop_s);
  for (ConfigReader& item : from.list("out")) {
    Out out;
    item.required("port", out.port);
    item.required("type", out.type);
    item.optional("hz", out.hz, 1, 1000);
    item.optional("bytes", out.bytes, 0, 100'000'000);
    config.outs.push_back(out);
  }
  for (ConfigReader& item : from.list("in")) {
    In in;
    item.required("port", in.port);
    item.required("type", in.type);
    item.optional("delay_ms", in.delay_ms, 0.0, 10000.0);
    config.ins.push_back(in);
  }
  return config;
}

}  // namespace ensonify
