#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <numeric>

#include "kernels/instruments/navigation_filter/testing/vehicle.h"

using namespace ensonify;
using namespace ensonify::navigation_filter;
using namespace ensonify::navigation_filter::test_run;

namespace {

/// Mean NEES of a hundred runs from this seed on, at epochs each 5 s: 150 s with fixes on the surface, then 250 s
/// without, log and depth all along.
std::vector<double> hundred(const Mission& m, const Grade& grade, std::uint64_t first_seed) {
  std::vector<double> means(m.readings.size() / 25, 0.0);
  for (std::uint64_t seed = first_seed; seed < first_seed + 100; ++seed) {
    Run run(m, grade, seed);
    for (std::size_t n = 1; n < m.truth.size(); ++n) {
      run.step(n, {.fixes = static_cast<double>(n) * kStep_s <= 150.0});
      if (n % 25 == 0) means[n / 25 - 1] += run.nees(n) / 100.0;
    }
  }
  return means;
}

double share_inside(const std::vector<double>& means, double low, double high) {
  const auto inside = std::ranges::count_if(means, [&](double mean) { return mean > low && mean < high; });
  return static_cast<double>(inside) / static_cast<double>(means.size());
}

const std::pair<const char*, Grade> kGrades[] = {{"RLG", kRlg},
                                                 {"FOG", kFog},
                                                 {"FOG, satellite compass", kFogWithSatellites},
                                                 {"tactical", kTactical},
                                                 {"MEMS, magnetic compass", kMems}};

}  // namespace

TEST_CASE("the filter is as wrong as it says: mean NEES of hundreds of runs") {
  // Of 100 runs the mean of nine degrees of freedom is chi-square of 900 over 100: 95 % between 8.19 and 9.85; of 200
  // runs between 8.42 and 9.60. A run's epochs share what is drawn once, so how many of them are inside is itself
  // a matter of luck: of hundreds of a filter that is right, about 15 in 100 have fewer than 90 % inside
  // (docs/physics/instruments/filter.md). So the line is drawn for two hundreds, their epochs together, and for their
  // mean.
  const Mission m = mission(400.0, 80.0, 2.0);
  for (const auto& [name, grade] : kGrades) {
    const std::vector<double> one = hundred(m, grade, 1), other = hundred(m, grade, 101);
    std::vector<double> both;
    for (std::size_t i = 0; i < one.size(); ++i) both.push_back(0.5 * (one[i] + other[i]));
    const double first = share_inside(one, 8.19, 9.85), second = share_inside(other, 8.19, 9.85);
    CAPTURE(name, first, second);
    CHECK(0.5 * (first + second) >= 0.9);
    CHECK(share_inside(both, 8.42, 9.60) >= 0.9);
  }
}

TEST_CASE("ten hundreds, for docs/physics/draw/consistency.py", "[.hundreds]") {
  const Mission m = mission(400.0, 80.0, 2.0);
  for (std::uint64_t first_seed = 1; first_seed <= 901; first_seed += 100) {
    std::cout << share_inside(hundred(m, kFog, first_seed), 8.19, 9.85) << std::endl;
  }
}

TEST_CASE("twenty hundreds of each grade, for docs/physics/instruments/filter.md", "[.grades]") {
  const Mission m = mission(400.0, 80.0, 2.0);
  for (const auto& [name, grade] : kGrades) {
    std::cout << name << ": inside";
    std::vector<double> all(m.readings.size() / 25, 0.0);
    int keep = 0;
    for (std::uint64_t first_seed = 1; first_seed <= 1901; first_seed += 100) {
      const std::vector<double> means = hundred(m, grade, first_seed);
      const double inside = share_inside(means, 8.19, 9.85);
      std::cout << ' ' << inside << std::flush;
      if (inside >= 0.9) ++keep;
      for (std::size_t i = 0; i < all.size(); ++i) all[i] += means[i] / 20.0;
    }
    std::cout << "; " << keep << " keep the line; mean " << std::accumulate(all.begin(), all.end(), 0.0) / all.size()
              << ", inside 8.81-9.19 " << share_inside(all, 8.81, 9.19) << std::endl;
  }
}

TEST_CASE("aided by a Doppler log of 0.2 %, drift per distance depends on the grade") {
  // Ten runs of half an hour at 2 m/s on one course without fixes, after half a minute with them. The root mean square
  // of ten strays by about 16 %, so a grade is distinguished from the next, not to a digit.
  const Mission m = mission(1800.0, 1e9, 2.0);
  const double distance_m = 2.0 * 1770.0;
  const auto drift = [&](const Grade& grade) {
    double squares = 0.0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Run run(m, grade, seed);
      for (std::size_t n = 1; n < m.truth.size(); ++n) run.step(n, {.fixes = n * kStep_s <= 30.0});
      squares += std::pow(run.off_m(m.truth.size() - 1), 2);
    }
    return 100.0 * std::sqrt(squares / 10.0) / distance_m;
  };
  const double rlg = drift(kRlg), fog = drift(kFog), tactical = drift(kTactical), mems = drift(kMems);
  CAPTURE(rlg, fog, tactical, mems);  // 0.13, 0.16, 0.57, 0.48 %
  CHECK(fog >= 0.1);
  CHECK(fog <= 0.3);
  CHECK(rlg <= fog);
  CHECK(tactical > fog);
  CHECK(mems > fog);  // its compass holds what gyros of the tactical grade alone lose
  CHECK(mems < 3.0);
}
