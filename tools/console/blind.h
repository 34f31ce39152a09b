#pragma once

#include <memory>

#include "tools/console/source.h"

namespace ensonify::console {

/// A source for those from whom the truth is withheld (--blind): topics of types that are an instrument's alone
/// (messages/instrument.h), and no folder, so no logs. All that a desk makes follows from what its source gives it.
std::unique_ptr<Source> blind(std::unique_ptr<Source> source);

}  // namespace ensonify::console
