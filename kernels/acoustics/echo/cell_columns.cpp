#include "kernels/acoustics/echo/cell_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "kernels/base/fast_math/fast_math.h"
#include "kernels/base/isa/wide.h"

namespace ensonify::echo {
namespace {

template <class T>
using Column = std::array<T, kCellRun>;

}  // namespace

ENSONIFY_WIDE void find_parts(const Insonification& batch, CellLattice lattice, std::size_t first, std::size_t end,
                              CellParts& parts) {
  const auto& at = batch.hits.position_enu_m;
  const double *const x = at.x.data(), *const y = at.y.data(), *const z = at.z.data();
  const float* const range_m = batch.hits.range_m.data();
  std::uint64_t* const cell = parts.cell.data();
  for (std::size_t i = first; i < end; ++i) {
    const std::uint64_t number = lattice.cell_at(x[i], y[i], z[i], static_cast<double>(range_m[i])).number;
    cell[i] = range_m[i] > 0.0F ? number : kNoCell;
  }
  const float* const sin_grazing = batch.hits.sin_grazing.data();
  const float* const tube_m2 = batch.hits.tube_m2.data();
  const float* const solid_angle_sr = batch.rays.solid_angle_sr.data();
  const float* const backscatter = batch.backscatter.data();
  const float* const source_upa2m2 = batch.source_upa2m2.data();
  float* const scattered = parts.scattered_upa2m2.data();
  float* const cross_section = parts.cross_section_m2.data();
  for (std::size_t i = first; i < end; ++i) {
    const float sine = sin_grazing[i] < 1e-3F ? 1e-3F : sin_grazing[i];  // std::max() of places would be no vector code
    const float sigma_solid = backscatter[i] * solid_angle_sr[i] / sine;
    scattered[i] = source_upa2m2[i] * sigma_solid;
    cross_section[i] = tube_m2[i] * sigma_solid;
  }
}

namespace {

/// Rays' hits, gathered.
struct Gathered {
  alignas(64) Column<double> x, y, z;
  alignas(64) Column<float> normal_x, normal_y, normal_z, launch_x, launch_y, launch_z;
  alignas(64) Column<float> range_m, time_s, length_m, tube_m2;

  /// Not within vector code, which would put vectors together from these loads: slower than the loads alone.
  [[gnu::noinline]] Gathered(const Insonification& batch, std::span<const std::uint32_t> rays) {
    const trace::Hits& hits = batch.hits;
    const auto& launch = batch.rays.direction_head;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const std::size_t ray = rays[i];
      x[i] = hits.position_enu_m.x[ray], y[i] = hits.position_enu_m.y[ray], z[i] = hits.position_enu_m.z[ray];
      normal_x[i] = hits.normal_enu.x[ray], normal_y[i] = hits.normal_enu.y[ray], normal_z[i] = hits.normal_enu.z[ray];
      launch_x[i] = launch.x[ray], launch_y[i] = launch.y[ray], launch_z[i] = launch.z[ray];
      range_m[i] = hits.range_m[ray], time_s[i] = hits.travel_time_s[ray];
      length_m[i] = hits.path_length_m[ray], tube_m2[i] = hits.tube_m2[ray];
    }
  }
};

/// Random bits of cells.
struct Bits {
  alignas(64) std::array<Column<std::uint32_t>, 4> word;

  Bits(const random::Stream& stream, std::span<const std::uint64_t> cells) {
    using Run = random::Stream::Run;
    static_assert(kCellRun % Run::kSize == 0);
    std::array<std::uint64_t, Run::kSize> some{};
    Run run;
    for (std::size_t first = 0; first < cells.size(); first += Run::kSize) {
      std::copy_n(cells.data() + first, std::min(Run::kSize, cells.size() - first), some.data());
      stream.run(some, run);
      for (std::size_t w = 0; w < 4; ++w) std::copy_n(run.word[w].data(), Run::kSize, word[w].data() + first);
    }
  }
};

}  // namespace

