#include "components/formats/recognise.h"

#include <algorithm>

#include "components/formats/all/frame.h"
#include "components/formats/frame_walk.h"
#include "components/formats/kmall/frame.h"
#include "components/formats/xtf/reader.h"

namespace ensonify::formats {

namespace {

constexpr std::uint64_t kSearched = 1U << 20U;

/// Where the first whole frame begins, `from` or later; the size of the file: not within the first megabyte.
template <class Frames>
std::uint64_t first_frame(Window& file, std::uint64_t from = 0) {
  const std::uint64_t end = std::min(file.size(), kSearched);
  Search search;
  const std::uint64_t start = search.next_whole<Frames>(file, from, end);
  return start < end ? start : file.size();
}

bool is_xtf(Window& file) {
  std::uint64_t header_bytes = 0;
  if (!xtf::read_file_header(file, header_bytes)) return false;
  return header_bytes == file.size() || first_frame<xtf::FrameFormat>(file, header_bytes) < file.size();
}

}  // namespace

Format recognise(Window& file) {
  // A .all file whose first length ends in 123 could pass for XTF, so whole frames at the very begin come first.
  if (all::FrameFormat::check(file, 0).bytes > 0) return Format::all;
  if (kmall::FrameFormat::check(file, 0).bytes > 0) return Format::kmall;
  if (is_xtf(file)) return Format::xtf;
  const std::uint64_t all = first_frame<all::FrameFormat>(file);
  const std::uint64_t kmall = first_frame<kmall::FrameFormat>(file);
  if (all < kmall) return Format::all;
  return kmall < file.size() ? Format::kmall : Format::unknown;
}

}  // namespace ensonify::formats
