#include "kernels/acoustics/trace/reserve.h"

#include <catch2/catch.hpp>
#include <numeric>

using namespace ensonify::trace;

TEST_CASE("room is taken once for counts that vary by an eighth, and what fits stays") {
  std::vector<double> numbers{1.0, 2.0};
  make_room(numbers, 100'000);  // 200 pages
  CHECK(numbers.empty());
  CHECK(numbers.capacity() >= 112'500);
  const double* const place = numbers.data();
  numbers.resize(112'500);
  std::iota(numbers.begin(), numbers.end(), 0.0);
  make_room(numbers, 112'500);
  CHECK(numbers.data() == place);
  CHECK(numbers[112'499] == 112'499.0);
  make_elements(numbers, 50'000);
  CHECK(numbers.data() == place);
  CHECK(numbers.size() == 50'000);
  CHECK(numbers[49'999] == 49'999.0);
}

TEST_CASE("room of less than a page, and none") {
  std::vector<char> bytes;
  make_elements(bytes, 0);
  CHECK(bytes.empty());
  make_elements(bytes, 3);
  CHECK(bytes.size() == 3);
}
