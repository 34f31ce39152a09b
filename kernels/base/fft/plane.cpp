#include "kernels/base/fft/plane.h"

#include <algorithm>
#include <vector>

namespace ensonify::fft {

void transform_plane(std::span<std::complex<float>> numbers, int columns, int rows, Transform::Sign sign) {
  const auto width = static_cast<std::size_t>(columns), height = static_cast<std::size_t>(rows);
  const Transform along_row(columns, sign), along_column(rows, sign);
  for (std::size_t j = 0; j < height; ++j) along_row(numbers.data() + j * width);
  constexpr std::size_t kTogether = 8;             // columns copied at once: a cache line of numbers
  const std::size_t stride = height + height % 2;  // so that every column starts on 16 bytes
  std::vector<std::complex<float>> column(kTogether * stride);
  for (std::size_t first = 0; first < width; first += kTogether) {
    const std::size_t count = std::min(kTogether, width - first);
    for (std::size_t j = 0; j < height; ++j) {
      for (std::size_t i = 0; i < count; ++i) column[i * stride + j] = numbers[j * width + first + i];
    }
    for (std::size_t i = 0; i < count; ++i) along_column(column.data() + i * stride);
    for (std::size_t j = 0; j < height; ++j) {
      for (std::size_t i = 0; i < count; ++i) numbers[j * width + first + i] = column[i * stride + j];
    }
  }
}

}  // namespace ensonify::fft
