#include "kernels/acoustics/echo/image.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "kernels/acoustics/trace/batch.h"
#include "kernels/base/random/stream.h"

namespace ensonify::echo {

void amplitude_upa(const Image& image, std::vector<float>& amplitude) {
  trace::make_elements(amplitude, image.envelope_upa.size());
  tbb::parallel_for(0, image.beams, [&](int beam) {
    float* out = amplitude.data() + static_cast<std::size_t>(beam) * static_cast<std::size_t>(image.samples);
    for (const auto& p : image.row(beam)) *out++ = std::sqrt(p.real() * p.real() + p.imag() * p.imag());
  });
}

void add_noise(double level_db, std::uint64_t ping, const random::Stream& stream, Image& image) {
  const auto sd = static_cast<float>(std::sqrt(0.5 * std::pow(10.0, 0.1 * level_db)));
  if (sd == 0.0F) return;
  tbb::parallel_for(0, image.beams, [&](int beam) {
    random::add_gaussian(stream, ping, static_cast<std::uint64_t>(beam) << 32, sd, image.row(beam));
  });
}

}  // namespace ensonify::echo
