#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "kernels/acoustics/echo/by_contributor.h"
#include "kernels/acoustics/trace/contributors.h"

namespace ensonify {

/// Mean square that one source of a ping sends to some samples of an image, expected over all draws of speckle and
/// noise: patterns and pulse squared, never the square of one drawn sum. What a smooth body sends has phase: of its
/// facets the square of their sum.
struct SourceEnergy {
  enum class Source : std::uint8_t { kNoise, kVolume, kInterference, kSurface, kContributor };

  Source source = Source::kNoise;
  std::uint32_t contributor = trace::kNoise;  // of kContributor, in the ping's table
  echo::SampleWindow window;                  // of the image's samples; nothing outside
  std::vector<float> upa2;                    // row by sample of the window

  float at(std::int64_t row, int sample) const {
    return upa2[static_cast<std::size_t>(row * window.count() + sample - window.first)];
  }
};

/// Forms mean squares, row by sample of a window, of echoes that are mean squares and of those that are pressures.
using FormEnergies = std::function<std::vector<float>(
    std::span<const echo::EchoSet> echoes, std::span<const echo::EchoSet> coherent, echo::SampleWindow window)>;

/// Appends what arrives, by source: other heads, the surface overhead, contributors. Sets as of one image: mean
/// squares, pressures, and mean squares of other heads.
void add_energies(const echo::EchoSet& echoes, const echo::EchoSet& coherent, const echo::EchoSet& foreign,
                  const echo::SampledPulse& pulse, const echo::Sampling& sampling, const FormEnergies& form,
                  std::vector<SourceEnergy>& energies);

}  // namespace ensonify
