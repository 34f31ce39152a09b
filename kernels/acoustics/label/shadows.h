#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/label/image.h"
#include "kernels/acoustics/label/strips.h"

namespace ensonify::label {

/// Shadows: where bodies keep the sound from the seabed.
struct Shadows {
  std::vector<Run> runs;               // by row and sample
  std::vector<std::uint8_t> depth_db;  // of each sample of the runs, one after the other; of the seabed's own 0
};

/// What makes a shadow.
struct ShadowRule {
  double least_db = 6.0;  // without bodies over with them
  double most_db = 60.0;  // is stored
  double pulse_s = 1e-4;  // integral of the pulse's power, its peak 1: from what arrives in a second to a mean square
};

/// G0 is what the seabed sends a sample through the main lobe without any body, G what it sends with all of them, both
/// without a pulse. A sample is in a shadow if G0 is `least_db` over G and over the background's mean square, and it is
/// in nobody's mask; it belongs to the body that, as the first to be hit, blocks most of what is missing, and of those
/// alike to the lower number.
///
/// A sample between the first and the last that the seabed answers, where it covers no more than a quarter of the lobe
/// even without bodies, is in the seabed's own shadow, if the last one that it answered before was over the background.
///
/// background_upa2: row by sample. own: masks, by find_masks.
Shadows find_shadows(std::span<const Strip> strips, std::span<const std::vector<Point>> points,
                     const Fineness& fineness, std::span<const Row> rows, const MainLobe& lobe,
                     const echo::Sampling& sampling, std::span<const float> background_upa2, std::span<const Run> own,
                     const ShadowRule& rule);

}  // namespace ensonify::label
