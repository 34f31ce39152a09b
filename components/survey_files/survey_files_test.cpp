// What installations say, and tracks with gaps.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "components/errors/exit_error.h"
#include "components/formats/all/reader.h"
#include "components/formats/all/writer.h"
#include "components/formats/kmall/reader.h"
#include "components/formats/kmall/writer.h"
#include "components/formats/testing/sample.h"
#include "components/survey_files/fixes.h"
#include "components/survey_files/ping.h"
#include "components/survey_files/survey.h"

using namespace ensonify;
using namespace ensonify::survey_files;
using Catch::Contains;
using Catch::Matchers::WithinAbs;

namespace {

const std::string kRest = ",ATTI_1:X=0;Y=0;Z=0;R=0.5;P=0;H=0;U=ACTIVE,ATTI_2:U=NOT_SET,EMXI:SWLZ=0.330,\n";
const std::string kHead =
    "SYSTEM:EM 2040P,TRAI_HD1:N=1;X=1.1;Y=0.02;Z=0.51;R=0;P=0;H=180;IPX=0.002;IPY=-0.1;IPZ=0;ICX=0.002;ICY=0;"
    "ICZ=-0.006;ISX=0.002;ISY=0.1;ISZ=0;IRX=0.204;IRY=0;IRZ=-0.03";

/// The sample's datagrams, its attitude drawn out so that it covers the pings.
formats::Bytes kmall_bytes() {
  const formats::Bytes whole = formats::sample::kmall_file().bytes;
  formats::Window window{formats::ByteView(whole)};
  formats::kmall::Reader reader(window);
  formats::Bytes bytes;
  while (auto datagram = reader.next()) {
    if (auto* text = std::get_if<formats::kmall::Installation>(&datagram->body)) text->text = kHead + kRest;
    if (auto* motion = std::get_if<formats::kmall::Motion>(&datagram->body)) {
      std::uint32_t half_seconds = 0;
      for (auto& sample : motion->samples) {
        sample.time_s += half_seconds / 2;
        sample.time_ns = half_seconds++ % 2 * 500'000'000;
      }
    }
    append(bytes, *datagram);
  }
  return bytes;
}

formats::Bytes all_bytes() {
  const formats::Bytes whole = formats::sample::all_file().bytes;
  formats::Window window{formats::ByteView(whole)};
  formats::all::Reader reader(window);
  formats::Bytes bytes;
  while (auto datagram = reader.next()) {
    if (auto* attitude = std::get_if<formats::all::Attitude>(&datagram->body)) {
      for (std::size_t i = 0; i < attitude->entries.size(); ++i)
        attitude->entries[i].after_ms = static_cast<std::uint16_t>(900 * i);
    }
    append(bytes, *datagram);
  }
  return bytes;
}

}  // namespace

TEST_CASE("a portable head has both arrays, each with its own phase centre") {
  const Vessel vessel = vessel_of_kmall("f", kHead + kRest);
  REQUIRE(vessel.transmitters.size() == 1);
  REQUIRE(vessel.receivers.size() == 1);
  CHECK(vessel.water_line_m == 0.33);
  // Mounted backwards: forward in its own frame is aft.
  CHECK((vessel.transmitters[0].mounting(0).position_body_m - frames::Vec3(1.098, 0.12, 0.51)).norm() < 1e-12);
  CHECK((vessel.receivers[0].mounting(0).position_body_m - frames::Vec3(0.896, 0.02, 0.48)).norm() < 1e-12);
  CHECK_THAT(frames::attitude_of(frames::enu_from_ned() * vessel.body_from_motion_sensor).roll_rad,
             WithinAbs(0.5 * M_PI / 180, 1e-12));
}

TEST_CASE("an installation that lacks something is refused by its name") {
  CHECK_THROWS_WITH(vessel_of_kmall("f", "SYSTEM:EM 2040,POSI_1:X=1" + kRest), Contains("no transmitter and receiver"));
  CHECK_THROWS_WITH(vessel_of_kmall("f", kHead + ",EMXI:SWLZ=0.1,"), Contains("no motion sensor"));
  CHECK_THROWS_WITH(vessel_of_kmall("f", kHead + ",ATTI_1:R=0;P=0;H=0,"), Contains("no water line"));
  CHECK_THROWS_WITH(vessel_of_kmall("f", "TRAI_TX1:X=1;Y=2" + kRest), Contains("installation TRAI_TX1 has no Z"));
  CHECK_THROWS_WITH(vessel_of_kmall("f", "TRAI_TX1:X=1;Y=2;Z=three" + kRest),
                    Contains("TRAI_TX1:Z=three is no number"));
  CHECK_THROWS_WITH(vessel_of_kmall("f", "TRAI_TX1:X=0;Y=0;Z=0;R=0;P=0;H=0,TRAI_RX1:X=0;Y=0;Z=0;R=0;P=0;H=90" + kRest),
                    Contains("nearly along each other"));
}

