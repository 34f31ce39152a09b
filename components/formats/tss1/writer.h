#pragma once

#include <string>

#include "components/formats/tss1/tss1.h"

namespace ensonify::formats::tss1 {

/// A line of 27 characters with CR LF. What is not given is zero, for the format has no blanks. Values beyond the
/// format's (90 degrees, 99.99 m, 9.8 and +-20.5 m/s2) are those limits.
std::string write(const Sample& sample);

}  // namespace ensonify::formats::tss1
