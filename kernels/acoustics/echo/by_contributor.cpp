#include "kernels/acoustics/echo/by_contributor.h"

#include <algorithm>
#include <limits>
#include <map>

#include "kernels/acoustics/echo/time_index.h"

namespace ensonify::echo {

std::vector<OfContributor> by_contributor(const EchoSet& set) {
  const Arrivals& all = set.arrivals;
  std::map<std::uint32_t, std::size_t> counts;
  for (const std::uint32_t contributor : all.contributor) ++counts[contributor];
  const std::size_t rows = all.empty() ? 0 : set.gain.size() / all.size();
  std::vector<OfContributor> parts(counts.size());
  std::map<std::uint32_t, std::size_t> parts_of;
  for (const auto& [contributor, count] : counts) {
    OfContributor& part = parts[parts_of.size()];
    part.contributor = contributor;
    part.arrivals.resize(count);
    part.gain.resize(rows * count);
    parts_of.emplace(contributor, parts_of.size());
  }
  std::vector<std::size_t> filled(parts.size());
  auto newest = parts_of.end();  // neighbours mostly have one contributor
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (newest == parts_of.end() || newest->first != all.contributor[i]) newest = parts_of.find(all.contributor[i]);
    OfContributor& part = parts[newest->second];
    const std::size_t place = filled[newest->second]++;
    part.arrivals.set(place, all[i]);
    for (std::size_t row = 0; row < rows; ++row)
      part.gain[row * part.arrivals.size() + place] = set.gain[row * all.size() + i];
  }
  return parts;
}

SampleWindow window_of(std::span<const EchoSet> echoes, const SampledPulse& pulse, const Sampling& sampling) {
  constexpr int kBlock = TimeIndex::kBlock;
  SampleWindow window{std::numeric_limits<int>::max(), 0};
  for (const EchoSet& set : echoes) {
    for (const double time_s : set.arrivals.time_s) {
      const int first = pulse.place((time_s - sampling.start_s) / sampling.period_s).first - sampling.first;
      if (first >= sampling.count || first + pulse.support() <= 0) continue;
      window.first = std::min(window.first, first);
      window.end = std::max(window.end, first + pulse.support());
    }
  }
  if (window.empty()) return {};
  window.first = std::max(window.first, 0) / kBlock * kBlock;
  window.end = std::min((window.end + kBlock - 1) / kBlock * kBlock, sampling.count);
  return window;
}

}  // namespace ensonify::echo
