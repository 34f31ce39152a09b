#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace ensonify::record {

/// A folder of a test, gone at its end.
struct TestFolder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("ensonify_record_test_" + std::to_string(::getpid()));
  TestFolder() { std::filesystem::create_directories(path); }
  ~TestFolder() { std::filesystem::remove_all(path); }
  std::filesystem::path operator/(const std::string& name) const { return path / name; }
};

inline std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
inline void write_file(const std::filesystem::path& file, const std::string& bytes) {
  std::filesystem::remove(
      file);  // a truncated file would be flushed to disk when it is closed, thousands of times here
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace ensonify::record
