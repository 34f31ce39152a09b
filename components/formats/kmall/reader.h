#pragma once

#include <optional>

#include "components/formats/kmall/datagram.h"
#include "components/formats/kmall/frame.h"

namespace ensonify::formats::kmall {

/// Reads the datagrams of a .kmall or .kmwcd file in their order, one in memory at a time. Damaged ones are skipped and
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

}  // namespace ensonify::formats::kmall
