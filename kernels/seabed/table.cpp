#include "kernels/seabed/table.h"

#include <stdexcept>
#include <string>

namespace ensonify::seabed {
namespace {

constexpr double kErrorDb = 0.05;
constexpr double kNothing = 1e-10;  // cross section, -100 dB
constexpr int kMostPerOctave = 1024;

std::vector<float> sample(const Law& law, const Steps& steps) {
  std::vector<float> values(steps.count() + 2);
  for (std::size_t i = 0; i <= steps.count(); ++i) values[i] = static_cast<float>(law(steps.grazing_rad(i, 0.0)));
  values.back() = values[steps.count()];  // so that the last place has a right neighbour
  return values;
}

double greatest_error_db(const Law& law, const Steps& steps, const std::vector<float>& values) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < steps.count(); ++i) {
    const double interpolated = 0.5 * (static_cast<double>(values[i]) + static_cast<double>(values[i + 1]));
    const double exact = law(steps.grazing_rad(i, 0.5));
    greatest =
        std::max(greatest, std::abs(10.0 * std::log10(std::max(interpolated, kNothing) / std::max(exact, kNothing))));
  }
  return greatest;
}

}  // namespace

double Steps::grazing_rad(std::size_t step, double part) const {
  const double octaves = std::floor(static_cast<double>(step) / per_octave());
  const double within = (static_cast<double>(step) + part) / per_octave() - octaves;
  const double v = std::ldexp(1.0 + within, kFirstOctave + static_cast<int>(octaves));
  // sin(grazing) = v / (1 + v), so 1 / (1 + v) = 1 - cos(incidence) = 2 sin^2(incidence / 2): exact near 90 degrees.
  const double incidence = 2.0 * std::asin(std::sqrt(0.5 / (1.0 + v)));
  // Near 0 degrees the sine itself is exact.
  return v < 1.0 ? std::asin(v / (1.0 + v)) : std::numbers::pi / 2.0 - incidence;
}

BackscatterTable::BackscatterTable(const Law& law, int least_per_octave) : steps_(least_per_octave) {
  for (;;) {
    values_ = sample(law, steps_);
    error_db_ = greatest_error_db(law, steps_, values_);
    if (error_db_ <= kErrorDb || steps_.per_octave() >= kMostPerOctave) return;
    steps_ = Steps(2 * steps_.per_octave());
  }
}

ClassTables::ClassTables(std::span<const Law> laws) {
  if (laws.empty() || laws.size() > row_start_.size()) {
    throw std::invalid_argument(std::to_string(laws.size()) + " classes of seabed: allowed are 1 to 256");
  }
  std::vector<BackscatterTable> tables;
  for (const auto& law : laws) {
    tables.emplace_back(law, steps_.per_octave());
    steps_ = tables.back().steps();  // the finest so far
  }
  // A law that few steps give well enough may want more than the finest has: by chance none of the few fell on a bend.
  for (bool alike = false; !alike;) {
    alike = true;
    for (std::size_t i = 0; i < laws.size(); ++i) {
      if (tables[i].steps().per_octave() == steps_.per_octave()) continue;
      tables[i] = BackscatterTable(laws[i], steps_.per_octave());
      alike = alike && tables[i].steps().per_octave() == steps_.per_octave();
      steps_ = tables[i].steps();
    }
  }
  for (std::size_t i = 0; i < laws.size(); ++i) {
    row_start_[i] = static_cast<std::uint32_t>(values_.size());
    values_.insert(values_.end(), tables[i].values().begin(), tables[i].values().end());
  }
}

}  // namespace ensonify::seabed
