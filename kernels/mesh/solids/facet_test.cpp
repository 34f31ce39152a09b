#include "kernels/mesh/solids/facet.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <vector>

using namespace ensonify::solids;
using ensonify::frames::Vec3;

namespace {

constexpr double kLongest_m = 0.2;
const Facet kWhole{{Vec3(0, 0, 0), Vec3(5, 0, 0.5), Vec3(1, 3, 0)}, {0.1, 0.2, 0.0}};

}  // namespace

TEST_CASE("a facet is cut into the same parts, each with its own way") {
  std::vector<Vec3> all;
  split_facet(kWhole, kLongest_m, [&](const Facet& part) { all.push_back(middle_of(part)); });
  std::vector<Vec3> found;
  std::map<std::uint32_t, Vec3> by_way;
  split_facet_where([](const Facet&) { return true; }, kWhole, kLongest_m,
                    [&](const Facet& part, std::uint32_t way) {
                      found.push_back(middle_of(part));
                      by_way[way] = middle_of(part);
                    });
  CHECK(all.size() > 500);
  CHECK(found == all);
  CHECK(by_way.size() == all.size());

  SECTION("parts that meet something are the same, and few others are looked at") {
    const double strip_m = 2.0, half_m = 0.01;
    const auto meets = [&](const Facet& part) {
      const Vec3 middle = middle_of(part);
      double reach_m = 0.3;  // with room for the bulge
      for (const Vec3& corner : part.corners) reach_m = std::max(reach_m, (corner - middle).norm() + 0.3);
      return std::abs(middle.x() - strip_m) < reach_m + half_m;
    };
    std::size_t looked_at = 0;
    std::map<std::uint32_t, Vec3> met;
    split_facet_where([&](const Facet& part) { return ++looked_at, meets(part); }, kWhole, kLongest_m,
                      [&](const Facet& part, std::uint32_t way) { met[way] = middle_of(part); });
    std::size_t wanted = 0;
    for (const auto& [way, middle] : by_way) {
      if (std::abs(middle.x() - strip_m) > half_m) continue;
      ++wanted;
      CHECK(met.at(way) == middle);
    }
    CHECK(wanted > 0);
    for (const auto& [way, middle] : met) CHECK(by_way.at(way) == middle);
    CHECK(looked_at < all.size());
  }
}
