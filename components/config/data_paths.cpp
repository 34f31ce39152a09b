#include "components/config/data_paths.h"

#include <cstdlib>
#include <filesystem>

namespace ensonify {
namespace fs = std::filesystem;

std::string program_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? "" : program.parent_path().string();
}

std::vector<std::string> data_roots() {
  std::vector<std::string> roots;
  std::error_code error;
  if (const char* share = std::getenv("ENSONIFY_SHARE"); share != nullptr && fs::is_directory(share, error)) {
    roots.emplace_back(share);
  }
  // <source>/build/<preset>/bin/ensonify-run, or <prefix>/bin/ensonify-run.
  fs::path folder = program_folder();
  for (int up = 0; up < 4 && !folder.empty(); ++up, folder = folder.parent_path()) {
    if (fs::is_directory(folder / "scenarios", error) && fs::is_regular_file(folder / "CMakePresets.json", error)) {
      roots.push_back(folder.string());
    } else if (fs::is_directory(folder / "share" / "ensonify", error)) {
      roots.push_back((folder / "share" / "ensonify").string());
    }
  }
  return roots;
}

std::string data_roots_text() {
  std::string text;
  for (const std::string& root : data_roots()) text += (text.empty() ? "" : ", ") + root;
  if (!text.empty()) return text;
  const char* share = std::getenv("ENSONIFY_SHARE");
  return std::string("no folder: ENSONIFY_SHARE ") + (share == nullptr ? "is not set" : "names none") + ", and above " +
         program_folder() + " stand neither sources nor share/ensonify";
}

std::string tile_cache_folder() {
  const auto absolute = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value == '/' ? std::string(value) : std::string();
  };
  if (const std::string caches = absolute("XDG_CACHE_HOME"); !caches.empty()) return caches + "/ensonify/tiles";
  if (const std::string home = absolute("HOME"); !home.empty()) return home + "/.cache/ensonify/tiles";
  return "";
}

std::string find_data(const std::string& path, const std::vector<std::string>& folders) {
  std::error_code error;
  if (path.empty()) {
    return "";
  }
  if (fs::path(path).is_absolute()) {
    return fs::exists(path, error) ? path : "";
  }
  std::vector<std::string> places = folders;
  for (auto& root : data_roots()) {
    places.push_back(std::move(root));
  }
  for (const auto& place : places) {
    const fs::path candidate = (place.empty() ? fs::path(".") : fs::path(place)) / path;
    if (fs::exists(candidate, error)) {
      return candidate.lexically_normal().string();
    }
  }
  return "";
}

}  // namespace ensonify
