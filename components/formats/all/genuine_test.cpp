// A genuine EM 710 file, read and written again. Where the folder of data is absent, the cases say so and pass.
#include <catch2/catch.hpp>
#include <map>

#include "components/formats/all/reader.h"
#include "components/formats/all/writer.h"
#include "components/formats/testing/sample.h"

using namespace ensonify::formats;
using namespace ensonify::formats::all;
using Catch::Matchers::WithinAbs;

namespace {

std::vector<Datagram> read_genuine() {
  const auto path = sample::genuine("records/em710_g_7041.all");
  if (!path) {
    WARN("skipped: no data/records/em710_g_7041.all in the folder that ENSONIFY_SHARED names");
    return {};
  }
  Window file(*path);
  Reader reader(file);
  std::vector<Datagram> datagrams;
  while (auto datagram = reader.next()) datagrams.push_back(std::move(*datagram));
  CHECK(reader.faults().count() == 0);
  return datagrams;
}

template <class One>
const One& first(const std::vector<Datagram>& datagrams) {
  for (const Datagram& datagram : datagrams) {
    if (const One* one = std::get_if<One>(&datagram.body)) return *one;
  }
  FAIL("there is none");
  throw;
}

}  // namespace

TEST_CASE("a genuine .all file read and written again is the same bytes") {
  const std::vector<Datagram> datagrams = read_genuine();
  if (datagrams.empty()) return;
  Bytes written;
  std::map<char, int> layouts_known;
  for (const Datagram& datagram : datagrams) {
    append(written, datagram);
    CHECK(datagram.rest.empty());
    if (!std::holds_alternative<Raw>(datagram.body)) ++layouts_known[datagram.type];
  }
  CHECK(written == sample::bytes_of(*sample::genuine("records/em710_g_7041.all")));
  CHECK(layouts_known == std::map<char, int>{{'I', 1},
                                             {'R', 3},
                                             {'U', 1},
                                             {'P', 5},
                                             {'A', 4},
                                             {'n', 49},
                                             {'C', 5},
                                             {'G', 1},
                                             {'N', 10},
                                             {'X', 10},
                                             {'Y', 10}});
}

TEST_CASE("a genuine position's degrees are those of its sentence") {
  const std::vector<Datagram> datagrams = read_genuine();
  if (datagrams.empty()) return;
  // INGGA,165050.06,4409.841917,N,03039.098185,E: P repeats the antenna's position where PnM is 0.
  const auto& position = first<Position>(datagrams);
  REQUIRE(position.sentence.substr(0, 45) == "INGGA,165050.06,4409.841917,N,03039.098185,E,");
  CHECK_THAT(position.latitude_deg.value(), WithinAbs(44 + 9.841917 / 60, 1e-7));
  CHECK_THAT(position.longitude_deg.value(), WithinAbs(30 + 39.098185 / 60, 2e-7));
}

TEST_CASE("genuine soundings run from port to starboard below the transducer") {
  const std::vector<Datagram> datagrams = read_genuine();
  if (datagrams.empty()) return;
  const auto& xyz = first<Soundings>(datagrams);
  REQUIRE(xyz.beams.size() == 400);
  CHECK(xyz.beams.front().y_m < -250);
  CHECK(xyz.beams.back().y_m > 250);
  CHECK_THAT(xyz.beams[200].z_m, WithinAbs(123.0, 2.0));
  CHECK_THAT(xyz.sound_speed_mps.value(), WithinAbs(1473.7, 0.01));

  // This receiver is mounted backwards (S2H 180): angles are negative to port, and travel times fit the depth.
  const auto& raw = first<RawRangeAngle>(datagrams);
  REQUIRE(raw.beams.size() == 400);
  REQUIRE(raw.sectors.size() == 3);
  CHECK_THAT(raw.beams.front().angle_deg.value(), WithinAbs(-65.0, 0.5));
  CHECK_THAT(raw.beams[200].travel_time_s * 1474 / 2, WithinAbs(xyz.beams[200].z_m, 2.0));
  for (std::size_t i = 0; i < raw.beams.size(); ++i) {
    REQUIRE(raw.beams[i].quality == xyz.beams[i].quality);
    REQUIRE(raw.beams[i].detection == xyz.beams[i].detection);
    REQUIRE(raw.beams[i].reflectivity_db == xyz.beams[i].reflectivity_db);
  }
}

TEST_CASE("a genuine profile begins at the surface and ends at 12 km") {
  const std::vector<Datagram> datagrams = read_genuine();
  if (datagrams.empty()) return;
  const auto& profile = first<SoundSpeedProfile>(datagrams);
  REQUIRE(profile.nodes.size() == 41);
  CHECK(profile.depth_m(profile.nodes.front()) == 0.0);
  CHECK(profile.depth_m(profile.nodes.back()) == 12'000.0);
  CHECK_THAT(profile.nodes.front().sound_speed_mps.value(), WithinAbs(1481.3, 0.01));
}
