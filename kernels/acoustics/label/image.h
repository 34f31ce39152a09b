#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include "kernels/acoustics/echo/image.h"

namespace ensonify::label {

/// A row of a labelled image: a beam, or a side.
struct Row {
  double axis = 0.0;                // sine
  double lower = 0.0, upper = 0.0;  // edges of its cell: which directions are its own in masks
  int sector = 0;                   // strips of the same sector are seen in it
};

/// Power of a row's main lobe to its first nulls, by sine off its axis to either side; even.
struct MainLobe {
  double null = 0.0;
  std::vector<float> power;  // at even steps from the axis to the null

  float at(double off) const {
    const double x = std::abs(off) / null * static_cast<double>(power.size() - 1);
    if (!(x < static_cast<double>(power.size() - 1))) return 0.0F;
    const auto i = static_cast<std::size_t>(x);
    return std::lerp(power[i], power[i + 1], static_cast<float>(x - static_cast<double>(i)));
  }
};

/// Samples of a row from one to before another that belong to something.
struct Run {
  std::uint32_t whose = 0;  // contributor, by the direct path; trace::kNoise: the seabed itself
  std::int32_t row = 0, first = 0, end = 0;

  auto operator<=>(const Run&) const = default;
};

/// The sample that stands for a time: the nearest, as each stands for half a period about its own.
inline std::int32_t sample_at(const echo::Sampling& sampling, double time_s) {
  return static_cast<std::int32_t>(std::floor((time_s - sampling.start_s) / sampling.period_s + 0.5));
}

}  // namespace ensonify::label
