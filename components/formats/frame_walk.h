#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "components/formats/fault.h"
#include "components/formats/window.h"

namespace ensonify::formats {

/// Whether a whole frame stands at an offset.
struct FrameCheck {
  std::uint64_t bytes = 0;    // of the frame; 0: there is none
  const char* what = "";      // else what is wrong: "the length",
  std::uint64_t found = 0;    // what stands there,
  std::uint64_t allowed = 0;  // and what should: `allowed`, from there up to `most`, or as `rule` says
  std::uint64_t most = 0;
  const char* rule = "";
  std::uint64_t claimed = 0;   // bytes of the frame by its own word, 0: it has none that can be
  std::uint64_t examined = 0;  // bytes that were read to know it, but for a few

  std::string text() const {
    std::string text = std::string(what) + " is " + std::to_string(found) + ", must be ";
    if (*rule != '\0') return text + rule;
    return text + (most == 0 ? std::to_string(allowed) : std::to_string(allowed) + " to " + std::to_string(most));
  }
};

/// Finds whole frames, at a cost that is at most proportional to the file: a file may be made such that each byte looks
/// like a frame of a megabyte. What would cost more is passed over.
class Search {
 public:
  /// Where the next whole frame stands, `from` or later and before `end`; else `end`.
  template <class Format>
  std::uint64_t next_whole(Window& file, std::uint64_t from, std::uint64_t end) {
    for (std::uint64_t start = from; start < end;) {
      const FrameCheck check = Format::check(file, start);
      if (check.bytes > 0) return start;
      spent_ += kOfACheck + check.examined;
      const std::uint64_t affordable = spent_ < kFree ? 0 : (spent_ - kFree) / kPerByte;
      start = Format::next_start(file, std::max(start + 1, affordable));
    }
    return end;
  }

 private:
  static constexpr std::uint64_t kOfACheck = 64;
  static constexpr std::uint64_t kFree = 64U << 20U;
  static constexpr std::uint64_t kPerByte = 32;

  std::uint64_t spent_ = 0;  // bytes examined
};

/// Goes from frame to frame of a file. Behind a broken one it goes on with the next that is whole. Format has
///   static FrameCheck check(Window&, std::uint64_t offset);
///   static std::uint64_t next_start(Window&, std::uint64_t from);  // where a frame may begin, `from` or later
template <class Format>
class FrameWalk {
 public:
  FrameWalk(Window& file, std::uint64_t offset = 0) : file_(file), offset_(offset) {}

  struct Frame {
    std::uint64_t offset = 0;
    ByteView bytes;  // until the next call
  };

  std::optional<Frame> next() {
    while (offset_ < file_.size()) {
      const FrameCheck check = Format::check(file_, offset_);
      if (check.bytes > 0) {
        const std::uint64_t offset = offset_;
        offset_ += check.bytes;
        return Frame{offset, file_.at(offset, static_cast<std::size_t>(check.bytes))};
      }
      faults_.add(offset_, file_.error().empty() ? check.text() : file_.error());
      const std::uint64_t next = behind_broken(check);
      faults_.add_skipped(next - offset_);
      offset_ = next;
    }
    return std::nullopt;
  }

  Faults& faults() { return faults_; }
  const Faults& faults() const { return faults_; }

 private:
  std::uint64_t behind_broken(const FrameCheck& broken) {
    // A damaged frame whose length is right ends where the next begins.
    if (broken.claimed > 0 && Format::check(file_, offset_ + broken.claimed).bytes > 0) return offset_ + broken.claimed;
    const std::uint64_t start = Format::next_start(file_, offset_ + 1);
    return std::max(offset_ + 1, search_.next_whole<Format>(file_, start, file_.size()));
  }

  Window& file_;
  std::uint64_t offset_ = 0;
  Search search_;
  Faults faults_;
};

}  // namespace ensonify::formats
