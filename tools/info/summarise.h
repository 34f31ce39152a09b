#pragma once

#include "components/formats/window.h"
#include "tools/info/summary.h"

namespace ensonify::info {

/// Reads a whole file. Throws UserError where its format is none of those that are known here.
Summary summarise(formats::Window& file);

Summary summarise_all(formats::Window& file);
Summary summarise_kmall(formats::Window& file);
Summary summarise_xtf(formats::Window& file);

/// Notes positions that other programs draw all the same.
void note_unusable(Summary& summary);

}  // namespace ensonify::info
