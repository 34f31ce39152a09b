#include "kernels/acoustics/trace/ground_lattice.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

using namespace ensonify::trace;
using ensonify::frames::Vec2;
using ensonify::random::Stream;

using Places = std::set<std::pair<double, double>>;

/// visit(first_m, second_m, inside) for each place.
template <class Visit>
static void each_place(const GroundLattice& lattice, const Stream& stream, const std::vector<Vec2>& outline,
                       double margin_m, const Visit& visit) {
  lattice.within(stream, outline, margin_m, GroundLattice::Inside::kPlaces, [&](const LatticePlaces& some) {
    REQUIRE(0 < some.count);
    REQUIRE(some.count <= LatticePlaces::kMost);
    for (std::size_t i = 0; i < some.count; ++i) {
      REQUIRE(some.places[i] == 1);
      visit(some.first_m[i], some.second_m[i], some.inside[i] != 0);
    }
  });
}

/// Places on the lattice's axes that are in a rectangle about (12, -7).
static Places places(const GroundLattice& lattice, double half_first_m, double half_second_m, std::uint64_t seed = 1) {
  const std::vector<Vec2> outline{{12 - half_first_m, -7 - half_second_m},
                                  {12 + half_first_m, -7 - half_second_m},
                                  {12 + half_first_m, -7 + half_second_m},
                                  {12 - half_first_m, -7 + half_second_m}};
  Places found;
  each_place(lattice, {seed, "rays"}, outline, 0.0, [&](double x, double y, bool) {
    if (std::abs(x - 12) < half_first_m && std::abs(y + 7) < half_second_m) REQUIRE(found.emplace(x, y).second);
  });
  return found;
}

TEST_CASE("a lattice has the requested number of places at any spacing") {
  // Places are counted to about the square root of those at the rim, 4 x 50 of 2500: 0.6 %.
  for (const double first_m : {0.063, 0.08, 0.1, 0.12, 0.1249}) {
    const GroundLattice lattice({1, 0}, first_m, 0.07);
    CHECK(double(places(lattice, 3, 2).size()) == Approx(6 * 4 / (first_m * 0.07)).epsilon(0.02));
  }
}

TEST_CASE("nearly equal spacings give nearly equal places; another seed gives others") {
  const auto some = places({{1, 0}, 0.1, 0.07}, 3, 2), more = places({{1, 0.1}, 0.095, 0.07}, 3, 2);
  std::size_t shared = 0;
  for (const auto& place : some) shared += more.count(place);
  CHECK(shared == some.size());  // 5 % more: what was there stays
  CHECK(more.size() > some.size());
  for (const auto& place : places({{1, 0}, 0.1, 0.07}, 3, 2, 2)) REQUIRE(some.count(place) == 0);
}

TEST_CASE("a part of an outline has the places that the whole has there") {
  const GroundLattice lattice({0.3, 1}, 0.11, 0.3);
  const auto whole = places(lattice, 6, 4);
  std::size_t inside = 0;
  for (const auto& [x, y] : whole) inside += std::abs(x - 12) < 0.7 && std::abs(y + 7) < 0.8;
  const auto part = places(lattice, 0.7, 0.8);
  CHECK(part.size() == inside);
  for (const auto& place : part) REQUIRE(whole.count(place) == 1);
}

TEST_CASE("places are even: a block has at most its share, a lattice cell at most one") {
  const GroundLattice lattice({1, 0}, 0.09, 0.09);  // cells of 1/16 m, 1.93 to a block of 1/8 m
  std::set<std::pair<int, int>> cells;
  std::map<std::pair<int, int>, int> blocks;
  for (const auto& [x, y] : places(lattice, 4, 4)) {
    REQUIRE(cells.emplace(int(std::floor(16 * x)), int(std::floor(16 * y))).second);
    ++blocks[{int(std::floor(8 * x)), int(std::floor(8 * y))}];
  }
  for (const auto& [block, count] : blocks) REQUIRE(count <= 2);
}

