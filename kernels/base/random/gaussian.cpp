#include <algorithm>
#include <cmath>

#include "kernels/base/fast_math/fast_math.h"
#include "kernels/base/isa/wide.h"
#include "kernels/base/random/stream.h"

namespace ensonify::random {
namespace {

constexpr std::size_t kBlocks = Stream::Run::kSize;  // a fixed size lets the compiler make vector code of the loops

/// Ten rounds of Philox4x32 [Salmon2011] on counters side by side.
void philox(std::uint64_t key, Stream::Run& counters) {
  auto k0 = static_cast<std::uint32_t>(key), k1 = static_cast<std::uint32_t>(key >> 32);
  auto& [c0, c1, c2, c3] = counters.word;
  for (int round = 0; round < 10; ++round) {
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

}  // namespace

ENSONIFY_WIDE void Stream::run(std::uint64_t a, std::uint64_t b, Run& out) const {
  auto& [c0, c1, c2, c3] = out.word;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    c0[i] = static_cast<std::uint32_t>(a);
    c1[i] = static_cast<std::uint32_t>(a >> 32);
    c2[i] = static_cast<std::uint32_t>(b + i);
    c3[i] = static_cast<std::uint32_t>((b + i) >> 32);
  }
  philox(key_ ^ mix(0), out);
}

ENSONIFY_WIDE void Stream::run(std::span<const std::uint64_t, Run::kSize> a, Run& out) const {
  auto& [c0, c1, c2, c3] = out.word;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    c0[i] = static_cast<std::uint32_t>(a[i]);
    c1[i] = static_cast<std::uint32_t>(a[i] >> 32);
    c2[i] = c3[i] = 0;
  }
  philox(key_ ^ mix(0), out);
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
        const float radius = sd * std::sqrt(-2.0F * fast_math::log(u));
        const fast_math::Direction direction = fast_math::direction_of(bits.word[2 * half + 1][i]);
        re[half][i] = radius * direction.cosine;
        im[half][i] = radius * direction.sine;
      }
    }
    alignas(64) float drawn[4 * kBlocks];  // number by number
    for (std::size_t i = 0; i < kBlocks; ++i) {
      drawn[4 * i] = re[0][i], drawn[4 * i + 1] = im[0][i];
      drawn[4 * i + 2] = re[1][i], drawn[4 * i + 3] = im[1][i];
    }
    const std::size_t count = std::min(2 * kBlocks, numbers.size() - first);
    auto* const sums = reinterpret_cast<float*>(numbers.data() + first);
    for (std::size_t k = 0; k < 2 * count; ++k) sums[k] += drawn[k];
  }
}

}  // namespace ensonify::random
