#include "kernels/acoustics/echo/image.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "kernels/acoustics/trace/batch.h"

namespace ensonify::echo {

void amplitude_upa(const Image& image, std::vector<float>& amplitude) {
  trace::make_elements(amplitude, image.envelope_upa.size());
  amplitude_upa(image, std::span(amplitude));
}

void amplitude_upa(const Image& image, std::span<float> amplitude) {
  tbb::parallel_for(0, image.beams, [&](int beam) {
    float* out = amplitude.data() + static_cast<std::size_t>(beam) * static_cast<std::size_t>(image.samples);
    for (const auto& p : image.row(beam)) *out++ = std::sqrt(p.real() * p.real() + p.imag() * p.imag());
  });
}

}  // namespace ensonify::echo
