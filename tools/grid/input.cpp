#include "tools/grid/input.h"

#include <filesystem>

#include "components/errors/exit_error.h"
#include "components/formats/recognise.h"

namespace ensonify::grid_tool {

std::unique_ptr<SoundingFile> open_file(const std::string& file, const ReadOptions& options) {
  if (std::filesystem::is_regular_file(file)) {
    formats::Window window(file);
    switch (formats::recognise(window)) {
      case formats::Format::all: return open_all(file, options);
      case formats::Format::kmall: return open_kmall(file, options);
      case formats::Format::xtf:
        throw UserError(file +
                        ": is an XTF file; allowed: records with soundings/1, runs' folders with one, .all and .kmall "
                        "files");
      case formats::Format::unknown: break;
    }
  }
  return open_record(file, options);
}

}  // namespace ensonify::grid_tool
