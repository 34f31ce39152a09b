#pragma once

#include <filesystem>
#include <optional>

#include "components/formats/xtf/file_header.h"
#include "components/formats/xtf/frame.h"
#include "components/formats/xtf/packet.h"

namespace ensonify::formats::xtf {

/// Reads the packets of an XTF file in their order, one in memory at a time. Damaged ones are skipped and noted in
/// faults(). A packet whose frame is whole and whose body is not of its layout is given as Raw, and noted.
class Reader {
 public:
  /// `file` outlives the reader.
  explicit Reader(Window& file);

  /// None where the file does not begin with one; packets cannot be read then.
  const std::optional<FileHeader>& header() const { return header_; }
  std::optional<Packet> next();
  const Faults& faults() const { return walk_.faults(); }

 private:
  void prepare(SonarPing& ping, const PacketHeader& header, std::size_t bytes) const;

  std::uint64_t header_bytes_ = 0;  // before header_: reading that fills it in
  std::optional<FileHeader> header_;
  FrameWalk<FrameFormat> walk_;
};

/// The header at the begin of a file, and its bytes.
std::optional<FileHeader> read_file_header(Window& file, std::uint64_t& bytes);

}  // namespace ensonify::formats::xtf