TEST_CASE("axes lie within 7.5 degrees of the direction; rotating and back is identity") {
  for (int degree = -180; degree <= 180; ++degree) {
    const double angle = degree * std::numbers::pi / 180.0;
    const GroundLattice lattice({std::cos(angle), std::sin(angle)}, 1.0, 1.0);
    const Vec2 on = lattice.on_axes({std::cos(angle), std::sin(angle)});
    CHECK(std::abs(on.x()) >= std::cos(7.51 * std::numbers::pi / 180.0));
    const Vec2 back = on.x() * lattice.first_axis_enu() + on.y() * lattice.second_axis_enu();
    CHECK((back - Vec2(std::cos(angle), std::sin(angle))).norm() < 1e-12);
  }
}

TEST_CASE("outlines in any position, slivers and points, are covered") {
  // Every place within a thin triangle that all places around it show.
  const GroundLattice lattice({1, 0}, 0.1, 0.1);
  const std::vector<Vec2> triangle{{10, -9}, {14, -5.1}, {13.9, -5}};
  const auto side = [](const Vec2& a, const Vec2& b, double x, double y) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
  };
  const auto inside = [&](double x, double y) {
    return side(triangle[0], triangle[1], x, y) > 0 && side(triangle[1], triangle[2], x, y) > 0 &&
           side(triangle[2], triangle[0], x, y) > 0;
  };
  int expected = 0, found = 0;
  for (const auto& [x, y] : places(lattice, 3, 3)) expected += inside(x, y);
  each_place(lattice, {1, "rays"}, triangle, 0.0, [&](double x, double y, bool) { found += inside(x, y); });
  CHECK(expected > 10);
  CHECK(found == expected);
  int around = 0;
  each_place(lattice, {1, "rays"}, {{12, -7}, {12, -7}, {12, -7}}, 0.3,
             [&](double x, double y, bool) { around += std::hypot(x - 12, y + 7) < 0.3; });
  int near = 0;
  for (const auto& [x, y] : places(lattice, 1, 1)) near += std::hypot(x - 12, y + 7) < 0.3;
  CHECK(around == near);
}

TEST_CASE("blocks inside have the places that are visited one by one, all within the outline less the margin") {
  // A part's outline: two straight sides, two that are bent (one of them inwards), either way round.
  std::vector<Vec2> outline{{10, -9}, {12.1, -8.8}, {14, -9.2}, {13.8, -5}, {12, -5.3}, {10.3, -5.1}};
  constexpr double kMargin_m = 0.15;
  const auto inside = [&](double x, double y) {  // by crossings of the sides
    bool in = false;
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const Vec2 &a = outline[k], &b = outline[(k + 1) % outline.size()];
      if ((a.y() > y) != (b.y() > y) && x < a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y())) in = !in;
    }
    return in;
  };
  for (int way = 0; way < 2; ++way) {
    for (const Vec2& along : {Vec2(1, 0), Vec2(0.4, 1), Vec2(-1, 1)}) {
      const GroundLattice lattice(along, 0.07, 0.1);
      std::vector<Vec2> on_axes;
      for (const Vec2& corner : outline) on_axes.push_back(lattice.on_axes(corner));
      int all = 0, in_blocks = 0, beside = 0, counted = 0;
      each_place(lattice, {1, "rays"}, on_axes, kMargin_m, [&](double x, double y, bool is_inside) {
        ++all;
        if (!is_inside) return;
        ++in_blocks;
        const Vec2 at = x * lattice.first_axis_enu() + y * lattice.second_axis_enu();
        for (const Vec2& off : {Vec2(kMargin_m, 0), Vec2(-kMargin_m, 0), Vec2(0, kMargin_m), Vec2(0, -kMargin_m)})
          REQUIRE(
              inside(at.x() + 0.7 * off.x(), at.y() + 0.7 * off.y()));  // sides stand at up to 45 degrees to the axes
      });
      lattice.within({1, "rays"}, on_axes, kMargin_m, GroundLattice::Inside::kBlocks, [&](const LatticePlaces& some) {
        for (std::size_t i = 0; i < some.count; ++i) {
          (some.inside[i] != 0 ? counted : beside) += static_cast<int>(some.places[i]);
          if (some.inside[i] == 0) REQUIRE(some.places[i] == 1);
        }
      });
      CHECK(in_blocks > all / 2);
      CHECK(counted == in_blocks);
      CHECK(beside + counted == all);
    }
    std::ranges::reverse(outline);
  }
}
