#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "kernels/acoustics/echo/image.h"

using namespace ensonify::echo;
using ensonify::random::Stream;

static Image silence(int beams, int samples) {
  return {beams, samples, std::vector<std::complex<float>>(static_cast<std::size_t>(beams) * samples)};
}

TEST_CASE("noise has its level, exponential power, and no correlation of samples or beams") {
  Image image = silence(20, 5001);
  add_noise(40.0, 3, Stream{1, "noise"}, image);
  const double n = 20 * 5001;  // power is exponential: sd of its mean 1/sqrt(n) = 0.3 %, of its mean square 1.4 %; 4 sd
  double power = 0, square = 0, parts = 0, neighbours = 0, across = 0;
  for (int b = 0; b < 20; ++b)
    for (int k = 0; k < 5001; ++k) {
      const auto p = image.row(b)[k];
      power += std::norm(p);
      square += std::norm(p) * std::norm(p);
      parts += p.real() * p.imag();
      if (k > 0) neighbours += (p * std::conj(image.row(b)[k - 1])).real();
      if (b > 0) across += (p * std::conj(image.row(b - 1)[k])).real();
    }
  CHECK(power / n == Approx(1e4).epsilon(0.013));
  CHECK(square / n == Approx(2e8).epsilon(0.06));
  CHECK(std::abs(parts / n) < 0.013 * 0.5e4);
  CHECK(std::abs(neighbours / n) < 0.013 * 1e4);
  CHECK(std::abs(across / n) < 0.013 * 1e4);
}

TEST_CASE("noise is a function of ping, beam and sample, for any number of threads") {
  const auto noise = [](std::uint64_t ping, int beams, int samples, std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Image image = silence(beams, samples);
    add_noise(40.0, ping, Stream{1, "noise"}, image);
    return image;
  };
  const Image a = noise(3, 8, 100, 1);
  CHECK(a.envelope_upa == noise(3, 8, 100, 2).envelope_upa);
  CHECK(a.row(5)[42] == noise(3, 6, 43, 1).row(5)[42]);
  CHECK(a.row(5)[42] != noise(4, 8, 100, 1).row(5)[42]);
}

TEST_CASE("no noise is no noise") {
  Image image = silence(2, 10);
  add_noise(-std::numeric_limits<double>::infinity(), 0, Stream{1, "noise"}, image);
  for (const auto p : image.envelope_upa) CHECK(p == std::complex<float>{});
}
