#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

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

/// The same of 2 pi turn / 2^32: quadrant from the top bits, Cephes' polynomials [Moshier1989] within +-pi/4 of it.
inline Direction direction_of(std::uint32_t turn) {
  const std::uint32_t quadrant = (turn + 0x20000000U) >> 30;
  const auto rest = static_cast<std::int32_t>(turn - (quadrant << 30));
  const float x = static_cast<float>(rest) * (std::numbers::pi_v<float> * 0x1p-31F);
  const float z = x * x;
  const float s = x + x * z * (-1.6666654611e-1F + z * (8.3321608736e-3F - z * 1.9515295891e-4F));
  const float c = 1.0F - 0.5F * z + z * z * (4.166664568e-2F + z * (-1.388731625e-3F + z * 2.443315711e-5F));
  const bool swap = (quadrant & 1U) != 0;
  const float cosine = swap ? s : c, sine = swap ? c : s;
  return {((quadrant + 1U) & 2U) != 0 ? -cosine : cosine, (quadrant & 2U) != 0 ? -sine : sine};
}

/// The angle of (x, y) in turns, -0.5..0.5, 0 for (0, 0): [Abramowitz1964], 4.4.49. Error 6e-8 turns
/// for lengths of 1e-20 to 1e37.
inline float turns_of(float x, float y) {
  const float across = std::abs(x), up = std::abs(y);
  const bool steep = up > across;
  const float more = steep ? up : across, less = steep ? across : up;
  const float r = less / (more + 1e-37F), z = r * r;
  float p = 0.0028662257F;
  p = p * z - 0.0161657367F;
  p = p * z + 0.0429096138F;
  p = p * z - 0.0752896400F;
  p = p * z + 0.1065626393F;
  p = p * z - 0.1420889944F;
  p = p * z + 0.1999355085F;
  p = p * z - 0.3333314528F;
  const float flat = (r + r * (z * p)) * (0.5F * std::numbers::inv_pi_v<float>);  // 0..1/8
  const float quarter = steep ? 0.25F - flat : flat;
  const float half = x < 0.0F ? 0.5F - quarter : quarter;
  return std::copysign(half, y);
}

/// ln(x) for normal x > 0: Cephes' logf [Moshier1989]. Relative error 2e-7; where ln(x) is near 0, error 1e-8.
inline float log(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  const float mantissa = std::bit_cast<float>((bits & 0x007fffff) | 0x3f800000);  // 1..2
  const bool upper = mantissa > std::numbers::sqrt2_v<float>;
  const float m = (upper ? 0.5F * mantissa : mantissa) - 1.0F;
  const float e = static_cast<float>((bits >> 23) - 127) + (upper ? 1.0F : 0.0F);
  float p = 7.0376836292e-2F;
  p = p * m - 1.1514610310e-1F;
  p = p * m + 1.1676998740e-1F;
  p = p * m - 1.2420140846e-1F;
  p = p * m + 1.4249322787e-1F;
  p = p * m - 1.6668057665e-1F;
  p = p * m + 2.0000714765e-1F;
  p = p * m - 2.4999993993e-1F;
  p = p * m + 3.3333331174e-1F;
  const float square = m * m;
  const float tail = p * m * square - 2.12194440e-4F * e - 0.5F * square;
  return (m + tail) + 0.693359375F * e;  // ln 2 in two parts
}

/// The part of a turn that a number of cycles leaves, -0.5..0.5: rounded to float after whole cycles are gone, to 3e-8
/// of a cycle. Cycles below 2^52.
inline float part_of_turn(double cycles) { return static_cast<float>(cycles - std::rint(cycles)); }

}  // namespace ensonify::fast_math
