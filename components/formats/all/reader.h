#pragma once

#include <optional>

#include "components/formats/all/datagram.h"
#include "components/formats/all/frame.h"

namespace ensonify::formats::all {

/// Reads the datagrams of a .all or .wcd file in their order, one in memory at a time. Damaged ones are skipped and
/// noted in faults(). A datagram whose frame is whole and whose body is not of its layout is given as Raw, and noted.
class Reader {
 public:
  /// `file` outlives the reader.
  explicit Reader(Window& file) : walk_(file) {}

  std::optional<Datagram> next();
  const Faults& faults() const { return walk_.faults(); }

 private:
  FrameWalk<FrameFormat> walk_;
};

}  // namespace ensonify::formats::all
