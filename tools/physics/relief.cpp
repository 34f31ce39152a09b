// Verbs of relief: made, and measured.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "kernels/seabed/relief/bodies.h"
#include "kernels/seabed/relief/guide.h"
#include "kernels/seabed/relief/marks.h"
#include "kernels/seabed/relief/ripples.h"
#include "kernels/seabed/relief/seabed.h"
#include "kernels/seabed/relief/spectral_surface.h"
#include "kernels/seabed/relief/spectrum.h"
#include "kernels/seabed/statistics/power_spectrum.h"
#include "kernels/seabed/statistics/surface.h"
#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

enum class What { kSpectral, kMultifractal, kOutcrops, kRipples, kBoulders, kMounds, kPockmarks, kTrawl };

struct Inputs {
  What layer = What::kSpectral;
  double seed = 1.0, spacing_m = 0.1;
  double rms_m = 0.3, hurst = 0.625, outer_scale_m = 50.0, inner_scale_m = 0.0, intermittency = 0.25, fill_m = -0.1;
  double wavelength_m = 2.0, height_m = 0.15, heading_deg = 90.0, lee_fraction = 0.4, disorder = 0.3;
  double per_km2 = 5000.0, smallest_radius_m = 0.5, largest_radius_m = 3.0;
  double north_m = 0.0, east_m = 0.0;

  auto of_layer() const {
    return std::tuple(layer, seed, spacing_m, rms_m, hurst, outer_scale_m, inner_scale_m, intermittency, fill_m,
                      wavelength_m, height_m, heading_deg, lee_fraction, disorder, per_km2, smallest_radius_m,
                      largest_radius_m);
  }
};

/// A field as a function that owns what it is made of.
template <class Kernel>
relief::Field owned(Kernel kernel) {
  return [kernel = std::move(kernel)](const relief::Window& window, std::span<float> out) { kernel.fill(window, out); };
}

relief::Field spectral(const Inputs& in, double rms_m, const char* name, const relief::Field& amplitude = nullptr) {
  const relief::SpectralSurface surface({rms_m, in.hurst, in.outer_scale_m, in.inner_scale_m}, in.spacing_m,
                                        static_cast<std::uint64_t>(in.seed), name);
  return [surface, amplitude](const relief::Window& window, std::span<float> out) {
    surface.fill(window, out, amplitude);
  };
}

relief::Field multifractal(const Inputs& in, std::uint64_t seed) {
  return spectral(in, in.rms_m, "relief",
                  owned(relief::LognormalCascade({.intermittency = in.intermittency, .outer_scale_m = in.outer_scale_m},
                                                 in.spacing_m, seed, "relief")));
}

relief::Field bodies(const Inputs& in, relief::BodyShape shape, std::uint64_t seed) {
  return owned(relief::Bodies({.shape = shape,
                               .per_km2 = in.per_km2,
                               .smallest_radius_m = in.smallest_radius_m,
                               .largest_radius_m = in.largest_radius_m,
                               .height_per_radius = shape == relief::BodyShape::kBoulder ? 0.8 : 0.2,
                               .height_ln_sd = 0.2,
                               .elongation = 1.5},
                              in.spacing_m, seed, "bodies"));
}

relief::Field field_of(const Inputs& in) {
  const auto seed = static_cast<std::uint64_t>(in.seed);
  const double heading_rad = in.heading_deg * std::numbers::pi / 180.0;
  switch (in.layer) {
    case What::kSpectral: return spectral(in, in.rms_m, "relief");
    case What::kMultifractal: return multifractal(in, seed);
    case What::kOutcrops: {
      const relief::Field sand =
          relief::sum({relief::constant(static_cast<float>(in.fill_m)), spectral(in, 0.03 * in.rms_m, "sand")});
      const relief::Seabed seabed(multifractal(in, seed), nullptr,
                                  {{.height_m = sand, .join = relief::Layer::Join::kCover}});
      return [seabed](const relief::Window& window, std::span<float> out) { seabed.fill(window, out, {}); };
    }
    case What::kRipples:
      return owned(relief::Ripples({.wavelength_m = in.wavelength_m,
                                    .height_m = in.height_m,
                                    .travel_heading_rad = heading_rad,
                                    .lee_fraction = in.lee_fraction,
                                    .disorder = in.disorder},
                                   in.spacing_m, seed, "ripples"));
    case What::kBoulders: return bodies(in, relief::BodyShape::kBoulder, seed);
    case What::kMounds: return bodies(in, relief::BodyShape::kMound, seed);
    case What::kPockmarks: return bodies(in, relief::BodyShape::kPockmark, seed);
    case What::kTrawl:
      return owned(relief::Marks({.tracks_per_km2 = in.per_km2, .heading_rad = heading_rad, .depth_m = in.height_m},
                                 in.spacing_m, seed, "trawl"));
  }
  throw std::invalid_argument("relief: no such layer");
}

