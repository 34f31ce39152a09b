#include "kernels/acoustics/detect/seabed_image.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "kernels/acoustics/detect/bottom.h"

namespace ensonify::detect {
namespace {

double level_db(double amplitude_upa) { return 20.0 * std::log10(std::max(amplitude_upa, kSilence_upa)); }

double cos_incidence(const FlatteningModel& model, double range_m) {
  return std::min(model.nearest_range_m / range_m, 1.0);
}

template <typename Law>
void fill(std::span<const float> snippet_upa, double first_range_m, double range_step_m, std::span<float> image_db,
          const Law& law) {
  if (image_db.size() != snippet_upa.size()) {
    throw std::invalid_argument("seabed_image_db: a snippet of " + std::to_string(snippet_upa.size()) +
                                " samples does not fit an image of " + std::to_string(image_db.size()));
  }
  if (!(first_range_m > 0.0) || !(range_step_m > 0.0)) {
    throw std::invalid_argument("seabed_image_db: first range " + std::to_string(first_range_m) + " m and step " +
                                std::to_string(range_step_m) + " m must be above 0");
  }
  for (std::size_t k = 0; k < snippet_upa.size(); ++k) {
    image_db[k] = static_cast<float>(
        law(static_cast<double>(snippet_upa[k]), first_range_m + static_cast<double>(k) * range_step_m));
  }
}

}  // namespace

double gain_db(const RangeLaw& law, double range_m) {
  return law.spreading * std::log10(range_m) + 2.0 * law.absorption_dbpm * range_m + law.offset_db;
}

double assumed_angular_db(const FlatteningModel& model, double range_m) {
  const double cosine = cos_incidence(model, range_m);
  const double incidence = std::acos(cosine);
  if (incidence >= model.crossover_rad) return 20.0 * std::log10(cosine);
  const double at_crossover = 20.0 * std::log10(std::cos(model.crossover_rad));
  return model.normal_excess_db + (at_crossover - model.normal_excess_db) * incidence / model.crossover_rad;
}

double assumed_area_db(const FlatteningModel& model, double range_m) {
  const double cosine = cos_incidence(model, range_m);
  const double sine = std::sqrt(1.0 - cosine * cosine);
  const double beam = beam_area_m2(range_m, sine, model.transmit_length_in_waves, model.receive_length_in_waves);
  const double strip_m = 0.5 * model.sound_speed_mps * model.pulse_length_s;
  const double pulse_times_sine = range_m / model.transmit_length_in_waves * strip_m;
  return 10.0 * std::log10(pulse_times_sine < beam * sine ? pulse_times_sine / sine : beam);
}

double flattened_reflectivity_db(const FlatteningModel& model, double snippet_upa, double range_m) {
  const RangeLaw spherical{40.0, model.absorption_dbpm, 0.0};
  return level_db(snippet_upa) - model.source_level_db + gain_db(spherical, range_m) - assumed_area_db(model, range_m) -
         assumed_angular_db(model, range_m);
}

double range_law_reflectivity_db(const RangeLaw& law, double source_level_db, double snippet_upa, double range_m) {
  return level_db(snippet_upa) - source_level_db + gain_db(law, range_m);
}

void seabed_image_db(const FlatteningModel& model, std::span<const float> snippet_upa, double first_range_m,
                     double range_step_m, std::span<float> image_db) {
  fill(snippet_upa, first_range_m, range_step_m, image_db,
       [&](double amplitude, double range_m) { return flattened_reflectivity_db(model, amplitude, range_m); });
}

void seabed_image_db(const RangeLaw& law, double source_level_db, std::span<const float> snippet_upa,
                     double first_range_m, double range_step_m, std::span<float> image_db) {
  fill(snippet_upa, first_range_m, range_step_m, image_db, [&](double amplitude, double range_m) {
    return range_law_reflectivity_db(law, source_level_db, amplitude, range_m);
  });
}

}  // namespace ensonify::detect
