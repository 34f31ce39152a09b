#include "kernels/uncertainty/relief.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/random/stream.h"

using namespace ensonify;
using namespace ensonify::uncertainty;

namespace {

/// A made-up seabed: waves whose power falls as k^-(2 hurst + 1), from 100 m down to 2 cm, 12 an octave.
class Seabed {
 public:
  Seabed(double hurst, std::uint64_t seed) {
    const random::Stream stream(seed, "relief");
    for (std::uint64_t i = 0; i < 148; ++i) {
      const double k = 2 * M_PI / 100.0 * std::exp2(static_cast<double>(i) / 12.0);
      waves_.push_back({k, 2 * M_PI * stream.uniform(i), 0.02 * std::pow(k, -hurst)});
    }
  }
  double height_m(double x) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += wave.height_m * std::cos(wave.k * x + wave.phase);
    return sum;
  }
  /// Over a footprint as unresolved_share weighs.
  double mean_m(double x, double footprint_m) const {
    double sum = 0.0, weights = 0.0;
    for (int i = -24; i <= 24; ++i) {
      const double u = i / 32.0, arch = M_PI * 0.8859 * u;
      const double weight = i == 0 ? 1.0 : std::pow(std::sin(arch) / arch, 2);
      sum += weight * height_m(x + u * footprint_m);
      weights += weight;
    }
    return sum / weights;
  }

 private:
  struct Wave {
    double k, phase, height_m;  // rad/m, rad
  };
  std::vector<Wave> waves_;
};

}  // namespace

TEST_CASE("a plane has no bends, whatever its tilt, and noise adds none") {
  const random::Stream noise(1, "bends");
  std::vector<ProfilePoint> plane;
  for (int i = 0; i < 4000; ++i) plane.push_back({0.5 * i, 3.0 - 0.2 * 0.5 * i, 1.3, 0.0});
  std::vector<double> bends = squared_bends_m2(plane);
  CHECK(std::isnan(bends[2]));
  CHECK(std::isnan(bends[3998]));
  for (std::size_t i = 3; i < 3997; ++i) REQUIRE(bends[i] == Approx(0.0).margin(1e-18));

  for (std::size_t i = 0; i < plane.size(); ++i) {
    plane[i].height_m += 0.02 * noise.normal(i);
    plane[i].noise_sd_m = 0.02;
  }
  bends = squared_bends_m2(plane);
  double sum = 0.0;
  for (std::size_t i = 3; i < 3997; ++i) sum += bends[i] / 3994.0;
  // Of one bend: 4 + 2 x (0.4^2 + 0.6^2) = 5.04 variances, chi-square about it; neighbours are alike, so some 1000 are
  // independent: the mean strays by 5.04 x sqrt(2 / 1000) of a variance.
  CHECK(sum == Approx(0.0).margin(3 * 5.04 * std::sqrt(2.0 / 1000.0) * 0.02 * 0.02));
}

TEST_CASE("a single step and points out of order: bends by hand") {
  const std::vector<ProfilePoint> profile{{0, 0, 1, 0}, {1, 1, 1, 0}, {0.5, 9, 1, 0}, {2, 0, 1, 0.1}, {3, 0, 1, 0}};
  const auto bends = squared_bends_m2(profile);
  CHECK(bends[1] == Approx(4.0 - 0.01));
  CHECK(std::isnan(bends[2]));
  CHECK(bends[3] == Approx(1.0 - 0.04));
  CHECK(squared_bends_m2({}).empty());
}

TEST_CASE("bends of the means tell how far a mean is from the point in its middle, whatever the roughness") {
  for (const double hurst : {0.5, 0.75}) {
    double unresolved = 0.0, bent = 0.0;
    const double footprint_m = 3.0;
    // 40 seabeds of 10 places, 9 m apart, are some 400 values: variances within 7 %, three times that is allowed.
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const Seabed seabed(hurst, seed);
      for (int place = 0; place < 10; ++place) {
        const double x = 9.0 * place;
        std::vector<ProfilePoint> profile;
        for (const double at : {x - footprint_m, x, x + footprint_m}) {
          profile.push_back({at, seabed.mean_m(at, footprint_m), footprint_m, 0.0});
        }
        unresolved += std::pow(profile[1].height_m - seabed.height_m(x), 2);
        bent += squared_bends_m2(profile)[1];
      }
    }
    CAPTURE(hurst, unresolved_share(hurst));
    CHECK(unresolved / bent == Approx(unresolved_share(hurst)).epsilon(0.25));
  }
  CHECK(unresolved_share(0.5) > unresolved_share(0.75));
}
