#include "kernels/acoustics/trace/batch.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "kernels/acoustics/trace/ray.h"

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

TEST_CASE("a batch gives back the rows that it was given, in columns of one length") {
  const Rays two{{Eigen::Vector3f(0.6F, 0.0F, 0.8F), 0.1F}, {Eigen::Vector3f::UnitX(), 0.2F}};
  Rays rays;
  for (const Ray& ray : two) rays.push_back(ray);
  CHECK(rays == two);
  CHECK(rays[0].direction_head == Eigen::Vector3f(0.6F, 0.0F, 0.8F));
  CHECK(rays.direction_head.x[1] == 1.0F);
  rays.resize(3);
  CHECK(rays.solid_angle_sr == std::vector<float>{0.1F, 0.2F, 0.0F});
  rays.make_elements(5);
  CHECK(rays.size() == 5);
  CHECK(rays.direction_head.z.size() == 5);
}
