#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "components/runtime/config/scenario_seabed.h"
#include "components/runtime/terrain/layered_seabed.h"

namespace ensonify::source {

/// The scenario's sediments as they scatter on the seabed's mesh, by class: of a layered seabed those by TR 9407 become
/// those of its facets (on_facets), where the file does not say itself how steep these are.
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
/// whose strength the guide says. Without `read_guide` nobody knows what masks hold on a guide's shape, or on classes
/// that it may decide: layers with such masks are not counted, and of others all places count as the class's.
std::map<std::uint8_t, seabed::Scatterer> sediments_on_mesh(const Seabed& seabed, const GuideReader& read_guide = {});

/// A layer that roughens one part of a class and not the other, while the class has one law for both.
struct UnevenClass {
  std::string layer;
  std::uint8_t seabed_class = 0;
  /// Of the class's places, where the layer holds; nothing: nobody knows, for want of guides.
  std::optional<double> share;
  /// By how much the lesser part's echoes at right angles are off the others', the worse of 100 and 300 kHz.
  double off_db = 0.0;
};

/// All layers of which a tenth to nine tenths of a class's places have their relief, off by 0.1 dB or more; and those
/// that are not counted for want of `read_guide`, with what they are off by where they hold.
std::vector<UnevenClass> uneven_classes(const Seabed& seabed, const GuideReader& read_guide = {});

/// That in words for the scenario's author, with what to do about it.
std::string text_of(const UnevenClass& uneven);

}  // namespace ensonify::source
