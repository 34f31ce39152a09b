#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "kernels/seabed/relief/guide.h"
#include "kernels/seabed/relief/marks.h"
#include "kernels/seabed/relief/seabed.h"
#include "scenarios/world/seabed.h"

namespace ensonify::source {

/// Heights of a guide's file. Throws std::invalid_argument with the cause when they cannot be had.
using GuideReader = std::function<relief::Raster(const layers::Guide&)>;

/// The fields of kernels/seabed/relief that a scenario's layers ask for.
struct LayeredFields {
  relief::Seabed seabed;                       // all layers, joined
  std::map<std::string, relief::Field> masks;  // by layer, of those that have one
  std::map<std::string, relief::Field> rough;  // the masks of rough places, by spectral layer
};

/// Throws ConfigError, naming the layer, for what only shows when it is made: a guide that cannot be read or has holes,
/// numbers that do not go together.
LayeredFields fields_of(const LayeredSeabed& seabed, double post_spacing_m, const GuideReader& read_guide);

/// A furrow, and the layer of trawl scars or anchor drags that has it.
struct NamedMark {
  std::string layer;
  relief::Mark mark;
};

/// All furrows that intersect the seabed's rectangle, layer by layer: where they are, whether or not a mask, what
/// covers them or their age hides them.
std::vector<NamedMark> marks_of(const LayeredSeabed& seabed, double post_spacing_m);

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
