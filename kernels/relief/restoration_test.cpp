#include "kernels/relief/restoration.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/relief/combine.h"
#include "kernels/relief/guide.h"
#include "kernels/relief/spectral_surface.h"
#include "kernels/relief_statistics/exact_fbm.h"
#include "kernels/relief_statistics/power_spectrum.h"

using namespace ensonify::relief;
using namespace ensonify::relief_statistics;

namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

TEST_CASE("exact relief, thinned eight times and rebuilt, has its spectrum again; the smooth surface alone has not") {
  const int posts = 512, thin = 8;
  const Surface original = exact_fbm(0.625, posts, {21, "fbm"}, 0);
  Raster guide{posts / thin, posts / thin, 1.0 * thin, {0, 0}, {}};
  for (int j = 0; j < guide.rows; ++j) {
    for (int i = 0; i < guide.columns; ++i) guide.value.push_back(original.at(thin * i, thin * j));
  }
  const Detail detail = detail_below({guide.columns, guide.rows, guide.cell_m, guide.value});
  const SpectralSurface relief(detail.spectrum, 1.0, 1, "detail");
  const Field smooth = smooth_surface(guide, 1.0);
  const Field rebuilt = sum({smooth, [&](const Window& w, std::span<float> z) { relief.fill(w, z); }});
  // Half a cell from the edges, where the raster ends before the posts do.
  const Window inside{0, 24, 24, 448, 448};
  Surface bare{448, 448, 1.0, std::vector<float>(inside.size())}, full = bare;
  smooth(inside, bare.height_m);
  rebuilt(inside, full.height_m);
  const RadialSpectrum truth = radial_spectrum(original, 128);
  const double nyquist = kPi / thin;
  // Thinning folds what is finer back on the guide: near its Nyquist number it stands up to 3 dB too high.
  CHECK(difference_db(radial_spectrum(full, 128), truth, nyquist, 2 * nyquist) == Approx(0.0).margin(3.0));
  CHECK(difference_db(radial_spectrum(full, 128), truth, 2 * nyquist, 0.7 * kPi) == Approx(0.0).margin(3.0));
  CHECK(difference_db(radial_spectrum(full, 128), truth, 0.2 * nyquist, nyquist) == Approx(0.0).margin(2.0));
  CHECK(difference_db(radial_spectrum(bare, 128), truth, nyquist, 2 * nyquist) < -10.0);
}

TEST_CASE("a guide without a whole window, or level, asks for no detail") {
  Surface guide{40, 40, 5.0, std::vector<float>(1600, -3.0F)};
  CHECK(detail_below(guide).spectrum.rms_m == 0.0);
  for (std::size_t i = 0; i < 1600; i += 37) guide.height_m[i] = std::nanf("");
  CHECK(detail_below(guide).spectrum.rms_m == 0.0);
  CHECK_THROWS_WITH(detail_below(guide, 0.625, 1.0), "detail: band_start_cells is 1.000000, allowed: 2 to 16");
}
