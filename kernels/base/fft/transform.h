#pragma once

#include <complex>
#include <memory>
#include <span>

namespace ensonify::fft {

/// A discrete Fourier transform of one size in float, not scaled. Made once (FFTW, the planner's estimate, so
/// the same on every run on a kind of processor), then used from any thread.
class Transform {
 public:
  enum class Sign { kMinus, kPlus };  // of the exponent: e^(-2 pi i m g / size) or e^(+2 pi i m g / size)

  Transform(int size, Sign sign);

  /// In place; `numbers` must start on a multiple of 16 bytes.
  void operator()(std::complex<float>* numbers) const;
  /// From one place to another that does not overlap it, each on a multiple of 16 bytes: up to twice as fast.
  void operator()(const std::complex<float>* from, std::complex<float>* to) const;

  /// The least size >= `least` that is even and has no prime factor above 5: those are fast.
  static int good_size(int least);

  /// The least size >= `least` of a transform that is fast for its size: a multiple of 8 with at most one factor 3 and
  /// none above 5. FFTW's estimate takes 205 ns for 240 numbers and 500 ns for 216 (8 x 27) or 250.
  static int fast_size(int least);

 private:
  struct Plan;
  std::shared_ptr<const Plan> plan_;
};

/// The two-dimensional transform of `rows` rows of `columns` numbers, in place, not scaled. `columns` must be even and
/// the first number must lie on a multiple of 16 bytes.
void transform_plane(std::span<std::complex<float>> numbers, int columns, int rows, Transform::Sign sign);

}  // namespace ensonify::fft
