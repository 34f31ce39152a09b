#pragma once

#include <vector>

/// Shading: weights of an array's elements that lower its side lobes and broaden its main lobe.
namespace ensonify::array {

/// Names a window. All are symmetric and real; the largest weight is 1.
struct Shading {
  enum class Window { kUniform, kHann, kHamming, kDolphChebyshev, kTaylor };
  Window window = Window::kUniform;
  double side_lobe_db = 30.0;  // main lobe over side lobes, positive, 13..100; Dolph-Chebyshev and Taylor only
  int nbar = 4;                // Taylor only: how many side lobes are held level, the next ones fall as 1 / u

  bool operator==(const Shading&) const = default;
};

/// The least nbar that holds a Taylor line's side lobes at this level: 2 A^2 + 1/2 to the nearest integer, where A is
/// acosh(10^(side_lobe_db/20)) / pi [Taylor1955]. 4 at 30 dB, 12 at 60 dB.
int least_nbar(double side_lobe_db);

/// One weight per element, in their order.
///
/// For n = 0..N-1 and m = n - (N-1)/2:
/// - Hann: cos^2(pi m / (N+1)), without zeros at the ends [Harris1978];
/// - Hamming: 0.54 + 0.46 cos(2 pi m / (N-1)) [Harris1978];
/// - Dolph-Chebyshev: all side lobes exactly at side_lobe_db for any N [Dolph1946];
/// - Taylor: samples at the elements' centres of Taylor's continuous line of length N [Taylor1955]. The highest side
///   lobe is 0 to 0.7 dB below side_lobe_db from 20 to 80 dB (1.4 dB at 13 dB) when N is well above 2 nbar. Needs
///   nbar from least_nbar() to 100.
///
/// Widths and side lobes for N = 128, in degrees times lambda / (N spacing): uniform 50.76 and -13.26 dB, Hann 81.9 and
/// -31.5, Hamming 75.0 and -42.6, Dolph-Chebyshev 30 dB 61.0 and -30, Taylor 30 dB 64.4 and -30.3.
///
/// Throws std::invalid_argument for fewer than one element and for side_lobe_db or nbar outside the ranges above.
std::vector<double> shading_weights(const Shading& shading, int elements);

/// Gain against noise that is independent from element to element, dB: 10 log10[(sum w)^2 / sum w^2]; 10 log10 N when
/// uniform, less with any other shading.
double white_noise_gain_db(const std::vector<double>& weights);

}  // namespace ensonify::array
