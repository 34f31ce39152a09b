#include "kernels/echo/gain.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ensonify::echo {
namespace {

void require(bool good, const char* problem) {
  if (!good) throw std::invalid_argument(problem);
}

/// on_sample(value, sample) for every value of an image.
template <class OnSample>
void each_value(Image& image, const OnSample& on_sample) {
  tbb::parallel_for(0, image.beams, [&](int beam) {
    std::size_t k = 0;
    for (auto& value : image.row(beam)) on_sample(value, k++);
  });
}

}  // namespace

void tvg_db(const TvgLaw& law, const Sampling& sampling, std::vector<float>& gain_db) {
  require(law.start_range_m > 0.0, "a gain law needs a start range above 0 m");
  require(law.start_range_m <= law.stop_range_m, "a gain law stops before it starts");
  require(law.min_db <= law.max_db, "a gain law's least gain is above its most");
  require(law.step_db >= 0.0, "a gain law's step must not be negative");
  gain_db.resize(static_cast<std::size_t>(std::max(sampling.count, 0)));
  for (std::size_t k = 0; k < gain_db.size(); ++k) {
    const double time_s = sampling.start_s + static_cast<double>(k) * sampling.period_s;
    const double R = std::clamp(0.5 * law.sound_speed_mps * time_s, law.start_range_m, law.stop_range_m);
    const double wanted = law.spreading_db * std::log10(R) + 2.0 * law.absorption_dbpm * R +
                          law.slope_db_per_100m * 0.01 * R + law.offset_db;
    const double limited = std::clamp(wanted, law.min_db, law.max_db);
    gain_db[k] = static_cast<float>(law.step_db > 0.0 ? law.step_db * std::round(limited / law.step_db) : limited);
  }
}

void apply_gain(std::span<const float> gain_db, Image& image) {
  require(gain_db.size() == static_cast<std::size_t>(image.samples), "a gain needs one value per sample");
  each_value(image, [&](std::complex<float>& p, std::size_t k) { p *= std::pow(10.0F, 0.05F * gain_db[k]); });
}

void saturate(double limit_upa, Image& image) {
  require(limit_upa > 0.0, "a saturation level must be positive");
  const auto limit = static_cast<float>(limit_upa);
  each_value(image, [limit](std::complex<float>& p, std::size_t) {
    const float magnitude = std::sqrt(p.real() * p.real() + p.imag() * p.imag());
    if (magnitude > limit) p *= limit / magnitude;
  });
}

void digitise(const Digitiser& digitiser, Image& image) {
  require(digitiser.bits >= 2 && digitiser.bits <= 24, "a digitiser has 2 to 24 bits");
  require(digitiser.full_scale_upa > 0.0, "a digitiser's full scale must be positive");
  const auto step = static_cast<float>(digitiser.step_upa());
  const auto half = static_cast<float>(std::int64_t{1} << (digitiser.bits - 1));
  const auto part = [=](float x) { return step * std::clamp(std::round(x / step), -half, half - 1.0F); };
  each_value(image, [&](std::complex<float>& p, std::size_t) { p = {part(p.real()), part(p.imag())}; });
}

void amplitude_counts(std::span<const float> amplitude, double step, int bits, std::vector<std::uint16_t>& counts) {
  require(bits >= 1 && bits <= 16, "counts have 1 to 16 bits");
  require(step > 0.0, "a count's step must be positive");
  const auto most = static_cast<float>((1 << bits) - 1);
  const auto inverse = static_cast<float>(1.0 / step);
  counts.resize(amplitude.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    counts[i] = static_cast<std::uint16_t>(std::clamp(std::round(amplitude[i] * inverse), 0.0F, most));
  }
}

}  // namespace ensonify::echo
