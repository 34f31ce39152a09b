#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

/// Elementary functions as short polynomials without branch or call, so that a loop over them becomes vector code (with
/// -fno-math-errno -fno-trapping-math). Coefficients have the least largest error over the stated interval; errors
/// below are those of the whole function in float, over the whole range (fast_math_test.cpp).
namespace ensonify::fast_math {

/// 2^x. Relative error 2e-7. x below -126 counts as that (1.2e-38), x above 127 as that.
inline float exp2(float x) {
  const float low = x < -126.0F ? -126.0F : x;
  const float in = low > 127.0F ? 127.0F : low;
  const float whole = std::rint(in), r = in - whole;  // -0.5..0.5
  float p = 1.326472731e-3F;
  p = p * r + 9.671512991e-3F;
  p = p * r + 5.550733581e-2F;
  p = p * r + 2.402224243e-1F;
  p = p * r + 6.931470037e-1F;
  p = p * r + 1.0F;
  return p * std::bit_cast<float>((static_cast<std::int32_t>(whole) + 127) << 23);
}

struct Direction {
  float cosine, sine;
};

/// Cosine and sine of 2 pi turns, for turns in -0.5..0.5. Error 2e-7.
inline Direction direction(float turns) {
  const float half_turns = std::rint(2.0F * turns);          // -1, 0 or 1
  const float x = turns - 0.5F * half_turns;                 // -0.25..0.25, exact
  const float sign = 1.0F - 2.0F * half_turns * half_turns;  // of a turn by a half
  const float z = x * x;
  float s = 39.71094894F;
  s = s * z - 76.57499695F;
  s = s * z + 81.60223389F;
  s = s * z - 41.34167862F;
  s = s * z + 6.283185482F;
  float c = -25.0067978F;
  c = c * z + 60.1482048F;
  c = c * z - 85.4538269F;
  c = c * z + 64.93935394F;
  c = c * z - 19.73920822F;
  return {sign * (1.0F + c * z), sign * s * x};
}

/// The part of a turn that a number of cycles leaves, -0.5..0.5: rounded to float after whole cycles are gone, to 3e-8
/// of a cycle. Cycles below 2^52.
inline float part_of_turn(double cycles) { return static_cast<float>(cycles - std::rint(cycles)); }

}  // namespace ensonify::fast_math
