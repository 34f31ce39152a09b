#pragma once

#include "components/formats/bytes.h"

namespace ensonify::formats {

/// A body of which the layout is not known here, or not the known one: kept as it stands, so that it is written again
/// as it was.
struct Raw {
  Bytes bytes;
  bool operator==(const Raw&) const = default;
};

}  // namespace ensonify::formats
