#include "kernels/echo/noise.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

namespace ensonify::echo {
namespace {

/// A complex Gaussian of standard deviation `sd` per component, from two words (Box and Muller [BoxMuller1958]).
std::complex<float> gaussian(std::uint32_t for_radius, std::uint32_t for_angle, float sd) {
  const float u = (static_cast<float>(for_radius) + 0.5F) * 0x1p-32F;  // rounds up to 1 at most, where the radius is 0
  const float radius = sd * std::sqrt(-2.0F * std::log(u));
  const float angle = 2.0F * std::numbers::pi_v<float> * 0x1p-32F * static_cast<float>(for_angle);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

void add_noise(double level_db, std::uint64_t ping, const random::Stream& stream, Image& image) {
  const auto sd = static_cast<float>(std::sqrt(0.5 * std::pow(10.0, 0.1 * level_db)));
  if (sd == 0.0F) return;
  tbb::parallel_for(0, image.beams, [&](int beam) {
    const auto row = image.row(beam);
    for (std::size_t k = 0; k < row.size(); k += 2) {  // one block of bits serves two samples
      const auto bits = stream.bits(ping, static_cast<std::uint64_t>(beam), k / 2);
      row[k] += gaussian(bits[0], bits[1], sd);
      if (k + 1 < row.size()) row[k + 1] += gaussian(bits[2], bits[3], sd);
    }
  });
}

}  // namespace ensonify::echo