TEST_CASE("a .all file's installation has two arrays, or one head") {
  const std::string both =
      "WLZ=-4.9,S1X=1,S1Y=2,S1Z=3,S1R=0,S1P=0,S1H=0,S2X=1,S2Y=2.5,S2Z=3,S2R=0,S2P=0,S2H=180,APS=1,P2X=4,P2Y=5,P2Z=-9,";
  const VesselOfAll vessel = vessel_of_all("f", both, 2040);
  CHECK(vessel.transmitters[0].mounting(1).position_body_m.isApprox(frames::Vec3(1, 2.0131, 2.994)));
  CHECK(vessel.receivers[0].mounting(0).position_body_m.isApprox(frames::Vec3(0.989, 2.5, 2.994)));
  CHECK(vessel.origin_m == frames::Vec3(4, 5, -4.9));
  CHECK_FALSE(vessel.heave_at_transmitter);
  CHECK(vessel_of_all("f", both, 710).heave_at_transmitter);
  const VesselOfAll head = vessel_of_all("f", "WLZ=0,S1X=1,S1Y=2,S1Z=3,S1R=0,S1P=0,S1H=0,P1X=0,P1Y=0,", 2045);
  CHECK(head.receivers[0].installed.position_body_m == head.transmitters[0].installed.position_body_m);
  CHECK_THROWS_WITH(vessel_of_all("f", both + "STC=2,", 2040), Contains("two transmitters (STC=2)"));
  CHECK_THROWS_WITH(vessel_of_all("f", "WLZ=0,S1X=1,", 2040), Contains("installation has no S1"));
  CHECK_THROWS_WITH(vessel_of_all("f", "WLZ=deep," + both.substr(both.find(',') + 1), 2040),
                    Contains("WLZ=deep is no number"));
}

TEST_CASE("a track says nothing where it has a gap, and beyond its ends") {
  constexpr std::int64_t kSecond = 1'000'000'000;
  Track track;
  const auto at = [](double east_m) { return frames::Pose{{east_m, 0, 0}, frames::enu_from_ned()}; };
  track.add(5 * kSecond, at(9));
  track.add(1 * kSecond, at(2));
  track.add(0, at(1));
  track.sort();
  CHECK(track.at(kSecond / 4)->position_enu_m.x() == 1.25);
  CHECK(track.at(kSecond)->position_enu_m.x() == 2);
  CHECK(track.at(5 * kSecond)->position_enu_m.x() == 9);
  CHECK_FALSE(track.at(2 * kSecond));
  CHECK_FALSE(track.at(-1));
  CHECK_FALSE(track.at(5 * kSecond + 1));
}

TEST_CASE("water is traced from the face's own speed, or as the profile stands") {
  const std::vector<refraction::Knot> profile{{0, 1500}, {2, 1490}, {10, 1480}};
  const Water face = water_below(1.0, 1510.0, profile);
  CHECK(face.face_speed_mps == 1510.0);
  CHECK(face.profile.speed_mps(1.0) == 1510.0);
  CHECK(face.profile.speed_mps(1.5) == 1500.0);
  CHECK(face.profile.speed_mps(10.0) == 1480.0);
  CHECK(water_of_profile(1.0, profile).face_speed_mps == 1495.0);
}

TEST_CASE("fixes before the first one are no place, and one at the antimeridian is") {
  Fixes fixes;
  fixes.add(1, {0.0, 0.0});
  fixes.add(2, {200.0, 200.0});
  CHECK(fixes.empty());
  fixes.add(3, {10.0, 180.0});
  fixes.add(5, {10.0, -179.9999});
  CHECK_THAT(fixes.enu_at(4).x(), WithinAbs(0.5 * 1e-4 * 111'320 * std::cos(10 * M_PI / 180), 0.1));
}

TEST_CASE("a damaged file has soundings or an error, and nothing else") {
  using Place = Summary (*)(const std::string&, const Trace&, const TakePlaced&);
  const std::vector<std::pair<formats::Bytes, Place>> files{{kmall_bytes(), place_kmall}, {all_bytes(), place_all}};
  for (const auto& [whole, place] : files) {
    int placed_whole = 0, refused = 0, placed_damaged = 0;
    const formats::sample::TemporaryFile sound(whole);
    place(sound.path().string(), {}, [&](const Placed&) { ++placed_whole; });
    REQUIRE(placed_whole > 1);
    for (std::size_t at = 0; at < 3 * whole.size(); at += 13) {
      constexpr std::byte kBad[] = {std::byte{0xFF}, std::byte{0x7F}, std::byte{0}};  // a NaN or a limit, much, nothing
      formats::Bytes bytes = whole;
      const std::size_t begin = at % bytes.size();
      std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                bytes.begin() + static_cast<std::ptrdiff_t>(std::min(begin + 4, bytes.size())),
                kBad[at / bytes.size()]);
      const formats::sample::TemporaryFile file(bytes);
      bool finite = true;
      try {
        place(file.path().string(), {}, [&](const Placed& placed) {
          finite = finite && placed.place_m.allFinite();
          ++placed_damaged;
        });
      } catch (const UserError&) {
        ++refused;
      }
      CHECK(finite);
    }
    CHECK(refused > 0);
    CHECK(placed_damaged > 10 * placed_whole);
  }
}
