#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "components/formats/bytes.h"

/// Small made-up files for tests, and where the genuine ones are.
namespace ensonify::formats::sample {

/// 10 March 2026, 12:00:00 UTC.
inline constexpr std::int64_t kBegin_ns = 1'773'144'000'000'000'000;

/// A file and where its datagrams begin.
struct File {
  Bytes bytes;
  std::vector<std::size_t> offsets;
};

/// Every datagram that we write, two pings among them, on a flat seabed 20 m below the transmit transducer.
File all_file();

/// The same as .kmall, water column and its heave in the same file.
File kmall_file();

/// A sidescan of two channels and a multibeam echo sounder, as XTF.
File xtf_file();

/// `name` in the folder of data measured at sea; none where that folder is absent.
std::optional<std::filesystem::path> genuine(const char* name);

Bytes bytes_of(const std::filesystem::path& file);

/// Writes to a file of the folder for temporary files and removes it at the end.
class TemporaryFile {
 public:
  explicit TemporaryFile(ByteView bytes);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace ensonify::formats::sample
