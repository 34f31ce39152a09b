#pragma once

#include "components/forward_looking/head.h"

namespace ensonify {

using ForwardLookingNode = HeadNode<ForwardLooking>;

}  // namespace ensonify
