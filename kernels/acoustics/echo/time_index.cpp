#include "kernels/acoustics/echo/time_index.h"

namespace ensonify::echo {

void TimeIndex::set(std::span<const EchoSet> echoes, const SampledPulse& pulse, const Sampling& sampling) {
  const auto each = [&](std::size_t begin, std::size_t end, const auto& add) {
    for_sets(echoes, begin, end, [&](std::size_t number, std::size_t first, std::size_t last, std::size_t row) {
      const double* const time_s = echoes[number].arrivals.time_s.data();
      for (std::size_t i = first; i < last; ++i) {
        const auto at = pulse.place((time_s[i] - sampling.start_s) / sampling.period_s);
        add(row++, Received{at.first - sampling.first, static_cast<std::uint16_t>(at.phase),
                            static_cast<std::uint16_t>(number), static_cast<std::uint32_t>(i)});
      }
    });
  };
  ByTime::set(
      count_arrivals(echoes), pulse, sampling.count,
      [&](std::size_t begin, std::size_t end, std::int32_t* first) {
        each(begin, end, [first](std::size_t row, const Received& received) { first[row] = received.first; });
      },
      [&](std::size_t begin, std::size_t end, Received* rows) {
        each(begin, end, [rows](std::size_t row, const Received& received) { rows[row] = received; });
      });
}

}  // namespace ensonify::echo
