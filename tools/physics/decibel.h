#pragma once

#include <cmath>

namespace ensonify::physics {

/// 10 log10 of a ratio of intensities; -inf of 0.
inline double db(double ratio) { return 10.0 * std::log10(ratio); }

}  // namespace ensonify::physics
