// What a grid measures, and what thinning and rebuilding it leaves, as JSON.
//   relief_report COLUMNS ROWS SPACING_M FILE [THIN]
// FILE: float32 heights, row by row from the south, NaN for holes. THIN: every THIN-th post is kept, and rebuilt from.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>

#include "kernels/seabed/relief/guide.h"
#include "kernels/seabed/relief/restoration.h"
#include "kernels/seabed/relief/spectral_surface.h"
#include "kernels/seabed/statistics/patches.h"
#include "kernels/seabed/statistics/power_spectrum.h"
#include "kernels/seabed/statistics/structure.h"

using namespace ensonify::relief;
using namespace ensonify::relief_statistics;

namespace {

constexpr double kPi = std::numbers::pi;

void print_restoration(const Surface& original, int thin) {
  Raster guide{original.columns / thin, original.rows / thin, original.spacing_m * thin, {0, 0}, {}};
  for (int j = 0; j < guide.rows; ++j) {
    for (int i = 0; i < guide.columns; ++i) guide.value.push_back(original.at(thin * i, thin * j));
  }
  const Detail detail = detail_below({guide.columns, guide.rows, guide.cell_m, guide.value});
  const Window all{0, 0, 0, original.columns, original.rows};
  Surface smooth{original.columns, original.rows, original.spacing_m, std::vector<float>(all.size())};
  smooth_surface(guide, original.spacing_m)(all, smooth.height_m);
  Surface rebuilt = smooth;
  std::vector<float> relief(all.size());
  SpectralSurface(detail.spectrum, original.spacing_m, 1, "detail").fill(all, relief);
  for (std::size_t i = 0; i < relief.size(); ++i) rebuilt.height_m[i] += relief[i];
  const RadialSpectrum truth = radial_spectrum(original, 128);
  const double nyquist = kPi / guide.cell_m;
  std::printf(", \"smooth_db\": %.2f, \"rebuilt_db\": %.2f, \"rebuilt_second_octave_db\": %.2f",
              difference_db(radial_spectrum(smooth, 128), truth, nyquist, 2 * nyquist),
              difference_db(radial_spectrum(rebuilt, 128), truth, nyquist, 2 * nyquist),
              difference_db(radial_spectrum(rebuilt, 128), truth, 2 * nyquist, 4 * nyquist));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fprintf(stderr, "relief_report COLUMNS ROWS SPACING_M FILE [THIN]\n");
    return 2;
  }
  Surface surface{std::atoi(argv[1]), std::atoi(argv[2]), std::atof(argv[3]), {}};
  surface.height_m.resize(static_cast<std::size_t>(surface.columns) * static_cast<std::size_t>(surface.rows));
  std::ifstream file(argv[4], std::ios::binary);
  file.read(reinterpret_cast<char*>(surface.height_m.data()),
            static_cast<std::streamsize>(surface.height_m.size() * sizeof(float)));
  if (!file) {
    std::fprintf(stderr, "%s: not as many heights as said\n", argv[4]);
    return 2;
  }
  const ScalingExponents zeta = scaling_exponents(surface);
  const Patchiness p = patchiness(surface);
  std::printf(
      "{\"zeta_1\": %.4f, \"zeta_2\": %.4f, \"zeta_3\": %.4f, \"k2\": %.4f, \"patch\": %.3f, \"p95_over_p5\": %.2f, "
      "\"bimodality\": %.3f, \"rms_slope\": %.3f",
      zeta.zeta_1, zeta.zeta_2, zeta.zeta_3, zeta.k2(), p.rms_over_median, p.p95_over_p5, p.bimodality,
      p.slope_correlation);
  if (argc > 5) print_restoration(surface, std::atoi(argv[5]));
  std::printf("}\n");
  return 0;
}
