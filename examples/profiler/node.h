#pragma once

#include "examples/profiler/head.h"

namespace ensonify {

using ProfilerNode = HeadNode<Profiler>;

}  // namespace ensonify
