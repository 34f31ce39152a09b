#pragma once

#include <cstddef>
#include <cstdint>

#include "components/formats/bytes.h"

namespace ensonify::formats {

/// What stands at the front of bytes that came in pieces.
struct Front {
  enum class Is { frame, garbage, incomplete } is = Is::incomplete;
  std::size_t bytes = 0;  // of the frame or of the garbage; at least 1
};

/// Frames out of a stream whose bytes come in pieces of any length, after garbage too. A Format has `kMostBytes`, of
/// its longest frame, and `Front front(ByteView, bool behind_a_frame) const`, which needs no more than twice
/// `kMostBytes` to tell what stands there. No more than that is kept.
template <class Format>
class Frames {
 public:
  template <class Each>
  void take(ByteView piece, const Each& each) {
    kept_.insert(kept_.end(), piece.begin(), piece.end());
    ByteView left(kept_);
    while (!left.empty()) {
      Front found = format_.front(left, behind_a_frame_);
      if (found.is == Front::Is::incomplete) {
        if (left.size() < 2 * Format::kMostBytes) break;
        found = {Front::Is::garbage, 1};
      }
      behind_a_frame_ = found.is == Front::Is::frame;
      if (behind_a_frame_) each(left.first(found.bytes));
      if (!behind_a_frame_) skipped_bytes_ += found.bytes;
      left = left.subspan(found.bytes);
    }
    kept_.erase(kept_.begin(), kept_.end() - static_cast<std::ptrdiff_t>(left.size()));
  }

  /// Bytes of no frame until now.
  std::uint64_t skipped_bytes() const { return skipped_bytes_; }

 private:
  Format format_;
  Bytes kept_;
  bool behind_a_frame_ = false;
  std::uint64_t skipped_bytes_ = 0;
};

/// How many bytes stand before the first one that is `wanted`, from the second on.
inline std::size_t bytes_before(ByteView bytes, std::uint8_t wanted) {
  std::size_t at = 1;
  while (at < bytes.size() && std::to_integer<std::uint8_t>(bytes[at]) != wanted) ++at;
  return at;
}

}  // namespace ensonify::formats
