#pragma once

#include <complex>
#include <memory>

namespace ensonify::fft {

/// A discrete Fourier transform of one size in float, in place, not scaled. Made once (FFTW, the planner's estimate, so
/// the same on every run on a kind of processor), then used from any thread.
class Transform {
 public:
  enum class Sign { kMinus, kPlus };  // of the exponent: e^(-2 pi i m g / size) or e^(+2 pi i m g / size)

  Transform(int size, Sign sign);

  /// `numbers` must start on a multiple of 16 bytes.
  void operator()(std::complex<float>* numbers) const;

  /// The least size >= `least` that is even and has no prime factor above 5: those are fast.
  static int good_size(int least);

 private:
  struct Plan;
  std::shared_ptr<const Plan> plan_;
};

}  // namespace ensonify::fft
