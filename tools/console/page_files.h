#pragma once

#include <vector>

#include "tools/console/server/server.h"

namespace ensonify::console {

/// The files of the page, as clients/web made them at build.
std::vector<PageFile> page_files();

}  // namespace ensonify::console
