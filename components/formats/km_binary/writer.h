#pragma once

#include "components/formats/km_binary/km_binary.h"

namespace ensonify::formats::km_binary {

/// A frame of 132 bytes, or of 120 without delayed heave: as many as the sample states.
Bytes write(const Sample& sample);

}  // namespace ensonify::formats::km_binary
