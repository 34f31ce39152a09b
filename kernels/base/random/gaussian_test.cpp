#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/base/random/stream.h"

using namespace ensonify::random;
using Catch::WithinAbs;

TEST_CASE("bulk Gaussians are Box and Muller's transform of the stream's bits") {
  const Stream stream{5, "bulk"};
  std::vector<std::complex<float>> numbers(20001);
  add_gaussian(stream, 7, 1000, 2.0F, numbers);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto bits = stream.bits(7, 1000 + k / 2);
    const double u = static_cast<float>((bits[2 * (k % 2)] >> 1) + 0.5) / 0x1p31, turn = bits[2 * (k % 2) + 1] / 0x1p32;
    const double radius = 2.0 * std::sqrt(-2.0 * std::log(u));
    REQUIRE_THAT(numbers[k].real(), WithinAbs(radius * std::cos(2 * std::numbers::pi * turn), 4e-6));
    REQUIRE_THAT(numbers[k].imag(), WithinAbs(radius * std::sin(2 * std::numbers::pi * turn), 4e-6));
  }
}

TEST_CASE("a run is the blocks of its counters, over the edge of 32 bits too") {
  const Stream stream{5, "bulk"};
  Stream::Run run;
  const std::uint64_t a = 0x123456789abcdefULL, b = 0xfffffff0ULL;
  stream.run(a, b, run);
  for (std::size_t i = 0; i < Stream::Run::kSize; ++i)
    for (std::size_t w = 0; w < 4; ++w) REQUIRE(run.word[w][i] == stream.bits(a, b + i)[w]);
}

TEST_CASE("bulk Gaussians do not depend on where a batch begins, and are added") {
  const Stream stream{5, "bulk"};
  std::vector<std::complex<float>> whole(200), part(60, {1.0F, 2.0F});
  add_gaussian(stream, 7, 0, 1.0F, whole);
  add_gaussian(stream, 7, 35, 1.0F, part);
  for (std::size_t k = 0; k < part.size(); ++k) {
    REQUIRE(part[k] == whole[70 + k] + std::complex<float>(1.0F, 2.0F));
  }
}

TEST_CASE("blocks of bits for many counters side by side are those of each") {
  const Stream stream{11, "many"};
  std::array<std::uint64_t, Stream::Run::kSize> counters;
  for (std::size_t i = 0; i < counters.size(); ++i) counters[i] = mix(i + 1);
  Stream::Run run;
  stream.run(counters, run);
  for (std::size_t i = 0; i < counters.size(); ++i) {
    const auto bits = stream.bits(counters[i]);
    for (std::size_t word = 0; word < 4; ++word) REQUIRE(run.word[word][i] == bits[word]);
  }
}
