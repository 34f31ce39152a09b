#pragma once

#include "components/formats/window.h"

namespace ensonify::formats {

enum class Format { unknown, all, kmall, xtf };

/// Which format a file has, by its content: whose frames stand first within its first megabyte.
Format recognise(Window& file);

}  // namespace ensonify::formats
