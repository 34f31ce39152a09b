#include "components/tracks/track.h"

#include <cstring>
#include <fstream>
#include <variant>

#include "components/formats/nmea/navigation.h"
#include "components/formats/recognise.h"
#include "components/record/format.h"
#include "components/tracks/readers.h"

namespace ensonify::tracks {
namespace {

constexpr int kLinesExamined = 1000;

bool is_record(const std::string& file) {
  formats::Window window(file);
  const formats::ByteView begin = window.at(0, record::kMcapMagic.size());
  return begin.size() == record::kMcapMagic.size() &&
         std::memcmp(begin.data(), record::kMcapMagic.data(), begin.size()) == 0;
}

/// A sentence with a checksum, right or wrong, within the first thousand lines.
bool is_nmea_log(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  for (int i = 0; i < kLinesExamined && std::getline(in, line); ++i) {
    const std::size_t begin = line.find('$');
    if (begin == std::string::npos) continue;
    const auto said = nmea::read_navigation(std::string_view(line).substr(begin));
    if (!std::holds_alternative<nmea::Malformed>(said)) return true;
  }
  return false;
}

/// A text whose first line of content has several columns.
bool is_table(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line)) {
    if (line.find('\0') != std::string::npos) return false;
    if (line.find_first_not_of(" \r\t") == std::string::npos || line.front() == '#') continue;
    return line.find_first_of(",;\t") != std::string::npos;
  }
  return false;
}

}  // namespace

Track read_track(const std::string& file, const std::string& topic) {
  using formats::Format;
  formats::Window window(file);
  if (window.size() == 0) throw UserError(file + ": is empty; allowed: a file with a track");
  if (is_record(file)) return read_record(file, topic);
  const Format format = formats::recognise(window);
  if (format == Format::all) return read_all(file);
  if (format == Format::kmall) return read_kmall(file);
  if (format == Format::xtf) return read_xtf(file);
  if (is_nmea_log(file)) return read_nmea_log(file);
  if (is_table(file)) return read_csv(file);
  throw UserError(file +
                  ": is of no known format; allowed: CSV with a line of column names, a log of NMEA lines, an "
                  "MCAP record, .all, .kmall or XTF");
}

}  // namespace ensonify::tracks