/// Heights of posts, made block by block and kept: a sweep asks for neighbours.
class Heights {
 public:
  double at(const Inputs& in) {
    if (!field_ || key_ != in.of_layer()) {
      blocks_.clear();
      field_ = field_of(in);
      key_ = in.of_layer();
    }
    const std::int64_t east = std::llround(in.east_m / in.spacing_m), north = std::llround(in.north_m / in.spacing_m);
    auto& block = blocks_[{east >> 7, north >> 7}];
    const relief::Window window{0, east & ~std::int64_t{127}, north & ~std::int64_t{127}, 128, 128};
    if (block.empty()) {
      block.resize(window.size());
      field_(window, block);
    }
    return block[window.node(static_cast<int>(east & 127), static_cast<int>(north & 127))];
  }

 private:
  relief::Field field_;
  decltype(Inputs{}.of_layer()) key_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<float>> blocks_;
};

using namespace relief_statistics;

struct Grid {
  std::string file;
  double columns = 512, rows = 512, spacing_m = 1.0, thin = 0;
};

Surface read_surface(const Grid& in) {
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

void add_relief(CLI::App& app, Verbs& verbs) {
  Verb& verb =
      verbs.emplace_back(app, "relief",
                         "height of generated seabed at the nearest post of the world's lattice, m; one layer\n"
                         "at a time (outcrops: multifractal rock with sand up to fill_m)");
  const auto in = std::make_shared<Inputs>();
  verb.choice("layer", in->layer,
              {{"spectral", What::kSpectral},
               {"multifractal", What::kMultifractal},
               {"outcrops", What::kOutcrops},
               {"ripples", What::kRipples},
               {"boulders", What::kBoulders},
               {"mounds", What::kMounds},
               {"pockmarks", What::kPockmarks},
               {"trawl", What::kTrawl}},
              "what to make");
  verb.number("seed", in->seed, 0, 1e9, "of the random numbers");
  verb.number("spacing_m", in->spacing_m, 1e-3, 1e3, "of the posts");
  verb.number("rms_m", in->rms_m, 0, 100, "of spectral relief");
  verb.number("hurst", in->hurst, 0.01, 1, "its Hurst exponent");
  verb.number("outer_scale_m", in->outer_scale_m, 1e-2, 1e6, "its longest waves");
  verb.number("inner_scale_m", in->inner_scale_m, 0, 1e6, "its shortest waves; 0: down to the posts");
  verb.number("intermittency", in->intermittency, 0, 0.7, "of multifractal relief");
  verb.number("fill_m", in->fill_m, -100, 100, "level of the sand between outcrops");
  verb.number("wavelength_m", in->wavelength_m, 1e-2, 1e3, "of ripples");
  verb.number("height_m", in->height_m, 0, 10, "of ripples, crest to trough; depth of trawl scars");
  verb.number("heading_deg", in->heading_deg, 0, 360, "that ripples travel to, or trawls");
  verb.number("lee_fraction", in->lee_fraction, 0.3, 0.5, "of a ripple's length under its lee side");
  verb.number("disorder", in->disorder, 0, 1, "of ripples: bent, short and forked crests");
  verb.number("per_km2", in->per_km2, 0, 1e9, "bodies or tracks");
  verb.number("smallest_radius_m", in->smallest_radius_m, 1e-3, 1e3, "of bodies");
  verb.number("largest_radius_m", in->largest_radius_m, 1e-3, 1e3, "of bodies");
  verb.number("north_m", in->north_m, -1e6, 1e6, "place, from the scenario's origin");
  verb.number("east_m", in->east_m, -1e6, 1e6, "place, from the scenario's origin");
  const auto heights = std::make_shared<Heights>();
  verb.results({"elevation_m"}, [in, heights] { return Verb::Row{heights->at(*in)}; });
}

void add_statistics(CLI::App& app, Verbs& verbs) {
  Verb& verb = verbs.emplace_back(
      app, "statistics",
      "what a grid of heights measures: scaling exponents of its increments, intermittency (k2), how\n"
      "unevenly it is rough, how roughness goes with slope; what thinning and restoring it leaves");
  const auto in = std::make_shared<Grid>();
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
