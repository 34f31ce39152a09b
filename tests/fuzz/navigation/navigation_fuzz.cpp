// Arbitrary bytes as a navigation stream of each format, whole and in pieces: what is read is possible, and pieces make
// no difference.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "components/formats/em_attitude/em_attitude.h"
#include "components/formats/km_binary/km_binary.h"
#include "components/formats/nmea/navigation.h"
#include "components/formats/tss1/tss1.h"

using namespace ensonify;
using namespace ensonify::formats;

namespace {

void must(bool holds) {
  if (!holds) std::abort();
}

void must_be_possible(const Motion& motion) {
  constexpr double kHalfTurn = std::numbers::pi + 1e-9;
  must(!motion.time_s || (*motion.time_s >= 0.0 && *motion.time_s < 86401.0));
  must(!motion.roll_rad || std::abs(*motion.roll_rad) <= kHalfTurn);
  must(!motion.pitch_rad || std::abs(*motion.pitch_rad) <= 0.5 * kHalfTurn);
  must(!motion.true_heading_rad || (*motion.true_heading_rad >= 0.0 && *motion.true_heading_rad <= 2.0 * kHalfTurn));
  must(!motion.heave_m || std::abs(*motion.heave_m) <= 100.0);
}

void must_be_possible(const nmea::Fix& fix) {
  must(fix.quality == 0 || (std::abs(fix.latitude_deg) <= 90.0 && std::abs(fix.longitude_deg) <= 180.0));
  must(fix.time_s >= 0.0 && fix.time_s < 86401.0);
}

template <class Other>
void must_be_possible(const Other&) {}

template <class Stream>
std::vector<Bytes> frames_of(ByteView bytes, std::size_t piece) {
  Stream stream;
  std::vector<Bytes> frames;
  const std::size_t sent = bytes.size();
  std::size_t used = 0;
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(piece, bytes.size()))) {
    stream.take(bytes.first(std::min(piece, bytes.size())), [&](ByteView frame) {
      used += frame.size();
      frames.emplace_back(frame.begin(), frame.end());
    });
  }
  must(used + stream.skipped_bytes() <= sent);
  return frames;
}

template <class Stream, class Read>
void read_stream(ByteView bytes, const Read& read) {
  const auto frames = frames_of<Stream>(bytes, bytes.size());
  must(frames == frames_of<Stream>(bytes, 3));
  for (const Bytes& frame : frames) read(frame);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ByteView bytes = std::as_bytes(std::span(data, size));
  read_stream<tss1::Stream>(bytes, [](ByteView frame) {
    if (const auto sample = tss1::read(frame)) must_be_possible(sample->motion);
  });
  read_stream<em_attitude::Stream>(bytes, [](ByteView frame) {
    const auto sample = em_attitude::read(frame);
    must(sample.has_value());
    must_be_possible(sample->motion);
  });
  read_stream<km_binary::Stream>(bytes, [](ByteView frame) {
    if (const auto sample = km_binary::read(frame)) must_be_possible(km_binary::motion_of(*sample));
  });
  nmea::for_each_line({reinterpret_cast<const char*>(data), size}, [](std::string_view line) {
    std::visit([](const auto& sentence) { must_be_possible(sentence); }, nmea::read_navigation(line));
  });
  return 0;
}
