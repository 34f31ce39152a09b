#pragma once

#include <vector>

#include "kernels/seabed/relief/window.h"

namespace ensonify::relief {

/// One number everywhere.
Field constant(float value);

/// Product, largest and sum of fields, node by node; of none: 1, 0 and 0.
Field product(std::vector<Field> fields);
Field largest(std::vector<Field> fields);
Field sum(std::vector<Field> fields);

/// low where `mask` is 0, high where it is 1, in proportion between.
Field blend(Field mask, float low, float high);

}  // namespace ensonify::relief
