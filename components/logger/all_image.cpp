#include "components/logger/all_image.h"

#include <algorithm>
#include <numbers>

#include "components/logger/beam_fields.h"
#include "components/logger/image_series.h"

namespace ensonify::logger {

using formats::all::SeabedImage;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// What the head's image says of itself.
SeabedImage header(const msg::SeabedImage& image, double sound_speed_mps) {
  SeabedImage written;
  written.sampling_hz = sampling_hz(image.sample_period_s);
  written.normal_incidence_samples =
      count_of(2.0 * image.normal_incidence_range_m / sound_speed_mps / image.sample_period_s);
  written.normal_incidence_strength_db = written.normal_incidence_strength_db.of(image.normal_incidence_strength_db);
  written.oblique_strength_db = written.oblique_strength_db.of(image.oblique_strength_db);
  written.crossover_deg = written.crossover_deg.of(image.crossover_angle_rad / kDegree);
  return written;
}

/// All samples of a ping run from port to starboard: on the port side the highest range comes first.
void append(const msg::SeabedImage& image, const ImageSeries& series, SeabedImage::Beam& beam, SeabedImage& written) {
  const bool reversed = beam.direction < 0;
  beam.samples = static_cast<std::uint16_t>(series.count);
  beam.centre_sample = static_cast<std::uint16_t>(reversed ? series.count - series.centre : series.centre + 1);
  for (std::size_t k = 0; k < series.count; ++k) {
    const std::size_t from = series.begin + (reversed ? series.count - 1 - k : k);
    written.strength_ddb.push_back(tenths(static_cast<double>(image.strength_db[from])));
  }
}

}  // namespace

SeabedImage seabed_image(const msg::Soundings& soundings, const std::optional<msg::SeabedImage>& image) {
  SeabedImage written = image ? header(*image, soundings.applied.sound_speed_mps) : SeabedImage{};
  if (!image) written.sampling_hz = sampling_hz(soundings.sample_period_s);
  written.transmit_width_deg = written.transmit_width_deg.of(soundings.applied.transmit_beamwidth_rad / kDegree);

  const std::size_t entries = soundings.beam_angle_rad.size();
  const std::size_t most = kMostImageBytes / sizeof(std::int16_t) / std::max<std::size_t>(entries, 1);
  std::vector<std::optional<ImageSeries>> series(entries);
  if (image) series = image_series(soundings, *image, most);
  for (std::size_t i = 0; i < entries; ++i) {
    SeabedImage::Beam beam;
    beam.direction = soundings.beam_angle_rad[i] < 0.0F ? -1 : 1;
    beam.detection = detection_of(soundings, i);
    if (series[i]) {
      append(*image, *series[i], beam, written);
    } else if (!image && is_valid(soundings, i)) {
      beam.samples = beam.centre_sample = 1;
      written.strength_ddb.push_back(tenths(at_or_nan(soundings.backscatter_strength_db, i)));
    }
    written.beams.push_back(beam);
  }
  return written;
}

}  // namespace ensonify::logger
