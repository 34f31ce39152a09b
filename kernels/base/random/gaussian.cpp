#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "kernels/base/random/stream.h"

namespace ensonify::random {
namespace {

/// ln(x) for normal x > 0: Cephes' logf [Moshier1989], without branches so that loops over it become vector code.
inline float natural_log(float x) {
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

struct Direction {
  float cosine, sine;
};

/// Cosine and sine of 2 pi turn / 2^32: quadrant from the top bits, Cephes' polynomials within +-pi/4 of it.
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

constexpr std::size_t kBlocks = Stream::Run::kSize;  // a fixed size lets the compiler make vector code of the loops

}  // namespace

void Stream::run(std::uint64_t a, std::uint64_t b, Run& out) const {
  const std::uint64_t key = key_ ^ mix(0);
  auto k0 = static_cast<std::uint32_t>(key), k1 = static_cast<std::uint32_t>(key >> 32);
  auto& [c0, c1, c2, c3] = out.word;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    c0[i] = static_cast<std::uint32_t>(a);
    c1[i] = static_cast<std::uint32_t>(a >> 32);
    c2[i] = static_cast<std::uint32_t>(b + i);
    c3[i] = static_cast<std::uint32_t>((b + i) >> 32);
  }
  for (int round = 0; round < 10; ++round) {  // [Salmon2011], Philox4x32-10
    for (std::size_t i = 0; i < kBlocks; ++i) {
      const std::uint64_t p0 = std::uint64_t{0xD2511F53U} * c0[i], p1 = std::uint64_t{0xCD9E8D57U} * c2[i];
      const std::uint32_t n0 = static_cast<std::uint32_t>(p1 >> 32) ^ c1[i] ^ k0;
      const std::uint32_t n2 = static_cast<std::uint32_t>(p0 >> 32) ^ c3[i] ^ k1;
      c1[i] = static_cast<std::uint32_t>(p1);
      c3[i] = static_cast<std::uint32_t>(p0);
      c0[i] = n0;
      c2[i] = n2;
    }
    k0 += 0x9E3779B9U;
    k1 += 0xBB67AE85U;
  }
}

void add_gaussian(const Stream& stream, std::uint64_t a, std::uint64_t b, float sd,
                  std::span<std::complex<float>> numbers) {
  Stream::Run bits;
  float re[2][kBlocks], im[2][kBlocks];
  for (std::size_t first = 0; first < numbers.size(); first += 2 * kBlocks) {
    stream.run(a, b + first / 2, bits);
    for (std::size_t half = 0; half < 2; ++half) {
      for (std::size_t i = 0; i < kBlocks; ++i) {
        const auto whole = static_cast<std::int32_t>(bits.word[2 * half][i] >> 1);
        const float u = (static_cast<float>(whole) + 0.5F) * 0x1p-31F;  // 0 < u <= 1
        const float radius = sd * std::sqrt(-2.0F * natural_log(u));
        const Direction direction = direction_of(bits.word[2 * half + 1][i]);
        re[half][i] = radius * direction.cosine;
        im[half][i] = radius * direction.sine;
      }
    }
    const std::size_t count = std::min(2 * kBlocks, numbers.size() - first);
    for (std::size_t k = 0; k < count; ++k)
      numbers[first + k] += std::complex<float>(re[k % 2][k / 2], im[k % 2][k / 2]);
  }
}

}  // namespace ensonify::random
