#pragma once

#include "components/sidescan/head.h"

namespace ensonify {

using SidescanNode = HeadNode<Sidescan>;

}  // namespace ensonify
