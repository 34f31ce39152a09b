#pragma once

#include "components/echosounder/head.h"

namespace ensonify {

using EchosounderNode = HeadNode<Echosounder>;

}  // namespace ensonify
