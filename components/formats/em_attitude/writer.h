#pragma once

#include "components/formats/em_attitude/em_attitude.h"

namespace ensonify::formats::em_attitude {

/// A frame of ten bytes. What is not given is zero, for the format has no blanks. Values beyond the format's (180 and
/// 90 degrees, 10 m) are those limits.
Bytes write(const Sample& sample);

}  // namespace ensonify::formats::em_attitude
