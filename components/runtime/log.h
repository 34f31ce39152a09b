#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "components/errors/printable.h"
#include "components/runtime/ports.h"

namespace ensonify::log {

/// One event, one line, with sim time: `t=12.340 bow late_ping ping=57 by_s=0.0031`. To standard error, which the
/// launcher keeps as `<out>/log/<process>.log`. `event` is one word; the rest are key=value pairs.
inline void line(const std::string& process, SimTime now, const std::string& event, const std::string& pairs) {
  const std::string text =
      printable(fmt::format("t={:.3f} {} {}{}{}\n", seconds(now), process, event, pairs.empty() ? "" : " ", pairs));
  std::fwrite(text.data(), 1, text.size(), stderr);  // one write per line, so lines of threads do not mix
}

/// log::event(ports, "late_ping", "ping={} by_s={:.4f}", ping, late_s);
template <class... Args>
void event(const Ports& ports, const std::string& name, fmt::format_string<Args...> pairs, Args&&... args) {
  line(ports.process(), ports.now(), name, fmt::format(pairs, std::forward<Args>(args)...));
}
inline void event(const Ports& ports, const std::string& name) { line(ports.process(), ports.now(), name, ""); }

}  // namespace ensonify::log
