#include "kernels/acoustics/echo/grid_point.h"

#include <array>

namespace ensonify::echo {
namespace {

constexpr std::size_t kRun = ByTime<GridPoint>::kRun;

/// First samples of arrivals begin..end - 1 of a set.
void find_first(const GridPoints& of, const EchoSet& set, std::size_t begin, std::size_t end, std::int32_t* first) {
  const double* const time_s = set.arrivals.time_s.data();
  const double start_s = of.sampling.start_s, period_s = of.sampling.period_s;
  const SampledPulse::Grid samples = of.pulse.grid();
  for (std::size_t i = begin; i < end; ++i)
    first[i - begin] = samples.at((time_s[i] - start_s) / period_s).first - of.sampling.first;
  if (of.whose.all()) return;
  for (std::size_t i = begin; i < end; ++i) {
    if (!of.whose.holds(set.arrivals.contributor[i])) first[i - begin] = of.sampling.count;
  }
}

/// Points of arrivals begin..end - 1 of a set, kRun at most.
void make_points(const GridPoints& of, const EchoSet& set, std::size_t begin, std::size_t end, GridPoint* points) {
  struct {
    alignas(64) std::array<std::int32_t, kRun> phase, cell;
    alignas(64) std::array<float, kRun> offset, gain;
  } c;
  const std::size_t count = end - begin;
  const double* const time_s = set.arrivals.time_s.data() + begin;
  const double start_s = of.sampling.start_s, period_s = of.sampling.period_s;
  const SampledPulse::Grid samples = of.pulse.grid();
  for (std::size_t i = 0; i < count; ++i) c.phase[i] = samples.at((time_s[i] - start_s) / period_s).phase;
  const SineGrid grid = of.grid;
  const float ax = grid.axis_head.x(), ay = grid.axis_head.y(), az = grid.axis_head.z();
  const float* const x = set.arrivals.direction_head.x.data() + begin;
  const float* const y = set.arrivals.direction_head.y.data() + begin;
  const float* const z = set.arrivals.direction_head.z.data() + begin;
  for (std::size_t i = 0; i < count; ++i) {
    const SineGrid::At at = grid.at(x[i] * ax + y[i] * ay + z[i] * az);
    c.cell[i] = at.cell;
    c.offset[i] = at.offset;
  }
  if (set.gain.empty()) {
    c.gain.fill(1.0F);
  } else {
    std::copy_n(set.gain.data() + begin, count, c.gain.data());
  }
  alignas(64) std::array<std::int32_t, kRun> first;
  find_first(of, set, begin, end, first.data());
  const float* const re_upa = set.arrivals.pressure_re_upa.data() + begin;
  const float* const im_upa = set.arrivals.pressure_im_upa.data() + begin;
  for (std::size_t i = 0; i < count; ++i)
    points[i] = {first[i], c.phase[i], c.cell[i], c.offset[i], c.gain[i] * re_upa[i], c.gain[i] * im_upa[i]};
}

}  // namespace

void GridPoints::sort(ByTime<GridPoint>& points) const {
  points.set(
      count_arrivals(echoes), pulse, sampling.count,
      [this](std::size_t begin, std::size_t end, std::int32_t* first) {
        for_sets(echoes, begin, end, [&](std::size_t number, std::size_t from, std::size_t to, std::size_t row) {
          find_first(*this, echoes[number], from, to, first + row);
        });
      },
      [this](std::size_t begin, std::size_t end, GridPoint* rows) {
        for_sets(echoes, begin, end, [&](std::size_t number, std::size_t from, std::size_t to, std::size_t row) {
          make_points(*this, echoes[number], from, to, rows + row);
        });
      });
}

void spread(const ByTime<GridPoint>& points, int block, const SampledPulse& pulse, const Spreading& spreading,
            std::complex<float>* rows, std::ptrdiff_t stride) {
  // A row of taps is a vector of 8 numbers and one of 4.
  using Eight = Eigen::Array<float, 8, 1>;
  using Four = Eigen::Array4f;
  static_assert(2 * Spreading::kWidth == 8 + 4);
  points.each(block, pulse, [&](const GridPoint& point, int first, std::span<const float> envelope) {
    const Spreading::Taps taps = spreading.taps(point.offset);
    Four pressure;
    pressure << point.re_upa, point.im_upa, point.re_upa, point.im_upa;
    Eight near;
    near << taps.segment<4>(0) * pressure, taps.segment<4>(4) * pressure;
    const Four far = taps.segment<4>(8) * pressure;
    std::complex<float>* const from = rows + (first - block * ByTime<GridPoint>::kBlock) * stride + point.cell;
    float* numbers = reinterpret_cast<float*>(from);
    for (const float e : envelope) {
      Eigen::Map<Eight>(numbers) += e * near;
      Eigen::Map<Four>(numbers + 8) += e * far;
      numbers += 2 * stride;
    }
  });
}

}  // namespace ensonify::echo
