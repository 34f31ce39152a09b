#include "components/formats/nmea/sentence.h"

#include <charconv>

namespace ensonify::nmea {

std::variant<Fields, BadChecksum, Malformed> fields_of(std::string_view line) {
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n' || line.back() == ' ')) line.remove_suffix(1);
  if (!line.starts_with('$')) return Malformed{};
  line.remove_prefix(1);
  const std::size_t star = line.rfind('*');
  if (star == std::string_view::npos || line.size() != star + 3) return BadChecksum{};
  unsigned reported = 0, sum = 0;
  const auto [end, error] = std::from_chars(line.data() + star + 1, line.data() + line.size(), reported, 16);
  for (const char c : line.substr(0, star)) sum ^= static_cast<unsigned char>(c);
  if (error != std::errc{} || end != line.data() + line.size() || reported != sum) return BadChecksum{};
  Fields fields;
  for (std::string_view body = line.substr(0, star);;) {
    const std::size_t comma = body.find(',');
    fields.push_back(body.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    body.remove_prefix(comma + 1);
  }
}

bool is_kind(const Fields& fields, std::string_view kind) {
  const std::string_view address = fields[0];
  return address.size() == 5 && !address.starts_with('P') && address.ends_with(kind);
}

std::optional<double> number(std::string_view text, double least, double most) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool good = error == std::errc{} && end == text.data() + text.size() && value >= least && value <= most;
  return good ? std::optional(value) : std::nullopt;
}

}  // namespace ensonify::nmea
