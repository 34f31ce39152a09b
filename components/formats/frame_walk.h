#pragma once

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
  std::uint64_t claimed = 0;  // bytes of the frame by its own word, 0: it has none that can be

  std::string text() const {
    std::string text = std::string(what) + " is " + std::to_string(found) + ", must be ";
    if (*rule != '\0') return text + rule;
    return text + (most == 0 ? std::to_string(allowed) : std::to_string(allowed) + " to " + std::to_string(most));
  }
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
    std::uint64_t start = Format::next_start(file_, offset_ + 1);
    while (start < file_.size() && Format::check(file_, start).bytes == 0) start = Format::next_start(file_, start + 1);
    return std::max(offset_ + 1, std::min(start, file_.size()));
  }

  Window& file_;
  std::uint64_t offset_ = 0;
  Faults faults_;
};

}  // namespace ensonify::formats
