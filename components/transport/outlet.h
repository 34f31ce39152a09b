#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "components/transport/descriptor.h"

namespace ensonify {

/// What is written to: a connection or a line, which may take a part of a piece. The rest of it goes before the next
/// one, so that no receiver gets half a sentence. It does not wait.
class Outlet {
 public:
  enum class Result { taken, busy, gone };

  explicit Outlet(Descriptor to) : to_(std::move(to)) {}
  Outlet() = default;

  bool is_open() const { return to_.is_open(); }
  /// Busy: nothing of the piece was taken. Gone: the other end is not there, and this is closed. What the other end
  /// says is passed over.
  Result write(std::span<const std::byte> piece);

 private:
  /// How much of it was taken; -1: the other end is gone.
  std::ptrdiff_t write_some(std::span<const std::byte> bytes) const;

  Descriptor to_;
  std::vector<std::byte> rest_;
};

}  // namespace ensonify
