#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
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
  /// word[w][i] = bits(a[i])[w].
  void run(std::span<const std::uint64_t, Run::kSize> a, Run& out) const;

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

/// Adds complex Gaussians, `sd` per component, to many numbers at once; about five times as fast as normal_pair.
///
/// Number k gets words 2 (k % 2) and 2 (k % 2) + 1 of stream.bits(a, b + k / 2) through Box and Muller's transform
/// [BoxMuller1958] in float, with polynomials (not the system's functions) for logarithm, sine and cosine
/// [Moshier1989]: relative error below 1e-6, the same bits on every machine. At most 6.7 sd.
void add_gaussian(const Stream& stream, std::uint64_t a, std::uint64_t b, float sd,
                  std::span<std::complex<float>> numbers);

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

/// A number of Poisson's distribution from one uniform number in (0, 1), by inversion. For means up to about 100 (the
/// sum starts at e^-mean); at most 1000.
inline int poisson(double mean, double uniform) {
  int count = 0;
  double probability = std::exp(-mean), sum = probability;
  while (uniform > sum && count < 1000) {
    ++count;
    probability *= mean / count;
    sum += probability;
  }
  return count;
}

/// A slowly wandering error: first-order Gauss-Markov, dx/dt = -x / T + white noise, of standard deviation sigma and
/// autocorrelation exp(-|lag| / T) [Brown2012]. Exact for any step. Step n draws number (n, lane) of the stream, so
/// that processes in different lanes are independent.
class GaussMarkov {
 public:
  GaussMarkov() = default;
  /// sigma >= 0, correlation time > 0. Starts in its stationary distribution.
  GaussMarkov(double sigma, double time_s, const Stream& stream, std::uint64_t lane)
      : sigma_(sigma), time_s_(time_s), value_(sigma * stream.normal(0, lane)) {}

  double value() const { return value_; }

  /// The value dt later (>= 0); `n` counts from 1.
  double advance(double dt_s, const Stream& stream, std::uint64_t n, std::uint64_t lane) {
    const double kept = std::exp(-dt_s / time_s_);
    value_ = kept * value_ + sigma_ * std::sqrt(-std::expm1(-2.0 * dt_s / time_s_)) * stream.normal(n, lane);
    return value_;
  }

 private:
  double sigma_ = 0.0;
  double time_s_ = 1.0;
  double value_ = 0.0;
};

}  // namespace ensonify::random
