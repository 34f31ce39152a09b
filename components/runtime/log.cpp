#include "components/runtime/log.h"

#include <fmt/format.h>

#include <cstdio>

namespace ensonify::log {

void line(const std::string& process, SimTime now, const std::string& event, const std::string& pairs) {
  const std::string text =
      fmt::format("t={:.3f} {} {}{}{}\n", seconds(now), process, event, pairs.empty() ? "" : " ", pairs);
  std::fwrite(text.data(), 1, text.size(), stderr);  // one write per line, so lines of threads do not mix
}

}  // namespace ensonify::log
