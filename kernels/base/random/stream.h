#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ensonify::random {

/// A random function of up to three counters: the same arguments give the same value, in any order, on any thread.
///
/// Philox4x32-10 [Salmon2011], keyed by a stable 64-bit hash of (seed, name). The counters are whole numbers that say
/// what the value belongs to, for example (ping, beam, sample); negative ones are taken modulo 2^64. Streams of
/// different names are independent, so a new consumer never changes the numbers of an old one.
class Stream {
 public:
  Stream(std::uint64_t seed, std::string_view name);

  /// 128 random bits.
  std::array<std::uint32_t, 4> bits(std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0) const;

  /// Blocks of bits side by side, so that the compiler can make vector code of what follows.
  struct Run {
    static constexpr std::size_t kSize = 32;
    std::array<std::array<std::uint32_t, kSize>, 4> word;
  };

  /// word[w][i] = bits(a, b + i)[w], three times as fast.
  void run(std::uint64_t a, std::uint64_t b, Run& out) const;

  /// Uniform in the open interval (0, 1), on a lattice of step 2^-52.
  double uniform(std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0) const;

  /// Gaussian with mean 0 and standard deviation 1 (Box and Muller [BoxMuller1958]); finite, |x| < 8.7.
  double normal(std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0) const;

  /// Two independent Gaussians for the price of one; the first is normal(a, b, c).
  std::array<double, 2> normal_pair(std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0) const;

 private:
  std::uint64_t key_;
};

/// One block of Philox4x32-10 [Salmon2011]; public for its known-answer test and for bulk noise.
std::array<std::uint32_t, 4> philox_block(const std::array<std::uint32_t, 4>& counter,
                                          const std::array<std::uint32_t, 2>& key);

/// A 64-bit mix in which every input bit reaches every output bit; one-to-one, and mix(0) = 0 [Steele2014].
constexpr std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace ensonify::random
