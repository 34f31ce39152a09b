#include "kernels/base/fft/transform.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

using namespace ensonify::fft;
using Catch::WithinAbs;

TEST_CASE("a wave becomes one line, where its sign says") {
  const int size = 30, wave = 7;
  std::vector<std::complex<float>> numbers;
  for (int i = 0; i < size; ++i)
    numbers.emplace_back(std::polar(1.0F, static_cast<float>(2 * std::numbers::pi * wave * i / size)));
  auto apart = numbers;
  Transform(size, Transform::Sign::kMinus)(numbers.data(), apart.data());
  CHECK(std::abs(numbers[1] - std::polar(1.0F, static_cast<float>(2 * std::numbers::pi * wave / size))) < 1e-6F);
  Transform(size, Transform::Sign::kMinus)(numbers.data());
  for (int i = 0; i < size; ++i) {
    INFO("line " << i);  // float's rounding grows as the root of log2(size): below 1e-5 of 30
    CHECK_THAT(std::abs(numbers[static_cast<std::size_t>(i)]), WithinAbs(i == wave ? size : 0.0, 1e-4));
    CHECK_THAT(std::abs(apart[static_cast<std::size_t>(i)]), WithinAbs(i == wave ? size : 0.0, 1e-4));
  }
}

TEST_CASE("a plane wave becomes one number of the plane") {
  const int columns = 20, rows = 15;
  std::vector<std::complex<float>> numbers;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i)
      numbers.emplace_back(
          std::polar(1.0F, static_cast<float>(2 * std::numbers::pi * (3.0 * i / columns + 4.0 * j / rows))));
  }
  transform_plane(numbers, columns, rows, Transform::Sign::kMinus);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      INFO(i << ", " << j);
      CHECK_THAT(std::abs(numbers[static_cast<std::size_t>(j * columns + i)]),
                 WithinAbs(i == 3 && j == 4 ? 300.0 : 0.0, 1e-3));
    }
  }
}

TEST_CASE("good sizes are even, of small prime factors, and not below the requested size") {
  CHECK(Transform::good_size(2) == 2);
  CHECK(Transform::good_size(7) == 8);
  CHECK(Transform::good_size(127) == 128);
  CHECK(Transform::good_size(241) == 250);
}

TEST_CASE("fast sizes are multiples of 8 with one factor 3 at most") {
  CHECK(Transform::fast_size(1) == 8);
  CHECK(Transform::fast_size(200) == 200);
  CHECK(Transform::fast_size(201) == 240);
  CHECK(Transform::fast_size(241) == 256);
  CHECK(Transform::fast_size(257) == 320);
}
