#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <variant>

#include "components/formats/all/reader.h"
#include "components/formats/kmall/reader.h"
#include "components/logger/kmall/navigation.h"
#include "components/logger/testing/survey.h"

using namespace ensonify;
using namespace ensonify::logger::testing;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
namespace kmall = ensonify::formats::kmall;
namespace fs = std::filesystem;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::vector<kmall::Datagram> survey(const World& world, const char* text = "formats: [kmall]") {
  const Folder folder;
  logger::testing::survey(world, text, folder.path);
  return read<kmall::Datagram, kmall::Reader>(folder.path / "0000_20250601_120000_boat.kmall");
}

std::int64_t unix_ns(const kmall::Datagram& datagram) {
  return std::int64_t{datagram.header.time_s} * 1'000'000'000 + datagram.header.time_ns;
}

}  // namespace

TEST_CASE("a .kmall file begins with #IIP, #IOP, #SVP and a second of navigation") {
  const auto file = survey(bay());
  REQUIRE(file.size() > 100);
  CHECK((file[0].type == "#IIP" && file[1].type == "#IOP" && file[2].type == "#SVP"));
  CHECK_THAT(std::get<kmall::Installation>(file[0].body).text,
             Contains("simulated by Ensonify") && Contains("KMALL:Rev I") && Contains("TRAI_TX1:N=101;"));
  int positions = 0, motions = 0;
  for (const kmall::Datagram& datagram : file) {
    if (datagram.type == "#MRZ") break;
    positions += datagram.type == "#SPO" ? 1 : 0;
    motions += datagram.type == "#SKM" ? 1 : 0;
  }
  CHECK(positions >= 3);
  CHECK(motions >= 1);
}

TEST_CASE("soundings of a .kmall lie on the seabed where the head found them, by metres and by degrees") {
  const World world = bay();
  const frames::LocalProjection projection(world.site.origin);
  const frames::Mounting& mounting = world.vehicles[0].mountings.at("bow").measured;
  std::int64_t number = -1;
  int pings = 0;
  for (const kmall::Datagram& datagram : survey(world)) {
    const auto* ping = std::get_if<kmall::Soundings>(&datagram.body);
    if (ping == nullptr) continue;
    if (number >= 0) REQUIRE(ping->ping.ping == static_cast<std::uint16_t>(number + 1));
    number = ping->ping.ping;
    ++pings;
    const SimTime t{unix_ns(datagram) - world.start_unix_ns};
    const msg::Soundings truth = ping_at(t, 0, mounting);
    const frames::Vec2 origin = projection.enu_of({ping->pose.latitude_deg, ping->pose.longitude_deg});
    const double heading_rad =
        static_cast<double>(ping->pose.heading_deg) * kDegree - projection.convergence_rad(origin);
    REQUIRE(ping->main_soundings == kBeams);
    REQUIRE(ping->valid_main_soundings == 90);
    for (std::size_t i = 0; i < kBeams; ++i) {
      CAPTURE(seconds(t), i);
      const kmall::Sounding& one = ping->soundings[i];
      REQUIRE(one.valid() == (truth.valid[i] != 0));
      REQUIRE_THAT(one.angle_deg, WithinAbs(50.0 - static_cast<double>(i), 1e-4));
      if (!one.valid()) continue;
      // Of the water line, which heaves with the vessel in the file as in the world.
      REQUIRE_THAT(one.z_m - ping->pose.water_line_m, WithinAbs(kSeabedDepth_m, 1e-3));
      const double x = one.x_m, y = one.y_m;
      REQUIRE_THAT(origin.x() + x * std::sin(heading_rad) + y * std::cos(heading_rad),
                   WithinAbs(truth.position_enu_m(i, 0), 1e-3));
      REQUIRE_THAT(origin.y() + x * std::cos(heading_rad) - y * std::sin(heading_rad),
                   WithinAbs(truth.position_enu_m(i, 1), 1e-3));
      const frames::Vec2 by_degrees =
          projection.enu_of({ping->pose.latitude_deg + static_cast<double>(one.delta_latitude_deg),
                             ping->pose.longitude_deg + static_cast<double>(one.delta_longitude_deg)});
      REQUIRE_THAT(by_degrees.x(), WithinAbs(truth.position_enu_m(i, 0), 1e-3));
      REQUIRE_THAT(by_degrees.y(), WithinAbs(truth.position_enu_m(i, 1), 1e-3));
      REQUIRE(one.travel_time_s == truth.travel_time_s[i]);
      REQUIRE(one.method == (truth.kind[i] == 2 ? 2 : 1));
      REQUIRE_THAT(one.reflectivity_2_db, WithinAbs(-25.0 - 0.1 * static_cast<double>(i), 1e-4));
    }
  }
  CHECK(pings > 50);
}

TEST_CASE("a .kmall's transducer depth and origin follow from its installation, attitude and heave") {
  const auto file = survey(bay());
  const World world = bay();
  const frames::Mounting& mounting = world.vehicles[0].mountings.at("bow").measured;
  for (const kmall::Datagram& datagram : file) {
    const auto* ping = std::get_if<kmall::Soundings>(&datagram.body);
    if (ping == nullptr) continue;
    const frames::Pose pose = pose_at(SimTime{unix_ns(datagram) - world.start_unix_ns});
    const frames::Vec3 head_m = frames::enu_from_body(pose, mounting.position_body_m);
    REQUIRE_THAT(ping->pose.transducer_depth_m, WithinAbs(-head_m.z(), 1e-4));
    // The origin of .all is the water line's point below the antenna, tilted: as X of the same ping has it.
    const frames::Vec3 shift = pose.enu_from_body * frames::Vec3(0.0, 0.0, -0.7);
    REQUIRE_THAT(std::hypot(ping->pose.x_to_all_m, ping->pose.y_to_all_m),
                 WithinAbs(std::hypot(shift.x(), shift.y()), 1e-4));
  }
}

