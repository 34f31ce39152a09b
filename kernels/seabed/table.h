#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "kernels/seabed/law.h"

namespace ensonify::seabed {

/// The steps of a backscatter table. Its variable is v = sin(grazing) / (1 - sin(grazing)), from 2^-16 (grazing 0.0009
/// degrees) to 2^20 (89.92 degrees), cut into a power of two of equal steps per octave, which float arithmetic finds
/// without a logarithm. So steps are proportional to the grazing angle near 0, and to the incidence angle near 90
/// degrees, as the laws need. Outside, the end's value.
class Steps {
 public:
  /// per_octave: a power of two.
  explicit Steps(int per_octave)
      : shift_(23 - std::countr_zero(static_cast<unsigned>(per_octave))),
        within_((1U << shift_) - 1U),
        scale_(1.0F / static_cast<float>(1U << shift_)) {}

  int per_octave() const { return 1 << (23 - shift_); }
  std::size_t count() const { return static_cast<std::size_t>(kEndOctave - kFirstOctave) << (23 - shift_); }

  /// Grazing angle of a place in a step: part 0 is its start.
  double grazing_rad(std::size_t step, double part) const;

  /// Interpolates linearly in v between values at the steps' starts; count() + 2 values, the last two equal.
  /// Any float is taken as a sine: below 0 and NaN as 0, above 1 as 1.
  float look_up(const float* values, float sin_grazing) const {
    const float sine = std::min(std::max(kLeast, sin_grazing), 1.0F);
    const float v = std::min(std::max(kLeast, sine / (1.0F - sine)), kMost);
    const auto place = std::bit_cast<std::uint32_t>(v) - std::bit_cast<std::uint32_t>(kLeast);
    const float* value = values + (place >> shift_);
    return value[0] + static_cast<float>(place & within_) * scale_ * (value[1] - value[0]);
  }

 private:
  static constexpr int kFirstOctave = -16;
  static constexpr int kEndOctave = 20;
  static constexpr float kLeast = 0x1p-16F;
  static constexpr float kMost = 0x1p20F;

  int shift_;  // from the bits of a float to the number of the step
  std::uint32_t within_;
  float scale_;
};

/// The sine for look-ups by angle; the angle is clamped to 0..pi/2.
inline float sine_of(float grazing_rad) {
  return std::sin(std::min(std::max(0.0F, grazing_rad), std::numbers::pi_v<float> / 2.0F));
}

/// Backscatter against grazing angle at one frequency, for millions of look-ups: one division, one step of 8 bytes
/// read, one interpolation. A head makes one for each frequency and class in use.
///
/// Steps are halved until the table is within 0.05 dB of the law in the middle of every step; the error against the law
/// anywhere is then below 0.1 dB, for all sediments and materials, 10..1000 kHz. Strengths below -100 dB count as that.
class BackscatterTable {
 public:
  /// least_per_octave: steps to begin with, a power of two.
  explicit BackscatterTable(const Law& law, int least_per_octave = 8);

  /// Cross section per unit area, a ratio. Never NaN; the sine is clamped to 0..1.
  float operator()(float sin_grazing) const { return steps_.look_up(values_.data(), sin_grazing); }
  float at_angle(float grazing_rad) const { return (*this)(sine_of(grazing_rad)); }

  const Steps& steps() const { return steps_; }
  std::span<const float> values() const { return values_; }  // as Steps::look_up wants them
  double error_db() const { return error_db_; }              // greatest in the middle of a step

 private:
  Steps steps_;
  std::vector<float> values_;
  double error_db_ = 0.0;
};

/// The tables of a whole seabed: the class of a tile's post chooses. All have the same steps.
class ClassTables {
 public:
  /// laws[i] is that of class i; at least one, at most 256. A class that is not listed scatters as class 0.
  /// @throws std::invalid_argument for no law or more than 256.
  explicit ClassTables(std::span<const Law> laws);

  float operator()(std::uint8_t seabed_class, float sin_grazing) const {
    return steps_.look_up(values_.data() + row_start_[seabed_class], sin_grazing);
  }
  float at_angle(std::uint8_t seabed_class, float grazing_rad) const {
    return (*this)(seabed_class, sine_of(grazing_rad));
  }

 private:
  Steps steps_{8};
  std::array<std::uint32_t, 256> row_start_{};
  std::vector<float> values_;
};

}  // namespace ensonify::seabed
