#include "components/nav_out/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "components/config/config_reader.h"
#include "components/errors/exit_error.h"
#include "components/transport/address.h"
#include "components/transport/channel.h"
#include "components/transport/serial_line.h"

namespace ensonify {
namespace {

constexpr double kHighest_hz = 1000.0, kLowest_hz = 0.01;
constexpr double kBitsAByte = 10.0;  // with a start bit and a stop bit

SentenceRates rates_of(std::initializer_list<std::pair<std::string_view, double>> rates) {
  SentenceRates found;
  for (const auto& [name, hz] : rates) {
    for (const nav_out::KindInfo& kind : nav_out::kSentences) {
      if (name == kind.name) found.emplace_back(kind, hz);
    }
  }
  return found;
}

/// The highest rate that a line carries, rounded down to a number that files have.
double highest_hz(double line_bytes_per_s, std::size_t most_bytes) {
  const double hz = line_bytes_per_s / static_cast<double>(most_bytes);
  return hz >= 1.0 ? std::floor(hz) : std::floor(100.0 * hz) / 100.0;
}

std::string baud_for(double bytes_per_s) {
  for (const int baud : {4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800, 921600}) {
    if (baud / kBitsAByte >= bytes_per_s) return fmt::format("{} baud", baud);
  }
  return "another way than a serial line";
}

/// Throws nothing: adds what the parser of an address says.
template <class Parse>
void check_address(const ConfigReader& from, const char* key, const Parse& parse) {
  try {
    parse();
  } catch (const UserError& error) {
    from.problem(key, error.what());
  }
}

}  // namespace

const SentenceRates Output::kUsual = rates_of({{"ZDA", 1}, {"GGA", 1}, {"VTG", 1}, {"HDT", 5}, {"PASHR", 5}});

void SentenceRates::read(ConfigReader& from, const char* key) {
  if (from.node(key) == nullptr) return;
  clear();
  ConfigReader map = from.section(key);
  std::string names;
  for (const nav_out::KindInfo& kind : nav_out::kSentences) {
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
    if (!map.has(kind.name)) continue;
    double hz = 1.0;
    map.optional(kind.name, hz, kLowest_hz, kHighest_hz);
    emplace_back(kind, hz);
  }
  if (empty()) from.problem(key, "names no sentence; allowed: " + names);
}

bool SentenceRates::same_as(const SentenceRates& other) const {
  return std::ranges::equal(*this, other, [](const auto& one, const auto& two) {
    return one.first.name == two.first.name && one.second == two.second;
  });
}

ConfigNode SentenceRates::in_file() const {
  ConfigNode map = ConfigNode::map();
  for (const auto& [kind, hz] : *this) {
    ConfigNode number;
    number.kind = ConfigNode::Kind::kScalar;
    number.scalar = fmt::format("{:g}", hz);
    map.set(kind.name, number);
  }
  return map;
}

std::string SentenceRates::schema() {
  std::string properties;
  for (const nav_out::KindInfo& kind : nav_out::kSentences) {
    properties +=
        fmt::format(R"({}"{}": {{"type": "number", "minimum": {}, "maximum": {}, "description": "rate of {}, Hz"}})",
                    properties.empty() ? "" : ", ", kind.name, kLowest_hz, kHighest_hz, kind.name);
  }
  return fmt::format(R"({{"type": "object", "minProperties": 1, "properties": {{{}}}, "additionalProperties": false}})",
                     properties);
}

SentenceRates Output::lines() const {
  switch (format) {
    case Format::kTss1: return {{nav_out::kTss1, rate_hz}};
    case Format::kEmAttitude: return {{nav_out::kEmAttitude, rate_hz}};
    case Format::kKmBinary: return {{nav_out::kKmBinary, rate_hz}};
    default: return sentences;
  }
}

double Output::bytes_per_s() const {
  double sum = 0.0;
  for (const auto& [kind, hz] : lines()) sum += hz * static_cast<double>(kind.most_bytes);
  return sum;
}

void Output::check(const ConfigReader& from) const {
  const auto letter = [](char c) { return c >= 'A' && c <= 'Z'; };
  if (!talker.empty() && (talker.size() != 2 || !std::all_of(talker.begin(), talker.end(), letter)))
    from.problem("talker",
                 fmt::format("\"{}\" is no talker; allowed: two capital letters such as GP, IN or HE", talker));
  const Output usual;  // what is printed says that too
  if (format != Format::kNmea && from.has("sentences") && !sentences.same_as(usual.sentences))
    from.problem("sentences", "are those of format nmea; of this format rate_hz says how many frames leave");
  if (format == Format::kNmea && from.has("rate_hz") && rate_hz != usual.rate_hz)
    from.problem("rate_hz", "is that of other formats; of nmea each of the sentences has its own");
  if (const auto* udp = std::get_if<Udp>(&way)) {
    check_address(from, "to", [&] { receiver_address(udp->to, udp->port); });
    check_address(from, "interface", [&] { interface_address(udp->interface); });
  }
  if (const auto* server = std::get_if<TcpServer>(&way)) {
    check_address(from, "at", [&] { host_address(server->at); });
    check_address(from, "receivers", [&] { Senders{server->receivers}; });
  }
  if (const auto* client = std::get_if<TcpClient>(&way))
    check_address(from, "of", [&] { receiver_address(client->address, client->port); });
  const auto* serial = std::get_if<Serial>(&way);
  if (serial == nullptr) return;
  check_address(from, "baud", [&] { serial::check_baud(serial->baud); });
  const double line_bytes_per_s = serial->baud / kBitsAByte;
  if (bytes_per_s() <= line_bytes_per_s) return;
  const bool one = lines().size() == 1;
  const std::string what = one ? fmt::format("{} at {:g} Hz", lines()[0].first.name, lines()[0].second) : "what leaves";
  const std::string less =
      one ? fmt::format("{:g} Hz at most", highest_hz(line_bytes_per_s, lines()[0].first.most_bytes))
          : "fewer sentences";
  from.problem(format == Format::kNmea ? "sentences" : "rate_hz",
               fmt::format("{} needs {:.0f} bytes/s, and a line of {} baud carries {:.0f}; allowed: {}, or {}", what,
                           bytes_per_s(), serial->baud, line_bytes_per_s, less, baud_for(bytes_per_s())));
}

}  // namespace ensonify
