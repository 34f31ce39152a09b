#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/echo/arrival.h"
#include "kernels/acoustics/echo/image.h"
#include "kernels/acoustics/echo/pulse.h"

namespace ensonify::echo {

/// Arrivals of one contributor, and what patterns make of each: rows as of EchoSet.
struct OfContributor {
  std::uint32_t contributor = 0;
  Arrivals arrivals;
  std::vector<float> gain;

  EchoSet set() const { return {arrivals, gain}; }
};

/// The arrivals of a set apart by contributor, in the order of these; those of one stay in their order.
std::vector<OfContributor> by_contributor(const EchoSet& set);

/// Samples from one to before another.
struct SampleWindow {
  int first = 0, end = 0;

  bool empty() const { return end <= first; }
  int count() const { return end - first; }
  Sampling of(const Sampling& sampling) const {
    return {sampling.start_s, sampling.period_s, count(), sampling.first + first};
  }
};

/// The samples that any of these arrivals reaches, in whole blocks of ByTime: what is formed of them alone is formed in
/// the same steps as all of them.
SampleWindow window_of(std::span<const EchoSet> echoes, const SampledPulse& pulse, const Sampling& sampling);

}  // namespace ensonify::echo
