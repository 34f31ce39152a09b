#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace ensonify::relief {

/// e^x: Cephes' expf [Moshier1989] without branches, so that loops over it become vector code. Relative error below
/// 3e-7 for |x| <= 80; x is held within that.
inline float exponential(float x) {
  x = std::min(80.0F, std::max(-80.0F, x));
  const auto n = static_cast<std::int32_t>(x * 1.44269504F + (x < 0.0F ? -0.5F : 0.5F));
  const auto k = static_cast<float>(n);
  const float r = (x - k * 0.693359375F) + k * 2.12194440e-4F;  // ln 2 in two parts
  float p = 1.9875691500e-4F;
  p = p * r + 1.3981999507e-3F;
  p = p * r + 8.3334519073e-3F;
  p = p * r + 4.1665795894e-2F;
  p = p * r + 1.6666665459e-1F;
  p = p * r + 5.0000001201e-1F;
  return (p * r * r + r + 1.0F) * std::bit_cast<float>((n + 127) << 23);
}

}  // namespace ensonify::relief