TEST_CASE(".all and .kmall of one survey agree, ping by ping") {
  const World world = bay();
  const Folder folder;
  logger::testing::survey(world, "formats: [kmall, all]", folder.path);
  const auto kmall_file = read<kmall::Datagram, kmall::Reader>(folder.path / "0000_20250601_120000_boat.kmall");
  const auto all_file =
      read<formats::all::Datagram, formats::all::Reader>(folder.path / "0000_20250601_120000_boat.all");
  std::map<std::uint16_t, formats::all::Soundings> xyz;
  for (const auto& datagram : all_file) {
    if (const auto* body = std::get_if<formats::all::Soundings>(&datagram.body)) xyz[datagram.header.counter] = *body;
  }
  std::size_t compared = 0;
  for (const auto& datagram : kmall_file) {
    const auto* ping = std::get_if<kmall::Soundings>(&datagram.body);
    if (ping == nullptr) continue;
    REQUIRE(xyz.count(ping->ping.ping) == 1);
    const formats::all::Soundings& other = xyz[ping->ping.ping];
    for (std::size_t i = 0; i < kBeams; ++i) {
      const kmall::Sounding& one = ping->soundings[i];
      REQUIRE(one.valid() == other.beams[i].valid());
      if (!one.valid()) continue;
      REQUIRE_THAT(one.z_m - ping->pose.water_line_m - other.transducer_depth_m, WithinAbs(other.beams[i].z_m, 1e-3));
      REQUIRE_THAT(one.x_m - ping->pose.x_to_all_m, WithinAbs(other.beams[i].x_m, 1e-3));
      REQUIRE_THAT(one.y_m - ping->pose.y_to_all_m, WithinAbs(other.beams[i].y_m, 1e-3));
      ++compared;
    }
  }
  CHECK(compared > 5000);
}

TEST_CASE("#SKM has the estimate's attitude and heave, down, and rates that are its slopes") {
  const World world = bay();
  std::size_t samples = 0;
  for (const kmall::Datagram& datagram : survey(world)) {
    const auto* motion = std::get_if<kmall::Motion>(&datagram.body);
    if (motion == nullptr) continue;
    REQUIRE(motion->samples.size() <= logger::kmall::kMostMotionSamples);
    for (std::size_t i = 0; i < motion->samples.size(); ++i) {
      const auto& sample = motion->samples[i];
      const SimTime t{std::int64_t{sample.time_s} * 1'000'000'000 + sample.time_ns - world.start_unix_ns};
      CAPTURE(seconds(t));
      REQUIRE_THAT(sample.roll_deg, WithinAbs(8.0 * std::cos(0.9 * seconds(t)), 1e-4));
      REQUIRE_THAT(sample.pitch_deg, WithinAbs(3.0 * std::sin(seconds(t)), 1e-4));
      REQUIRE_THAT(sample.heave_m, WithinAbs(-heave_up_m(t), 1e-4));
      REQUIRE_THAT(std::hypot(sample.velocity_mps[0], sample.velocity_mps[1]), WithinAbs(std::sqrt(8.0), 1e-4));
      // Half a step of 10 ms off at the ends, with 6.5 degrees/s2 at most.
      REQUIRE_THAT(sample.rate_degps[0], WithinAbs(-7.2 * std::sin(0.9 * seconds(t)), 0.04));
      ++samples;
    }
  }
  CHECK(samples > 900);
}

TEST_CASE("more samples than a #SKM holds are refused, and a turn over north is no whole turn") {
  std::vector<logger::Moment> moments(2);
  moments[0].heading_deg = 359.9;
  moments[1].heading_deg = 0.1;
  moments[1].unix_ns = 10'000'000;
  CHECK_THAT(logger::kmall::motion(moments, {}).samples[0].rate_degps[2], WithinAbs(20.0, 1e-3));
  moments.resize(logger::kmall::kMostMotionSamples + 1);
  CHECK_THROWS_AS(logger::kmall::motion(moments, {}), std::invalid_argument);
}

TEST_CASE("fields for simulators are set where that is wanted, and only there") {
  for (const bool wanted : {false, true}) {
    bool found = false;
    for (const kmall::Datagram& datagram :
         survey(bay(), wanted ? "{formats: [kmall], mark_simulated: datagrams}" : "formats: [kmall]")) {
      if (const auto* ping = std::get_if<kmall::Soundings>(&datagram.body)) {
        REQUIRE(ping->info.detection_mode == (wanted ? 100 : 0));
        found = true;
      }
      if (const auto* runtime = std::get_if<kmall::Runtime>(&datagram.body))
        REQUIRE_THAT(runtime->text, Contains(wanted ? "Enable Simulation: On" : "Enable Simulation: Off"));
      if (const auto* position = std::get_if<kmall::Position>(&datagram.body))
        REQUIRE_THAT(position->sentence, Contains(wanted ? ",E,8," : ",E,4,"));
    }
    CHECK(found);
  }
}