ENSONIFY_WIDE void find_geometry(const Insonification& batch, CellLattice lattice, const CellStreams& streams,
                                 std::span<const std::uint32_t> rays, Scatterers& found, std::size_t first) {
  const std::size_t count = rays.size();
  const Gathered hit(batch, rays);
  const auto cell_of = [&](std::size_t i) {
    return lattice.cell_at(hit.x[i], hit.y[i], hit.z[i], static_cast<double>(hit.range_m[i]));
  };
  alignas(64) Column<std::uint64_t> cell;
  for (std::size_t i = 0; i < count; ++i) cell[i] = cell_of(i).number;
  const std::span some = std::span(cell).first(count);
  const Bits bits(streams.places, some);
  std::optional<Bits> others;
  if (streams.speckle) others.emplace(*streams.speckle, some);
  const Bits& drawn = others ? *others : bits;
  // Somewhere in the cell, from the hit, then down to the facet.
  alignas(64) Column<double> east, north, up;
  const auto part = [](std::uint32_t whole) { return 0x1p-16 * static_cast<std::int32_t>(whole); };
  for (std::size_t i = 0; i < count; ++i) {
    const frames::Vec3 at = lattice.place(cell_of(i), part(bits.word[2][i] & 0xffff), part(bits.word[2][i] >> 16),
                                          part(bits.word[3][i] & 0xffff));
    east[i] = at.x() - hit.x[i], north[i] = at.y() - hit.y[i], up[i] = at.z() - hit.z[i];
  }
  double *const at_x = found.position_enu_m.x.data() + first, *const at_y = found.position_enu_m.y.data() + first,
                *const at_z = found.position_enu_m.z.data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    const auto nx = static_cast<double>(hit.normal_x[i]), ny = static_cast<double>(hit.normal_y[i]),
               nz = static_cast<double>(hit.normal_z[i]);
    const double above = nx * east[i] + ny * north[i] + nz * up[i];
    at_x[i] = hit.x[i] + (east[i] - nx * above);
    at_y[i] = hit.y[i] + (north[i] - ny * above);
    at_z[i] = hit.z[i] + (up[i] - nz * above);
  }
  // The ray's direction at the head, less that of the straight line.
  float *const bend_x = found.bend_enu.x.data() + first, *const bend_y = found.bend_enu.y.data() + first,
               *const bend_z = found.bend_enu.z.data() + first;
  const Eigen::Matrix3d R = batch.pose.enu_from_head.toRotationMatrix();
  const frames::Vec3 head = batch.pose.position_enu_m;
  for (std::size_t i = 0; i < count; ++i) {
    const double per_m = 1.0 / static_cast<double>(hit.range_m[i]);
    const auto x = static_cast<double>(hit.launch_x[i]), y = static_cast<double>(hit.launch_y[i]),
               z = static_cast<double>(hit.launch_z[i]);
    bend_x[i] = static_cast<float>(R(0, 0) * x + R(0, 1) * y + R(0, 2) * z - (hit.x[i] - head.x()) * per_m);
    bend_y[i] = static_cast<float>(R(1, 0) * x + R(1, 1) * y + R(1, 2) * z - (hit.y[i] - head.y()) * per_m);
    bend_z[i] = static_cast<float>(R(2, 0) * x + R(2, 1) * y + R(2, 2) * z - (hit.z[i] - head.z()) * per_m);
  }
  // A complex Gaussian of mean square 1 (Box and Muller [BoxMuller1958]).
  float *const re = found.response_re.data() + first, *const im = found.response_im.data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    const float u = (static_cast<float>(static_cast<std::int32_t>(drawn.word[0][i] >> 8)) + 0.5F) * 0x1p-24F;
    const float radius = std::sqrt(-fast_math::log(u));
    const fast_math::Direction direction = fast_math::direction_of(drawn.word[1][i]);
    re[i] = radius * direction.cosine;
    im[i] = radius * direction.sine;
  }
  float *const slowness_spm = found.slowness_spm.data() + first, *const stretch = found.stretch.data() + first,
               *const spreading = found.spreading.data() + first, *const share = found.share.data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    const float range_m = hit.range_m[i];
    slowness_spm[i] = hit.time_s[i] / range_m;
    stretch[i] = hit.length_m[i] / range_m;
    spreading[i] = hit.tube_m2[i] / (range_m * range_m);
    share[i] = 1.0F;
  }
}

}  // namespace ensonify::echo
