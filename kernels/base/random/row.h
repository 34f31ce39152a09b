#pragma once

#include <array>
#include <cstdint>

#include "kernels/base/random/stream.h"

namespace ensonify::random {

/// A row of blocks of random bits, for a tenth of the cost of a stream's: two 64-bit mixes [Steele2014] each. For
/// places and dither, of which many are examined and few used.
class Row {
 public:
  /// Row `a` of the stream.
  Row(const Stream& stream, std::uint64_t a) {
    const auto key = stream.bits(a);
    key_ = key[0] | std::uint64_t{key[1]} << 32;
  }

  /// 128 random bits.
  std::array<std::uint32_t, 4> bits(std::uint64_t b) const {
    constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ULL;  // of SplitMix64
    const std::uint64_t first = mix(key_ + 2 * b * kStep), second = mix(key_ + (2 * b + 1) * kStep);
    return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(first >> 32),
            static_cast<std::uint32_t>(second), static_cast<std::uint32_t>(second >> 32)};
  }

 private:
  std::uint64_t key_;
};

}  // namespace ensonify::random
