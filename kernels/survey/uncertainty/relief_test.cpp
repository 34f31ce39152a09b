#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/base/random/stream.h"
#include "kernels/survey/uncertainty/sounding.h"

using namespace ensonify;
using namespace ensonify::uncertainty;
using Catch::WithinAbs;

namespace {

/// A made-up seabed: waves from all sides whose power falls as k^-(2 hurst + 1), from 100 m down to 5 cm, 6 an octave.
class Seabed {
 public:
  Seabed(double hurst, std::uint64_t seed) {
    const random::Stream stream(seed, "relief");
    for (std::uint64_t i = 0; i < 66; ++i) {
      const double k = 2 * M_PI / 100.0 * std::exp2(static_cast<double>(i) / 6.0);
      const double from = M_PI * stream.uniform(i, 1);
      waves_.push_back(
          {k * std::cos(from), k * std::sin(from), 2 * M_PI * stream.uniform(i), 0.02 * std::pow(k, -hurst)});
    }
  }
  double height_m(double x, double y) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += wave.height_m * std::cos(wave.kx * x + wave.ky * y + wave.phase);
    return sum;
  }
  /// About a place on the x axis, as unresolved_share weighs.
  double mean_m(double x, double footprint_m, double aspect) const {
    double sum = 0.0, weights = 0.0;
    for (int i = -4; i <= 4; ++i) {
      for (int j = aspect > 0.0 ? -4 : 0; j <= (aspect > 0.0 ? 4 : 0); ++j) {
        const double weight = beam(0.1875 * i) * beam(0.1875 * j);
        sum += weight * height_m(x + 0.1875 * i * footprint_m, 0.1875 * j * aspect * footprint_m);
        weights += weight;
      }
    }
    return sum / weights;
  }

 private:
  static double beam(double widths) {
    const double arch = M_PI * 0.8859 * widths;
    return widths == 0.0 ? 1.0 : std::pow(std::sin(arch) / arch, 2);
  }
  struct Wave {
    double kx, ky, phase, height_m;  // rad/m, rad
  };
  std::vector<Wave> waves_;
};

}  // namespace

TEST_CASE("a plane has no bends, whatever its tilt, and noise adds none") {
  const random::Stream noise(1, "bends");
  std::vector<ProfilePoint> plane;
  for (int i = 0; i < 4000; ++i) plane.push_back({0.5 * i, 3.0 - 0.2 * 0.5 * i, 1.3, 0.0});
  std::vector<double> bends = squared_bends_m2(plane);
  CHECK(std::isnan(bends[5]));
  CHECK(std::isnan(bends[3994]));
  for (std::size_t i = 6; i < 3994; ++i) REQUIRE_THAT(bends[i], WithinAbs(0.0, 1e-18));

  for (std::size_t i = 0; i < plane.size(); ++i) {
    plane[i].height_m += 0.02 * noise.normal(i);
    plane[i].noise_sd_m = 0.02;
  }
  bends = squared_bends_m2(plane);
  double sum = 0.0;
  for (std::size_t i = 6; i < 3994; ++i) sum += bends[i] / 3988.0;
  // Of one bend: 36 + 2 x 16 (0.4^2 + 0.6^2) + 2 (0.2^2 + 0.8^2) = 54 variances, chi-square about it; neighbours are
  // alike, so some 700 are independent: the mean strays by 54 x sqrt(2 / 700) of a variance.
  CHECK_THAT(sum, WithinAbs(0.0, 3 * 54 * std::sqrt(2.0 / 700.0) * 0.02 * 0.02));
}

TEST_CASE("a long flank hardly bends") {
  // A ridge of 3 m and a width of 14 m under footprints of 1.5 m: its second difference is 1.5 (2 pi 1.5 / 14)^2 = 0.68
  // m at the crest, its fourth 1.5 (2 - 2 cos(2 pi 1.5 / 14))^2 = 0.28 m.
  std::vector<ProfilePoint> ridge;
  for (int i = -40; i <= 40; ++i) ridge.push_back({0.1 * i, 1.5 * std::cos(2 * M_PI * 0.1 * i / 14.0), 1.5, 0.0});
  CHECK(std::sqrt(squared_bends_m2(ridge)[40]) == Approx(0.28).epsilon(0.02));
}

TEST_CASE("a single step and points out of order: bends by hand") {
  const std::vector<ProfilePoint> profile{{0, 0, 1, 0},   {1, 1, 1, 0}, {0.5, 9, 1, 0}, {2, 0, 1, 0.1},
                                          {3, 0, 1, 0.2}, {4, 0, 1, 0}, {5, 0, 1, 0}};
  const auto bends = squared_bends_m2(profile);
  CHECK(std::isnan(bends[1]));
  CHECK(std::isnan(bends[2]));
  CHECK(bends[3] == Approx(16.0 - 36 * 0.01 - 16 * 0.04));
  CHECK(bends[4] == Approx(1.0 - 16 * 0.01 - 36 * 0.04));
  CHECK(std::isnan(bends[5]));
  CHECK(squared_bends_m2({}).empty());
}

TEST_CASE("curvature of the means gives a mean's offset from its midpoint at any roughness") {
  const double footprint_m = 3.0;
  struct Case {
    double hurst, aspect;
  };
  for (const Case c : {Case{0.5, 0.0}, Case{0.75, 0.0}, Case{0.625, 0.5}, Case{0.625, 1.0}}) {
    double unresolved = 0.0, bent = 0.0;
    // 40 seabeds of 6 places, 15 m apart, are some 240 values: variances within 9 %, their ratio within 12 %; twice
    // that.
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const Seabed seabed(c.hurst, seed);
      for (int place = 0; place < 6; ++place) {
        const double x = 15.0 * place;
        std::vector<ProfilePoint> profile;
        for (int k = -2; k <= 2; ++k) {
          const double at = x + k * footprint_m;
          profile.push_back({at, seabed.mean_m(at, footprint_m, c.aspect), footprint_m, 0.0});
        }
        unresolved += std::pow(profile[2].height_m - seabed.height_m(x, 0.0), 2);
        bent += squared_bends_m2(profile)[2];
      }
    }
    CAPTURE(c.hurst, c.aspect);
    CHECK(unresolved / bent == Approx(unresolved_share(c.hurst, c.aspect)).epsilon(0.25));
  }
  CHECK(unresolved_share(0.5, 0.0) > unresolved_share(0.75, 0.0));
  CHECK(unresolved_share(0.625, 1.0) > 2.0 * unresolved_share(0.625, 0.0));
}
