#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/seabed/relief/guide.h"
#include "kernels/seabed/relief/ripples.h"
#include "kernels/seabed/relief/seabed.h"
#include "kernels/seabed/relief/spectral_surface.h"
#include "kernels/seabed/relief/spectrum.h"
#include "kernels/seabed/statistics/power_spectrum.h"
#include "kernels/seabed/statistics/testing/exact_fbm.h"

using namespace ensonify::relief;
using namespace ensonify::relief_statistics;
using Catch::WithinAbs;

namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

TEST_CASE("relief thinned eight times regains its spectrum when restored, not when smoothed") {
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
  CHECK_THAT(difference_db(radial_spectrum(full, 128), truth, nyquist, 2 * nyquist), WithinAbs(0.0, 3.0));
  CHECK_THAT(difference_db(radial_spectrum(full, 128), truth, 2 * nyquist, 0.7 * kPi), WithinAbs(0.0, 3.0));
  CHECK_THAT(difference_db(radial_spectrum(full, 128), truth, 0.2 * nyquist, nyquist), WithinAbs(0.0, 2.0));
  CHECK(difference_db(radial_spectrum(bare, 128), truth, nyquist, 2 * nyquist) < -10.0);
}

TEST_CASE("dunes below a guide's cells come back with a layer of bedforms only, within 6 dB") {
  // Dunes of 10 m on exact relief, as cells of 8 m hold them: means over the cells, whose Nyquist wave is 16 m long.
  const int posts = 512, cell = 8;
  const RippleParameters dunes{.wavelength_m = 10.0, .height_m = 0.3, .travel_heading_rad = 0.6};
  Surface original = exact_fbm(0.625, posts, {22, "fbm"}, 0);
  const auto with_dunes = [&](std::span<float> z, const Window& window, std::uint64_t seed) {
    std::vector<float> waves(z.size());
    Ripples(dunes, 1.0, seed, "dunes").fill(window, waves);
    for (std::size_t i = 0; i < z.size(); ++i) z[i] += waves[i];
  };
  for (float& z : original.height_m) z *= 0.01F;  // sand: rms of some centimetres
  with_dunes(original.height_m, {0, 0, 0, posts, posts}, 5);
  Raster guide{posts / cell, posts / cell, 1.0 * cell, {0.5 * (cell - 1), 0.5 * (cell - 1)}, {}};
  for (int j = 0; j < posts; j += cell) {
    for (int i = 0; i < posts; i += cell) {
      float sum = 0.0F;
      for (int k = 0; k < cell * cell; ++k) sum += original.at(i + k % cell, j + k / cell);
      guide.value.push_back(sum / (cell * cell));
    }
  }
  const Detail detail = detail_below({guide.columns, guide.rows, guide.cell_m, guide.value});
  const SpectralSurface relief(detail.spectrum, 1.0, 1, "detail");
  const Field smooth = smooth_surface(guide, 1.0);
  const Field rebuilt = sum({smooth, [&](const Window& w, std::span<float> z) { relief.fill(w, z); }});
  const Window inside{0, 24, 24, 448, 448};
  Surface plain{448, 448, 1.0, std::vector<float>(inside.size())};
  rebuilt(inside, plain.height_m);
  Surface dunes_too = plain;
  with_dunes(dunes_too.height_m, inside, 6);  // other dunes of the same kind: where crests are, no guide gives
  const RadialSpectrum truth = radial_spectrum(original, 128);
  const double low = 2 * kPi / 12, high = 2 * kPi / 8.5;  // where the dunes live
  const double short_db = difference_db(radial_spectrum(plain, 128), truth, low, high);
  const double with_db = difference_db(radial_spectrum(dunes_too, 128), truth, low, high);
  INFO("without the layer " << short_db << " dB, with it " << with_db << " dB");
  CHECK(short_db < -6.0);  // on a measured dune field so rebuilt: 6 to 12 dB short
  CHECK(std::abs(with_db) < 6.0);
}

TEST_CASE("a guide without a whole window, or level, asks for no detail") {
  Surface guide{40, 40, 5.0, std::vector<float>(1600, -3.0F)};
  CHECK(detail_below(guide).spectrum.rms_m == 0.0);
  for (std::size_t i = 0; i < 1600; i += 37) guide.height_m[i] = std::nanf("");
  CHECK(detail_below(guide).spectrum.rms_m == 0.0);
  CHECK_THROWS_WITH(detail_below(guide, 0.625, 1.0), "detail: band_start_cells is 1.000000, allowed: 2 to 16");
}
