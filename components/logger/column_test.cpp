// The water column, in files of its own.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "components/formats/all/frame.h"
#include "components/formats/all/reader.h"
#include "components/formats/kmall/reader.h"
#include "components/logger/testing/survey.h"

using namespace ensonify;
using namespace ensonify::logger::testing;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
namespace all = ensonify::formats::all;
namespace kmall = ensonify::formats::kmall;

namespace {

template <class Datagram, class Reader>
std::vector<Datagram> survey(const char* text, const char* name) {
  const Folder folder;
  logger::testing::survey(bay(), text, folder.path);
  return read<Datagram, Reader>(folder.path / name);
}

/// Every third ping has a water column; counters in files are modulo 65,536, and the survey begins at 65,500.
bool has_column(std::uint16_t counter) { return (counter < 60'000 ? counter + 65'536 : counter) % 3 == 0; }

/// What column_of() gives, as files have it: level less source level, 30 log R + 2 alpha R and 40 dB, in halves.
double expected_half_db(std::size_t beam, std::size_t sample, double bottom_sample) {
  const double range_m = std::max(0.5 * static_cast<double>(sample) * kColumnPeriod_s * kSoundSpeed_mps, 1.0);
  const double bottom_db = std::abs(static_cast<double>(sample) - bottom_sample) < 0.5 ? 60.0 : 0.0;
  const double db = 100.0 + 0.1 * static_cast<double>(beam) + bottom_db - kSourceLevel_db + 30.0 * std::log10(range_m) +
                    2.0 * 0.06 * range_m + 40.0;
  return std::clamp(2.0 * db, -128.0, 127.0);
}

/// True roll of a ping turns its angles from the vertical; of beams across an axis that is not level only the sense is
/// checked here.
void check_beam(std::size_t beam, double angle_deg, const std::vector<std::int8_t>& half_db, double detected) {
  CAPTURE(beam);
  REQUIRE(half_db.size() == kColumnSamples - 1);
  REQUIRE(std::abs(angle_deg - (50.0 - static_cast<double>(beam))) < 11.0);  // 8 degrees of roll, 2 of the mounting
  for (const std::size_t k : {0UL, 100UL, 300UL, 599UL, static_cast<std::size_t>(std::lround(detected))}) {
    if (k >= half_db.size()) continue;
    REQUIRE_THAT(half_db[k], WithinAbs(expected_half_db(beam, k, detected > 0.0 ? detected : -9.0), 0.51));
  }
}

}  // namespace

TEST_CASE("a .wcd has the settings and navigation of the .all, and k of the pings with a water column") {
  const auto file = survey<all::Datagram, all::Reader>("formats: [all, wcd]", "0000_20250601_120000_boat.wcd");
  std::string types;
  std::map<std::uint16_t, std::size_t> beams;
  for (const all::Datagram& datagram : file) {
    types += datagram.type;
    const auto* column = std::get_if<all::WaterColumn>(&datagram.body);
    if (column == nullptr) continue;
    REQUIRE(has_column(datagram.header.counter));
    REQUIRE(column->ping_beams == kBeams);
    REQUIRE(column->tvg_log_factor == 30);
    REQUIRE(column->tvg_offset_db == 40);
    REQUIRE_THAT(column->sampling_hz.value(), WithinAbs(20'000.0, 1e-9));
    REQUIRE(column->datagrams >= 1);
    for (const auto& beam : column->beams) {
      const std::size_t number = beams[datagram.header.counter]++;
      REQUIRE(beam.number == number);
      check_beam(number, beam.angle_deg.value(), beam.amplitude_half_db, beam.detected_sample);
    }
  }
  CHECK(types.starts_with("IRU"));
  CHECK(types.back() == 'i');
  CHECK(types.find_first_of("NXY") == std::string::npos);
  const std::string before = types.substr(0, types.find('k'));
  CHECK(std::count(before.begin(), before.end(), 'P') >= 3);
  CHECK(beams.size() > 15);
  for (const auto& [ping, count] : beams) CHECK(count == kBeams);
}

TEST_CASE("a ping's k are as many as it takes for each to go over a network") {
  const auto file = survey<all::Datagram, all::Reader>("formats: [wcd]", "0000_20250601_120000_boat.wcd");
  // 101 beams of 600 samples are 61,610 bytes: one datagram.
  for (const all::Datagram& datagram : file) {
    if (const auto* column = std::get_if<all::WaterColumn>(&datagram.body)) REQUIRE(column->datagrams == 1);
  }
}

TEST_CASE("a .kmwcd has #CHE and #MWC of each ping, and positions") {
  const auto file = survey<kmall::Datagram, kmall::Reader>("formats: [kmwcd]", "0000_20250601_120000_boat.kmwcd");
  REQUIRE(file.size() > 50);
  CHECK((file[0].type == "#IIP" && file[1].type == "#IOP" && file[2].type == "#SVP"));
  std::size_t columns = 0, positions = 0;
  std::string last;
  for (const kmall::Datagram& datagram : file) {
    REQUIRE(datagram.type != "#MRZ");
    positions += datagram.type == "#SPO" ? 1 : 0;
    if (const auto* column = std::get_if<kmall::WaterColumn>(&datagram.body)) {
      REQUIRE(last == "#CHE");
      REQUIRE(has_column(column->ping.ping));
      REQUIRE(column->beams.size() == kBeams);
      REQUIRE(column->phase == kmall::WaterColumn::kNoPhase);
      for (std::size_t i = 0; i < kBeams; ++i)
        check_beam(i, column->beams[i].angle_deg, column->beams[i].amplitude_half_db,
                   static_cast<double>(column->beams[i].detected_sample_fine));
      ++columns;
    }
    last = datagram.type;
  }
  CHECK(columns > 15);
  CHECK(positions > 40);
}
