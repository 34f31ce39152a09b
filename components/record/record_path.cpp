#include "components/record/record_path.h"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "components/errors/exit_error.h"

namespace ensonify::record {

std::string record_path(const std::string& path) {
  namespace fs = std::filesystem;
  if (!fs::is_directory(path)) return path;
  std::vector<std::string> records;
  for (const auto& entry : fs::directory_iterator(path)) {
    if (entry.path().extension() == ".mcap") records.push_back(entry.path().string());
  }
  if (records.size() == 1) return records.front();
  throw UserError(
      fmt::format("{}: holds {} records (.mcap); allowed: a file, or a folder with one", path, records.size()));
}

}  // namespace ensonify::record
