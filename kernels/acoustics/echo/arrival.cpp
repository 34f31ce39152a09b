#include "kernels/acoustics/echo/arrival.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/echo/run.h"
#include "kernels/acoustics/trace/batch.h"

namespace ensonify::echo {

std::complex<float> echo_pressure(const Carrier& carrier, double mean_square_upa2, double time_s,
                                  std::complex<float> response) {
  if (carrier.sum == Sum::kMeanSquare) return {static_cast<float>(mean_square_upa2), 0.0F};
  const double cycles = carrier.frequency_hz * time_s;
  const auto angle = static_cast<float>(-2.0 * std::numbers::pi * (cycles - std::floor(cycles)));
  const std::complex<float> phasor(std::cos(angle), std::sin(angle));
  const auto amplitude = static_cast<float>(std::sqrt(mean_square_upa2));
  const std::complex<float> turned(phasor.real() * response.real() - phasor.imag() * response.imag(),
                                   phasor.real() * response.imag() + phasor.imag() * response.real());
  return amplitude * turned;
}

void add_direct_echoes(const Carrier& carrier, const frames::Vec3& source_enu_m, const Scatterers& scatterers,
                       const Receivers& receivers, Arrivals& arrivals) {
  const std::size_t before = arrivals.size();
  arrivals.resize(before + scatterers.size());
  for_runs(carrier, receivers, source_enu_m, scatterers, [&](Run& run) {
    run.direct({arrivals, before + run.first()});
  });
}

void TimeIndex::set(std::span<const EchoSet> echoes, const SampledPulse& pulse, const Sampling& sampling,
                    const ContributorSet& whose) {
  constexpr std::size_t kArrivalsPerTask = 8192;
  samples_ = sampling.count;
  blocks_ = (samples_ + kBlock - 1) / kBlock;
  reach_ = (pulse.support() + kBlock - 2) / kBlock;
  std::size_t count = 0;
  for (const EchoSet& set : echoes) count += set.arrivals.size();
  trace::make_elements(received_, count);
  const bool all = whose.all();
  Received* received = received_.data();
  for (std::size_t number = 0; number < echoes.size(); ++number) {
    const Arrivals& arrivals = echoes[number].arrivals;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, arrivals.size(), kArrivalsPerTask),
        [&](const auto& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            if (!all && !whose.holds(arrivals.contributor[i])) {
              received[i].first = samples_;  // left out below, as what comes later than all samples is
              continue;
            }
            const auto place = pulse.place((arrivals.time_s[i] - sampling.start_s) / sampling.period_s);
            received[i] = {place.first, static_cast<std::uint16_t>(place.phase), static_cast<std::uint16_t>(number),
                           static_cast<std::uint32_t>(i)};
          }
        },
        tbb::simple_partitioner());
    received += arrivals.size();
  }
  by_block_.sort(received_, static_cast<std::size_t>(blocks_), [&](const Received& one) {
    const bool outside = one.first >= samples_ || one.first + pulse.support() <= 0;
    return static_cast<std::size_t>(outside ? blocks_ : std::max(one.first, 0) / kBlock);
  });
}

bool TimeIndex::any(int block) const {
  for (int b = first_block(block); b <= block; ++b) {
    if (!by_block_.bucket(static_cast<std::size_t>(b)).empty()) return true;
  }
  return false;
}

}  // namespace ensonify::echo
