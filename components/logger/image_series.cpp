#include "components/logger/image_series.h"

#include <algorithm>

namespace ensonify::logger {

namespace {

ImageSeries series_of(const msg::SeabedImage& image, std::size_t number, std::size_t most) {
  const std::size_t end = std::min<std::size_t>(image.offset[number + 1], image.strength_db.size());
  const std::size_t begin = std::min<std::size_t>(image.offset[number], end), samples = end - begin;
  const std::size_t centre = number < image.centre.size() ? std::min<std::size_t>(image.centre[number], samples) : 0;
  const double first_s = number < image.first_sample_s.size() ? static_cast<double>(image.first_sample_s[number]) : 0.0;
  if (samples <= most) return {begin, samples, centre, first_s};
  const std::size_t cut = std::min(centre - std::min(centre, most / 2), samples - most);
  return {begin + cut, most, centre - cut, first_s + static_cast<double>(cut) * image.sample_period_s};
}

}  // namespace

std::vector<std::optional<ImageSeries>> image_series(const msg::Soundings& soundings, const msg::SeabedImage& image,
                                                     std::size_t most) {
  const std::size_t entries = soundings.beam_angle_rad.size();
  std::vector<std::optional<ImageSeries>> found(entries);
  std::size_t next = 0;  // of the image's series, whose beams rise
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t beam = i < soundings.beam.size() ? soundings.beam[i] : i;
    while (next < image.beam.size() && image.beam[next] < beam) ++next;
    const bool has_series = next < image.beam.size() && image.beam[next] == beam && next + 1 < image.offset.size();
    if (has_series) found[i] = series_of(image, next++, most);
  }
  return found;
}

}  // namespace ensonify::logger
