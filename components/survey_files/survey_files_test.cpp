// What installations say, and tracks with gaps.
#include <catch2/catch.hpp>
#include <cmath>

#include "components/errors/exit_error.h"
#include "components/survey_files/ping.h"

using namespace ensonify;
using namespace ensonify::survey_files;
using Catch::Contains;
using Catch::Matchers::WithinAbs;

namespace {

const std::string kRest = ",ATTI_1:X=0;Y=0;Z=0;R=0.5;P=0;H=0;U=ACTIVE,ATTI_2:U=NOT_SET,EMXI:SWLZ=0.330,\n";
const std::string kHead =
    "SYSTEM:EM 2040P,TRAI_HD1:N=1;X=1.1;Y=0.02;Z=0.51;R=0;P=0;H=180;IPX=0.002;IPY=-0.1;IPZ=0;ICX=0.002;ICY=0;"
    "ICZ=-0.006;ISX=0.002;ISY=0.1;ISZ=0;IRX=0.204;IRY=0;IRZ=-0.03";

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
