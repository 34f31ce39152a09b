#include "kernels/base/fft/transform.h"

#include <fftw3.h>

#include <algorithm>
#include <initializer_list>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace ensonify::fft {
namespace {

std::mutex planner;  // FFTW makes and destroys plans one at a time; using them needs no lock

/// What is left of a number without these factors.
int without(int number, std::initializer_list<int> factors) {
  for (const int factor : factors) {
    while (number % factor == 0) number /= factor;
  }
  return number;
}

fftwf_complex* as_fftw(std::complex<float>* numbers) { return reinterpret_cast<fftwf_complex*>(numbers); }

}  // namespace

struct Transform::Plan {
  fftwf_plan in_place, apart;

  Plan(int size, Sign sign) {
    const std::scoped_lock lock(planner);
    std::vector<std::complex<float>> numbers(static_cast<std::size_t>(size)), others(numbers.size());
    const int direction = sign == Sign::kPlus ? FFTW_BACKWARD : FFTW_FORWARD;
    in_place = fftwf_plan_dft_1d(size, as_fftw(numbers.data()), as_fftw(numbers.data()), direction, FFTW_ESTIMATE);
    apart = fftwf_plan_dft_1d(size, as_fftw(numbers.data()), as_fftw(others.data()), direction, FFTW_ESTIMATE);
    if (in_place == nullptr || apart == nullptr) throw std::runtime_error("FFTW cannot plan a transform");
  }
  ~Plan() {
    const std::scoped_lock lock(planner);
    fftwf_destroy_plan(in_place);
    fftwf_destroy_plan(apart);
  }
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;
};

Transform::Transform(int size, Sign sign) : plan_(std::make_shared<Plan>(size, sign)) {}

void Transform::operator()(std::complex<float>* numbers) const {
  fftwf_execute_dft(plan_->in_place, as_fftw(numbers), as_fftw(numbers));
}

void Transform::operator()(const std::complex<float>* from, std::complex<float>* to) const {
  fftwf_execute_dft(plan_->apart, as_fftw(const_cast<std::complex<float>*>(from)), as_fftw(to));  // from is kept
}

int Transform::good_size(int least) {
  for (int size = least + least % 2;; size += 2) {
    if (without(size, {2, 3, 5}) == 1) return size;
  }
}

int Transform::fast_size(int least) {
  for (int size = std::max(8, (least + 7) / 8 * 8);; size += 8) {
    const int threes = without(size, {2, 5});
    if (threes == 1 || threes == 3) return size;
  }
}

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
