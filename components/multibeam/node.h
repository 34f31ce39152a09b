#pragma once

#include "components/multibeam/head.h"

namespace ensonify {

using MultibeamNode = HeadNode<Multibeam>;

}  // namespace ensonify
