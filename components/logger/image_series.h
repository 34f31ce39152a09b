#pragma once

#include <optional>
#include <vector>

#include "messages/soundings.h"

namespace ensonify::logger {

/// Samples of one sounding in the image's strengths, by rising range.
struct ImageSeries {
  std::size_t begin = 0;
  std::size_t count = 0;
  std::size_t centre = 0;  // of the detection, from `begin`
  double first_s = 0.0;    // two-way time of the first
};

/// Of each entry of the soundings; none where the head has no image of its beam. What is longer than `most` samples is
/// cut to them, around the detection.
std::vector<std::optional<ImageSeries>> image_series(const msg::Soundings& soundings, const msg::SeabedImage& image,
                                                     std::size_t most);

}  // namespace ensonify::logger
