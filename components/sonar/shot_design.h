#pragma once

#include <optional>

#include "components/sonar/settings.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/echo/speckle_cells.h"
#include "kernels/acoustics/trace/ray_distribution.h"

namespace ensonify {

/// Pulse and rays of some pings, and what follows from them.
struct ShotDesign {
  ShotDesign(const echo::Pulse& of_a_point, double sample_period_s, const echo::SpeckleCells& patches,
             const trace::RayDistribution& distribution)
      : pulse(of_a_point),
        sampled(of_a_point, sample_period_s),
        squared(sampled.squared()),
        cells(patches),
        rays(distribution) {}

  echo::Pulse pulse;
  echo::SampledPulse sampled, squared;
  echo::SpeckleCells cells;  // patches of seabed that answer as one point
  trace::RayDistribution rays;
};

/// A head's design for these settings, kept by the caller: head.prepare(settings), made anew where the newest one does
/// not fit.
template <class Head>
const typename Head::Design& design_of(const Head& head, const HeadSettings& settings,
                                       std::optional<typename Head::Design>& newest) {
  if (!newest || !newest->fits(settings)) newest.emplace(head.prepare(settings));
  return *newest;
}

}  // namespace ensonify
