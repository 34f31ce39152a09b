#include "kernels/fft/transform.h"

#include <fftw3.h>

#include <mutex>
#include <stdexcept>
#include <vector>

namespace ensonify::fft {
namespace {

std::mutex planner;  // FFTW makes and destroys plans one at a time; using them needs no lock

fftwf_complex* as_fftw(std::complex<float>* numbers) { return reinterpret_cast<fftwf_complex*>(numbers); }

}  // namespace

struct Transform::Plan {
  fftwf_plan plan;

  Plan(int size, Sign sign) {
    const std::scoped_lock lock(planner);
    std::vector<std::complex<float>> numbers(static_cast<std::size_t>(size));
    plan = fftwf_plan_dft_1d(size, as_fftw(numbers.data()), as_fftw(numbers.data()),
                             sign == Sign::kPlus ? FFTW_BACKWARD : FFTW_FORWARD, FFTW_ESTIMATE);
    if (plan == nullptr) throw std::runtime_error("FFTW cannot plan a transform");
  }
  ~Plan() {
    const std::scoped_lock lock(planner);
    fftwf_destroy_plan(plan);
  }
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;
};

Transform::Transform(int size, Sign sign) : plan_(std::make_shared<Plan>(size, sign)) {}

void Transform::operator()(std::complex<float>* numbers) const {
  fftwf_execute_dft(plan_->plan, as_fftw(numbers), as_fftw(numbers));
}

int Transform::good_size(int least) {
  for (int size = least + least % 2;; size += 2) {
    int rest = size;
    for (const int factor : {2, 3, 5}) {
      while (rest % factor == 0) rest /= factor;
    }
    if (rest == 1) return size;
  }
}

}  // namespace ensonify::fft
