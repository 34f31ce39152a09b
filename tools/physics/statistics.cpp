#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "kernels/seabed/relief/guide.h"
#include "kernels/seabed/relief/spectral_surface.h"
#include "kernels/seabed/relief/spectrum.h"
#include "kernels/seabed/statistics/power_spectrum.h"
#include "kernels/seabed/statistics/surface.h"
#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

using namespace relief_statistics;

struct Inputs {
  std::string file;
  double columns = 512, rows = 512, spacing_m = 1.0, thin = 0;
};

Surface read_surface(const Inputs& in) {
  Surface surface{static_cast<int>(in.columns), static_cast<int>(in.rows), in.spacing_m, {}};
  surface.height_m.resize(static_cast<std::size_t>(surface.columns) * static_cast<std::size_t>(surface.rows));
  std::ifstream file(in.file, std::ios::binary);
  file.read(reinterpret_cast<char*>(surface.height_m.data()),
            static_cast<std::streamsize>(surface.height_m.size() * sizeof(float)));
  if (!file) throw std::invalid_argument(in.file + ": has fewer heights than --columns times --rows");
  return surface;
}

/// Spectra over that of the original: of a smooth surface through every thin-th post, and with the detail restored, in
/// the first octave beyond the thinned posts' Nyquist wavenumber; of the latter in the second.
struct Restored {
  double smooth_db, restored_db, second_octave_db;
};
Restored restored(const Surface& original, int thin) {
  relief::Raster guide{original.columns / thin, original.rows / thin, original.spacing_m * thin, {0, 0}, {}};
  for (int j = 0; j < guide.rows; ++j) {
    for (int i = 0; i < guide.columns; ++i) guide.value.push_back(original.at(thin * i, thin * j));
  }
  const relief::Detail detail = relief::detail_below({guide.columns, guide.rows, guide.cell_m, guide.value});
  const relief::Window all{0, 0, 0, original.columns, original.rows};
  Surface smooth{original.columns, original.rows, original.spacing_m, std::vector<float>(all.size())};
  relief::smooth_surface(guide, original.spacing_m)(all, smooth.height_m);
  Surface with_detail = smooth;
  std::vector<float> relief(all.size());
  relief::SpectralSurface(detail.spectrum, original.spacing_m, 1, "detail").fill(all, relief);
  for (std::size_t i = 0; i < relief.size(); ++i) with_detail.height_m[i] += relief[i];
  const RadialSpectrum truth = radial_spectrum(original, 128);
  const double nyquist = std::numbers::pi / guide.cell_m;
  return {difference_db(radial_spectrum(smooth, 128), truth, nyquist, 2 * nyquist),
          difference_db(radial_spectrum(with_detail, 128), truth, nyquist, 2 * nyquist),
          difference_db(radial_spectrum(with_detail, 128), truth, 2 * nyquist, 4 * nyquist)};
}

}  // namespace

void add_statistics(CLI::App& app, Verbs& verbs) {
  Verb& verb = verbs.emplace_back(
      app, "statistics",
      "what a grid of heights measures: scaling exponents of its increments, intermittency (k2), how\n"
      "unevenly it is rough, how roughness goes with slope; what thinning and restoring it leaves");
  const auto in = std::make_shared<Inputs>();
  verb.options()
      .add_option("--heights", in->file, "float32, row by row from the south, NaN for holes")
      ->type_name("FILE")
      ->required();
  verb.number("columns", in->columns, 1, 65536, "of the grid");
  verb.number("rows", in->rows, 1, 65536, "of the grid");
  verb.number("spacing_m", in->spacing_m, 1e-4, 1e6, "of the grid");
  verb.number("thin", in->thin, 0, 64, "every such post is kept, and restored from; 0: no restoration");
  verb.results({"zeta_1", "zeta_2", "zeta_3", "k2", "patch", "p95_over_p5", "bimodality", "rms_slope", "smooth_db",
                "restored_db", "restored_second_octave_db"},
               [in] {
                 const Surface surface = read_surface(*in);
                 const ScalingExponents zeta = scaling_exponents(surface);
                 const Patchiness p = patchiness(surface);
                 constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
                 const Restored r =
                     in->thin < 2.0 ? Restored{kNone, kNone, kNone} : restored(surface, static_cast<int>(in->thin));
                 return Verb::Row{zeta.zeta_1,       zeta.zeta_2,   zeta.zeta_3,       zeta.k2(),
                                  p.rms_over_median, p.p95_over_p5, p.bimodality,      p.slope_correlation,
                                  r.smooth_db,       r.restored_db, r.second_octave_db};
               });
}

}  // namespace ensonify::physics
