#include "components/formats/testing/sample.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace ensonify::formats::sample {

std::optional<std::filesystem::path> genuine(const char* name) {
  const char* shared = std::getenv("ENSONIFY_SHARED");
  if (shared == nullptr) return std::nullopt;
  const auto path = std::filesystem::path(shared) / "data" / name;
  if (!std::filesystem::exists(path)) return std::nullopt;
  return path;
}

Bytes bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<char> text{std::istreambuf_iterator<char>(in), {}};
  const ByteView view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

TemporaryFile::TemporaryFile(ByteView bytes) {
  std::string name = (std::filesystem::temp_directory_path() / "formats_XXXXXX").string();
  const int descriptor = ::mkstemp(name.data());
  if (descriptor >= 0) ::close(descriptor);
  path_ = name;
  std::ofstream(path_, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

TemporaryFile::~TemporaryFile() { std::filesystem::remove(path_); }

}  // namespace ensonify::formats::sample
