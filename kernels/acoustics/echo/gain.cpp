#include "kernels/acoustics/echo/gain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ensonify::echo {
namespace {

void require(bool good, const char* problem) {
  if (!good) throw std::invalid_argument(problem);
}

}  // namespace

void tvg_db(const TvgLaw& law, const Sampling& sampling, std::vector<float>& gain_db) {
  require(law.start_range_m > 0.0, "a gain law needs a start range above 0 m");
  require(law.start_range_m <= law.stop_range_m, "a gain law stops before it starts");
  require(law.min_db <= law.max_db, "a gain law's least gain is above its most");
  require(law.step_db >= 0.0, "a gain law's step must not be negative");
  gain_db.resize(static_cast<std::size_t>(std::max(sampling.count, 0)));
  for (std::size_t k = 0; k < gain_db.size(); ++k) {
    const double time_s = sampling.time_s(static_cast<int>(k));
    const double R = std::clamp(0.5 * law.sound_speed_mps * time_s, law.start_range_m, law.stop_range_m);
    const double wanted = law.spreading_db * std::log10(R) + 2.0 * law.absorption_dbpm * R +
                          law.slope_db_per_100m * 0.01 * R + law.offset_db;
    const double limited = std::clamp(wanted, law.min_db, law.max_db);
    gain_db[k] = static_cast<float>(law.step_db > 0.0 ? law.step_db * std::round(limited / law.step_db) : limited);
  }
}

void apply_gain(std::span<const float> gain_db, std::span<float> amplitude) {
  const std::size_t samples = gain_db.size();
  require(samples > 0 ? amplitude.size() % samples == 0 : amplitude.empty(), "a gain needs one value per sample");
  std::vector<float> gain(gain_db.begin(), gain_db.end());
  for (float& value : gain) value = std::pow(10.0F, 0.05F * value);
  for (std::size_t row = 0; row < amplitude.size(); row += samples) {
    for (std::size_t k = 0; k < samples; ++k) amplitude[row + k] *= gain[k];
  }
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
