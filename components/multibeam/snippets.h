#pragma once

#include <vector>

#include "components/multibeam/arrays.h"
#include "components/multibeam/config.h"
#include "components/multibeam/soundings.h"
#include "components/multibeam/steering.h"
#include "messages/soundings.h"

namespace ensonify {

/// The amplitudes around each valid sounding as they were received, uncorrected. The settings are not filled.
msg::Snippets snippets_of(std::span<const SectorBeams> received, const Steering& steering, std::span<const Echo> echoes,
                          const msg::Soundings& soundings);

/// The same after the corrections that the head is set to: spreading 40 log10 R and the operator's absorption, the area
/// of a level seabed, and the angular law of MultibeamConfig::image about the nearest sounding of the ping
/// (kernels/acoustics/detect/seabed_image.h). `received` is of any sector, `lines` at the head's frequency. Nothing but
/// what the instrument knows goes in. The settings are not filled.
msg::SeabedImage seabed_image_of(const MultibeamConfig& config, const HeadSettings& settings, const Steering& steering,
                                 const SectorBeams& received, const AreaLengths& lines, const msg::Snippets& snippets,
                                 const msg::Soundings& soundings);

}  // namespace ensonify
