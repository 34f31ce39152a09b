#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "components/terrain/layered_seabed.h"

namespace ensonify::source {

/// Sample of a layered seabed at places all over its rectangle.
struct SeabedPlaces {
  std::size_t count = 0;
  std::vector<std::uint8_t> seabed_class;
  std::map<std::string, std::vector<float>> mask, rough;  // 0 to 1, by layer
};

/// At most 4096 places: 8 x 8 blocks of 8 x 8 nodes, nodes as far apart as the finest scale of the seabed's masks.
/// Relief finer than that is left out, as masks leave it out. `fields` are the seabed's; of its masks, those of
/// `layers` are looked up. A scenario's places and what is there are the same whoever asks.
SeabedPlaces places_of(const LayeredSeabed& seabed, double post_spacing_m, const LayeredFields& fields,
                       const std::set<std::string>& layers);

}  // namespace ensonify::source
