#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

/// What all sentences of NMEA 0183 [NMEA0183] have in common.
namespace ensonify::nmea {

struct Other {};        // a good sentence of another kind
struct Empty {};        // one of the wanted kinds without what it is for: its source knows nothing yet
struct BadChecksum {};  // another sum than it gives, or not given
struct Malformed {};    // no sentence, or a field that cannot be

/// The address (IIGGA) and what follows it between commas.
using Fields = std::vector<std::string_view>;

/// One line, with or without its CR LF: a `$`, fields between commas, `*` and the sum of all between as two hexadecimal
/// digits of either case. The fields refer to the line.
std::variant<Fields, BadChecksum, Malformed> fields_of(std::string_view line);

/// Whether an address is that of a kind ("GGA") of any talker; proprietary ones have none.
bool is_kind(const Fields& fields, std::string_view kind);

/// A number from `least` to `most`, alone in its field; a plus before it is allowed, as PASHR has it.
std::optional<double> number(std::string_view text, double least, double most);

/// Calls each(line) for every line of a datagram that is not empty.
template <class Each>
void for_each_line(std::string_view datagram, const Each& each) {
  while (!datagram.empty()) {
    const std::size_t end = datagram.find('\n');
    const std::string_view line = datagram.substr(0, end);
    if (line.find_first_not_of('\r') != std::string_view::npos) each(line);
    if (end == std::string_view::npos) return;
    datagram.remove_prefix(end + 1);
  }
}

}  // namespace ensonify::nmea
