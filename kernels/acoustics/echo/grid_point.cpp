#include "kernels/acoustics/echo/grid_point.h"

#include <algorithm>
#include <array>

namespace ensonify::echo {
namespace {

constexpr std::size_t kRun = 256;  // arrivals whose numbers stay in the first cache

template <class T>
using Column = std::array<T, kRun>;

/// Numbers of a run of points.
struct Columns {
  alignas(64) Column<std::int32_t> first, phase, cell;
  alignas(64) Column<float> offset, gain;
};

}  // namespace

void make_points(const EchoSet& set, std::size_t first, std::size_t last, const SineGrid& grid,
                 const SampledPulse& pulse, const Sampling& sampling, const ContributorSet& whose, GridPoint* points) {
  Columns c;
  c.gain.fill(1.0F);
  const double start_s = sampling.start_s, period_s = sampling.period_s;
  const Eigen::Vector3f axis = grid.axis_head;
  const SineGrid by_sine = grid;
  for (; first < last; first += kRun) {
    const std::size_t count = std::min(kRun, last - first);
    const double* const time_s = set.arrivals.time_s.data() + first;
    for (std::size_t i = 0; i < count; ++i) {
      const SampledPulse::Place at = pulse.place((time_s[i] - start_s) / period_s);
      c.first[i] = at.first;
      c.phase[i] = at.phase;
    }
    const float* const x = set.arrivals.direction_head.x.data() + first;
    const float* const y = set.arrivals.direction_head.y.data() + first;
    const float* const z = set.arrivals.direction_head.z.data() + first;
    for (std::size_t i = 0; i < count; ++i) {
      const SineGrid::At at = by_sine.at(x[i] * axis.x() + y[i] * axis.y() + z[i] * axis.z());
      c.cell[i] = at.cell;
      c.offset[i] = at.offset;
    }
    if (!set.gain.empty()) std::copy_n(set.gain.data() + first, count, c.gain.data());
    if (!whose.all()) {
      for (std::size_t i = 0; i < count; ++i) {
        if (!whose.holds(set.arrivals.contributor[first + i])) c.first[i] = sampling.count;
      }
    }
    const float* const re_upa = set.arrivals.pressure_re_upa.data() + first;
    const float* const im_upa = set.arrivals.pressure_im_upa.data() + first;
    for (std::size_t i = 0; i < count; ++i) {
      *points++ = {c.first[i], c.phase[i], c.cell[i], c.offset[i], c.gain[i] * re_upa[i], c.gain[i] * im_upa[i]};
    }
  }
}

}  // namespace ensonify::echo
