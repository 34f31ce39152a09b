#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>

#include "components/runtime/sim_time.h"
#include "components/runtime/wiring.h"

/// What a picture says of rates, sizes and delays.
namespace ensonify::graph_tool {

/// "100 Hz"; "" when no rate is declared.
inline std::string rate_words(Rate rate) { return rate.num > 0 ? fmt::format("{:g} Hz", rate.hz()) : ""; }

/// "512 B", "17 kB", "4.2 MB": powers of ten.
inline std::string size_words(std::size_t bytes) {
  const auto b = static_cast<double>(bytes);
  return b >= 1e6   ? fmt::format("{:.2g} MB", b * 1e-6)
         : b >= 1e3 ? fmt::format("{:.0f} kB", b * 1e-3)
                    : fmt::format("{} B", bytes);
}

/// "delayed 100 ms"; "" for a plain edge.
inline std::string delay_words(SimTime delay) {
  return delay > SimTime{0} ? fmt::format("delayed {:g} ms", 1e3 * seconds(delay)) : "";
}

}  // namespace ensonify::graph_tool
