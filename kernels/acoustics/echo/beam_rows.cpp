#include "kernels/acoustics/echo/beam_rows.h"

#include <cmath>
#include <cstring>

namespace ensonify::echo {
namespace {

constexpr std::size_t kRow = 2 * BeamRows::kSamples;
constexpr std::size_t kTile = 4;  // samples and cells that are turned together: complex numbers of four registers

using Complex = std::complex<float>;

/// Four complex numbers by their bits. Written for the compiler's vectors: what it makes of loops goes through memory.
using Four = double __attribute__((vector_size(32)));

Four load(const Complex* from) {
  Four four;
  std::memcpy(&four, from, sizeof four);
  return four;
}

void turn(const Complex* from, std::size_t stride, float* to) {
  const Four a = load(from), b = load(from + stride), c = load(from + 2 * stride), d = load(from + 3 * stride);
  const Four even_ab = __builtin_shufflevector(a, b, 0, 4, 2, 6), odd_ab = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Four even_cd = __builtin_shufflevector(c, d, 0, 4, 2, 6), odd_cd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  const Four turned[kTile] = {
      __builtin_shufflevector(even_ab, even_cd, 0, 1, 4, 5), __builtin_shufflevector(odd_ab, odd_cd, 0, 1, 4, 5),
      __builtin_shufflevector(even_ab, even_cd, 2, 3, 6, 7), __builtin_shufflevector(odd_ab, odd_cd, 2, 3, 6, 7)};
  for (std::size_t cell = 0; cell < kTile; ++cell) std::memcpy(to + cell * kRow, &turned[cell], sizeof(Four));
}

}  // namespace

void BeamRows::set(const Complex* grid, std::size_t stride) {
  cells_.resize(stride * kRow);
  std::size_t cell = 0;
  for (; cell + kTile <= stride; cell += kTile) {
    for (std::size_t r = 0; r < kSamples; r += kTile)
      turn(grid + r * stride + cell, stride, cells_.data() + cell * kRow + 2 * r);
  }
  for (; cell < stride; ++cell) {
    for (std::size_t r = 0; r < kSamples; ++r) {
      cells_[cell * kRow + 2 * r] = grid[r * stride + cell].real();
      cells_[cell * kRow + 2 * r + 1] = grid[r * stride + cell].imag();
    }
  }
}

void BeamRows::read(std::size_t first, const Spreading::Taps& taps, Row& row) const {
  static_assert(Spreading::kWidth == 6);
  const float* const cell = cells_.data() + first * kRow;
  const float a = taps[0], b = taps[2], c = taps[4], d = taps[6], e = taps[8], f = taps[10];
  float* const to = row.data();
  for (std::size_t i = 0; i < kRow; ++i) {
    to[i] = (a * cell[i] + b * cell[i + kRow]) + (c * cell[i + 2 * kRow] + d * cell[i + 3 * kRow]) +
            (e * cell[i + 4 * kRow] + f * cell[i + 5 * kRow]);
  }
}

void add(const BeamRows::Row& one, const BeamRows::Row& other, BeamRows::Row& sum) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = one[i] + other[i];
}

void magnitudes(const BeamRows::Row& row, std::array<float, BeamRows::kSamples>& amplitude) {
  for (std::size_t i = 0; i < amplitude.size(); ++i)
    amplitude[i] = std::sqrt(row[2 * i] * row[2 * i] + row[2 * i + 1] * row[2 * i + 1]);
}

}  // namespace ensonify::echo
