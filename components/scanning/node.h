#pragma once

#include "components/scanning/head.h"

namespace ensonify {

using ScanningNode = HeadNode<Scanning>;

}  // namespace ensonify
