#include "components/formats/tss1/tss1.h"

#include <charconv>
#include <cstdlib>
#include <numbers>
#include <string_view>

namespace ensonify::formats::tss1 {
namespace {

constexpr double kHundredthDegree = std::numbers::pi / 18000.0;
constexpr int kQuarterTurn = 9000;  // the most that a line gives
constexpr double kHorizontalStep_mps2 = 0.0383, kVerticalStep_mps2 = 0.000625;

std::string_view text_of(ByteView bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

template <class Number>
bool parse(std::string_view text, int base, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  return error == std::errc{} && end == text.data() + text.size();
}

/// A space or a minus, and four digits.
std::optional<int> signed_number(std::string_view text) {
  unsigned size = 0;
  if ((text[0] != ' ' && text[0] != '-') || !parse(text.substr(1), 10, size)) return std::nullopt;
  return text[0] == '-' ? -static_cast<int>(size) : static_cast<int>(size);
}

}  // namespace

Front Format::front(ByteView bytes, bool) const {
  const std::string_view text = text_of(bytes);
  if (text[0] != ':') return {Front::Is::garbage, bytes_before(bytes, ':')};
  const std::size_t again = text.find_first_of(":\n", 1);
  if (again == std::string_view::npos && text.size() < kMostBytes) return {};
  if (again == kMostBytes - 1 && text[again] == '\n' && text[again - 1] == '\r') return {Front::Is::frame, kMostBytes};
  return {Front::Is::garbage, bytes_before(bytes, ':')};
}

// :XXAAAA MHHHHQMRRRR MPPPP
std::optional<Sample> read(ByteView frame) {
  const std::string_view text = text_of(frame);
  if (text.size() != Format::kMostBytes || text[7] != ' ' || text[19] != ' ') return std::nullopt;
  std::uint8_t horizontal = 0;
  std::uint16_t vertical = 0;
  const auto heave_cm = signed_number(text.substr(8, 5)), roll = signed_number(text.substr(14, 5)),
             pitch = signed_number(text.substr(20, 5));
  constexpr std::string_view kStatuses = "UGHFughf";
  if (!parse(text.substr(1, 2), 16, horizontal) || !parse(text.substr(3, 4), 16, vertical) || !heave_cm || !roll ||
      !pitch || std::abs(*roll) > kQuarterTurn || std::abs(*pitch) > kQuarterTurn ||
      kStatuses.find(text[13]) == std::string_view::npos) {
    return std::nullopt;
  }
  Sample sample;
  sample.motion.roll_rad = *roll * kHundredthDegree;
  sample.motion.pitch_rad = *pitch * kHundredthDegree;
  sample.motion.heave_m = 0.01 * *heave_cm;
  sample.motion.usable = text[13] < 'a';
  sample.horizontal_acceleration_mps2 = horizontal * kHorizontalStep_mps2;
  sample.vertical_acceleration_mps2 = static_cast<std::int16_t>(vertical) * kVerticalStep_mps2;
  sample.status = text[13];
  return sample;
}

}  // namespace ensonify::formats::tss1
