#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ensonify {

struct Seabed;

namespace source {

struct LayeredFields;

/// A layer that roughens one part of a class and not the other, while the class has one law for both.
struct UnevenClass {
  std::string layer;
  std::uint8_t seabed_class = 0;
  double share = 0.0;  // of the class's places, where the layer holds
  /// By how much the lesser part's echoes at right angles are off the others', the worse of 100 and 300 kHz.
  double off_db = 0.0;
};

/// That in words for the scenario's author, with what to do about it.
std::string text_of(const UnevenClass& uneven);

/// Share of the sediments' relief in the facets of a seabed's mesh.
struct MeshedRelief {
  /// Mean square slope by class, of what the sediment's law counts too: 0 or beyond the end where that is nothing.
  std::vector<double> mean_square_slope;
  /// All layers of which a tenth to nine tenths of a class's places have their relief, off by 0.1 dB or more.
  std::vector<UnevenClass> uneven;
};

/// The same of a layered seabed and its fields, for sediments by TR 9407 whose slope the file does not say itself.
///
/// Counted are spectral layers that give the class, and those without a class that add; their slopes from post to post
/// (relief::facet_mean_square_slope) times the amplitude that mask and `rough` leave, but no more in all than the
/// sediment's own spectrum has there. By class, not by place: half of the class's places have more, half less. With the
/// mean square, which few rough places make, the others' echoes would come out too strong by several dB. Where masks
/// hold is looked up on the seabed itself, at up to 4096 places all over its rectangle, at the finest scale of its
/// masks; without such a mask nothing is sampled. The rms slope is rounded to 1e-4 degrees, so that a file can say the
/// same number; at most 35.
///
/// Not counted: shapes, ripples, bodies, marks, which no law of a sediment knows of; detail restored below a guide,
/// whose strength the guide says.
MeshedRelief meshed_relief(const Seabed& seabed, const LayeredFields& fields);

}  // namespace source
}  // namespace ensonify
