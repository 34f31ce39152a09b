#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/survey/coverage.h"

using namespace ensonify::survey;
using Catch::WithinAbs;

namespace {

/// 40 x 20 m to the north-east of the origin, heading north.
const Rectangle kArea{{20, 10}, 0.0, 20.0, 40.0};

/// Soundings on a lattice, `across` and `along` metres apart.
CubeSearch lattice(double across_m, double along_m) {
  CubeSearch search(kArea, 0.25);
  for (double east = 0.5 * across_m; east < 40.0; east += across_m) {
    for (double north = 0.5 * along_m; north < 20.0; north += along_m) search.add({east, north});
  }
  return search;
}

}  // namespace

TEST_CASE("on a lattice a cube of three distances holds nine soundings, wherever it stands") {
  // Any square of side 3 d holds 3 x 3 points of a lattice of d; known to a cell, and one more is left between cells.
  const double side_m = lattice(1.0, 1.0).smallest_side_m(9, 1.0);
  CHECK(side_m >= 3.0);
  CHECK(side_m <= 3.0 + 2 * 0.25);
  // One that is half as dense along is decided by that: 3 points along take 6 m, which hold 6 across.
  CHECK_THAT(lattice(1.0, 2.0).smallest_side_m(18, 1.0), WithinAbs(6.25, 0.25));
}

TEST_CASE("the share of places found falls from all to none") {
  const CubeSearch search = lattice(1.0, 1.0);
  CHECK(search.found(3.5, 9) == 1.0);
  CHECK(search.found(1.5, 9) == 0.0);
  CHECK(search.found(0.25, 1) == 0.0);  // below what cells give
  double before = 0.0;
  for (double side_m = 1.0; side_m <= 4.0; side_m += 0.25) {
    const double share = search.found(side_m, 9);
    CHECK(share >= before);
    before = share;
  }
}

TEST_CASE("where cubes may be larger, fewer soundings find them") {
  // Dense to port of the middle, sparse to starboard: cubes of 2 m are found there alone, those of 6 m everywhere.
  CubeSearch search(kArea, 0.25);
  for (double north = 0.25; north < 20.0; north += 0.5) {
    for (double east = 0.25; east < 20.0; east += 0.5) search.add({east, north});
  }
  for (double north = 0.75; north < 20.0; north += 1.5) {
    for (double east = 20.75; east < 40.0; east += 1.5) search.add({east, north});
  }
  const auto larger_beyond = [](double from_m) {
    return [from_m](double across_m, double) { return across_m > from_m ? 6.0 : 2.0; };
  };
  CHECK(search.found(larger_beyond(18.0), 9) == 1.0);
  CHECK(search.found(larger_beyond(25.0), 9) < 1.0);
  CHECK(search.found(larger_beyond(50.0), 9) == search.found(2.0, 9));
  CHECK(search.found([](double, double) { return 0.25; }, 1) == 0.0);
}

TEST_CASE("a gap limits what is found everywhere, less what is found in most places") {
  CubeSearch search(kArea, 0.25);
  for (double east = 0.125; east < 40.0; east += 0.25) {
    for (double north = 0.125; north < 20.0; north += 0.25) {
      if (std::hypot(east - 20.0, north - 10.0) > 2.0) search.add({east, north});  // a hole of 4 m across
    }
  }
  // The square inside the hole, a cell more because holes end between cells, and two steps that are not given.
  const double square_m = 4.0 / std::sqrt(2.0), side_m = search.smallest_side_m(1, 1.0);
  CHECK(side_m > square_m);
  CHECK(side_m <= square_m + 3 * 0.25);
  CHECK(search.smallest_side_m(1, 0.95) == 0.5);  // the least that cells of 0.25 m give
}

TEST_CASE("without soundings nothing is found; a step of nothing is refused") {
  CHECK(std::isinf(CubeSearch(kArea, 0.5).smallest_side_m(1, 0.5)));
  CHECK_THROWS_AS(CubeSearch(kArea, 0.0), std::invalid_argument);
}
