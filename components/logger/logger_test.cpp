#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include "components/errors/exit_error.h"
#include "components/formats/all/installation_text.h"
#include "components/formats/all/reader.h"
#include "components/logger/all_image.h"
#include "components/logger/all_ping.h"
#include "components/logger/all_settings.h"
#include "components/logger/instruments.h"
#include "components/logger/testing/survey.h"

using namespace ensonify;
using namespace ensonify::logger::testing;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
namespace all = ensonify::formats::all;
namespace fs = std::filesystem;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// The datagrams of a survey's file.
std::vector<all::Datagram> survey(const World& world, const char* text = "{}") {
  const Folder folder;
  logger::testing::survey(world, text, folder.path);
  const fs::path path = folder.path / "0000_20250601_120000_boat.all";
  return read<all::Datagram, all::Reader>(path);
}

template <class Body>
std::vector<std::pair<std::int64_t, Body>> all_of(const std::vector<all::Datagram>& datagrams) {
  std::vector<std::pair<std::int64_t, Body>> found;
  for (const all::Datagram& datagram : datagrams) {
    if (const auto* body = std::get_if<Body>(&datagram.body)) found.emplace_back(datagram.unix_ns(), *body);
  }
  return found;
}

/// Number of a key of the installation text.
double value_of(const std::string& text, const std::string& key) {
  for (const auto& [name, value] : all::installation_values(text)) {
    if (name == key) return std::stod(value);
  }
  FAIL("no " << key);
  return 0.0;
}

}  // namespace

TEST_CASE("a .all file begins with I, R, U and a second of navigation, and ends with i") {
  const std::vector<all::Datagram> file = survey(bay());
  std::string types;
  for (const all::Datagram& datagram : file) types += datagram.type;
  CHECK(types.substr(0, 3) == "IRU");
  CHECK(types.back() == 'i');
  const std::size_t first_ping = types.find('N');
  CHECK(std::count(types.begin(), types.begin() + static_cast<std::ptrdiff_t>(first_ping), 'P') >= 3);
  CHECK(types.find('A') < first_ping);
  const auto positions = all_of<all::Position>(file);
  CHECK(file[first_ping].unix_ns() - positions.front().first >= 1'000'000'000);
  CHECK_THAT(std::get<all::Installation>(file[0].body).text,
             Contains("RFN=0000_20250601_120000_boat.all,") && Contains("SID=simulated by Ensonify: a generic head,"));
}

TEST_CASE("each ping has N, X and Y with one number and time, and none is left out once it has begun") {
  const std::vector<all::Datagram> file = survey(bay());
  std::string types;
  std::vector<std::uint16_t> numbers;
  for (const all::Datagram& datagram : file) {
    if (datagram.type != 'N' && datagram.type != 'X' && datagram.type != 'Y') continue;
    types += datagram.type;
    if (datagram.type == 'N') numbers.push_back(datagram.header.counter);
    CHECK(datagram.header.counter == numbers.back());
    CHECK(datagram.header.serial == 101);
    CHECK(datagram.header.model == 2040);
  }
  for (std::size_t i = 0; i < types.size(); ++i) REQUIRE(types[i] == "NXY"[i % 3]);
  REQUIRE(numbers.size() > 50);
  for (std::size_t i = 1; i < numbers.size(); ++i)
    REQUIRE(numbers[i] == static_cast<std::uint16_t>(numbers[i - 1] + 1));
}

TEST_CASE("soundings of the file alone lie on the seabed where the head found them") {
  const World world = bay();
  const std::vector<all::Datagram> file = survey(world);
  const frames::LocalProjection projection(world.site.origin);
  const auto positions = all_of<all::Position>(file);
  for (const auto& [time_ns, xyz] : all_of<all::Soundings>(file)) {
    // The positions before and after, in the world's metres, at the time of the ping.
    const auto after =
        std::find_if(positions.begin(), positions.end(), [t = time_ns](const auto& p) { return p.first >= t; });
    if (after == positions.begin() || after == positions.end()) continue;
    const auto enu = [&](const all::Position& p) {
      return projection.enu_of({p.latitude_deg.value(), p.longitude_deg.value()});
    };
    const auto before = std::prev(after);
    const double fraction =
        static_cast<double>(time_ns - before->first) / static_cast<double>(after->first - before->first);
    const frames::Vec2 origin = (1 - fraction) * enu(before->second) + fraction * enu(after->second);
    const double heading = xyz.heading_deg.value() * kDegree - projection.convergence_rad(origin);
    const SimTime t{time_ns - world.start_unix_ns};
    const msg::Soundings truth = ping_at(t, 0, world.vehicles[0].mountings.at("bow").measured);
    for (std::size_t i = 0; i < kBeams; ++i) {
      CAPTURE(seconds(t), i);
      REQUIRE(xyz.beams[i].valid() == (truth.valid[i] != 0));
      if (!xyz.beams[i].valid()) continue;
      REQUIRE_THAT(xyz.beams[i].z_m + xyz.transducer_depth_m, WithinAbs(kSeabedDepth_m, 1e-3));
      const double x = xyz.beams[i].x_m, y = xyz.beams[i].y_m;
      // A millisecond of its time is 3 mm on the way and 2 mm of a roll of 8 degrees; the heading's step 2 mm.
      REQUIRE_THAT(origin.x() + x * std::sin(heading) + y * std::cos(heading),
                   WithinAbs(truth.position_enu_m(i, 0), 0.01));
      REQUIRE_THAT(origin.y() + x * std::cos(heading) - y * std::sin(heading),
                   WithinAbs(truth.position_enu_m(i, 1), 0.01));
    }
  }
}

TEST_CASE("transducer depth follows from the installation, attitude and heave of the file") {
  const std::vector<all::Datagram> file = survey(bay());
  const std::string& text = std::get<all::Installation>(file[0].body).text;
  // Readers add an EM 2040's phase centre to the transmitter's position: z -0.006, y 0.0131 in its own frame.
  const double z_m = value_of(text, "S1Z") - 0.006, x_m = value_of(text, "S1X"), y_m = value_of(text, "S1Y") + 0.0131;
  std::vector<std::pair<std::int64_t, all::Attitude::Entry>> entries;
  for (const auto& [time_ns, attitude] : all_of<all::Attitude>(file)) {
    for (const auto& entry : attitude.entries)
      entries.emplace_back(time_ns + entry.after_ms * std::int64_t{1'000'000}, entry);
  }
  for (const auto& [time_ns, xyz] : all_of<all::Soundings>(file)) {
    const auto near = std::min_element(entries.begin(), entries.end(), [t = time_ns](const auto& a, const auto& b) {
      return std::abs(a.first - t) < std::abs(b.first - t);
    });
    const double roll = near->second.roll_deg.value() * kDegree, pitch = near->second.pitch_deg.value() * kDegree;
    const double below_m = -x_m * std::sin(pitch) + std::cos(pitch) * (y_m * std::sin(roll) + z_m * std::cos(roll));
    // Half a centimetre of heave's step, and what 5 ms change.
    CHECK_THAT(xyz.transducer_depth_m,
               WithinAbs(below_m + near->second.heave_m.value() - value_of(text, "WLZ"), 0.008));
  }
  CHECK_THAT(value_of(text, "WLZ"), WithinAbs(-kReferenceDepth_m, 1e-9));
}

TEST_CASE("angles are positive to port, beams without a detection are all zero and marked") {
  for (const auto& [time_ns, raw] : all_of<all::RawRangeAngle>(survey(bay()))) {
    REQUIRE(raw.beams.size() == kBeams);
    CHECK_THAT(raw.beams[1].angle_deg.value(), WithinAbs(49.0, 0.006));
    CHECK_THAT(raw.beams[99].angle_deg.value(), WithinAbs(-49.0, 0.006));
    CHECK(raw.beams[0].detection == 0x84);
    CHECK(raw.beams[0].travel_time_s == 0.0F);
    CHECK(raw.beams[11].detection == 1);
    CHECK(raw.beams[51].detection == 0);
    CHECK(raw.valid_beams == kBeams - 11);
    CHECK(raw.sectors.at(0).index == 1);
    CHECK_THAT(raw.beams[51].reflectivity_db.value(), WithinAbs(-30.1, 0.051));
  }
}

TEST_CASE("an image's samples run from port to starboard, and are cut around detections to what a network carries") {
  const msg::Soundings soundings = ping_at(1_s, 0, {});
  for (const std::uint32_t samples : {4U, 2'000U}) {
    CAPTURE(samples);
    msg::SeabedImage image;
    image.sample_period_s = 5e-5;
    const std::vector<std::uint16_t> beams{1, 51, 99};
    const std::uint32_t centre = samples / 4;
    std::vector<std::uint32_t> offsets{0};
    std::vector<float> strengths;
    for (std::size_t beam = 0; beam < beams.size(); ++beam) {
      for (std::uint32_t k = 0; k < samples; ++k)
        strengths.push_back(-0.1F * static_cast<float>(k));  // falls with range
      offsets.push_back(static_cast<std::uint32_t>(strengths.size()));
    }
    image.beam = msg::Array<std::uint16_t>::of(beams);
    image.centre = msg::Array<std::uint32_t>::of(std::vector<std::uint32_t>(beams.size(), centre));
    image.offset = msg::Array<std::uint32_t>::of(offsets);
    image.strength_db = msg::Array<float>::of(strengths);

    const all::SeabedImage written = logger::seabed_image(soundings, image);
    REQUIRE(written.beams.size() == kBeams);
    CHECK(all::SeabedImage::samples(written.beams) == written.strength_ddb.size());
    CHECK(written.strength_ddb.size() * sizeof(std::int16_t) <= logger::kMostImageBytes);
    CHECK(written.beams[0].samples == 0);
    const std::size_t kept = written.beams[1].samples;
    CHECK(kept == std::min<std::size_t>(samples, logger::kMostImageBytes / 2 / kBeams));
    std::size_t begin = 0;
    for (const std::size_t beam : {1U, 51U, 99U}) {
      const std::span<const std::int16_t> series(written.strength_ddb.data() + begin, kept);
      CHECK((beam < 50 ? series.front() < series.back() : series.front() > series.back()));
      // The sample of the detection is the one that the head gave: -0.1 dB by its number.
      CHECK(series[written.beams[beam].centre_sample - 1U] == -static_cast<int>(centre));
      begin += kept;
    }
  }
}

TEST_CASE("positions come at their rate and repeat the sentence's fix but for the lever to the water line") {
  const World world = bay();
  const auto positions = all_of<all::Position>(survey(world, "{ position_rate_hz: 10 }"));
  REQUIRE(positions.size() > 90);
  for (std::size_t i = 2; i < positions.size(); ++i) CHECK(positions[i].first - positions[i - 1].first == 100'000'000);
  const frames::LocalProjection projection(world.site.origin);
  for (const auto& [time_ns, position] : positions) {
    const frames::Pose body = pose_at(SimTime{time_ns - world.start_unix_ns});
    const frames::Vec2 origin = frames::enu_from_body(body, {0, 0, -kReferenceDepth_m}).head<2>();
    const frames::Vec2 logged = projection.enu_of({position.latitude_deg.value(), position.longitude_deg.value()});
    CHECK((logged - origin).norm() < 0.01);
    // INGGA,hhmmss.ss,ddmm.mmmmmmm
    const double latitude_deg =
        std::stod(position.sentence.substr(16, 2)) + std::stod(position.sentence.substr(18)) / 60;
    CHECK_THAT(latitude_deg, WithinAbs(projection.geodetic_of(body.position_enu_m.head<2>()).latitude_deg, 1e-8));
    CHECK_THAT(position.speed_mps.value(), WithinAbs(std::hypot(2.0, 2.0), 0.006));
  }
}

TEST_CASE("after each rotation a file stands alone, and no ping is left out or written twice") {
  const World world = bay();
  for (const char* text : {"{ rotate_s: 2 }", "{ rotate_mb: 0.05 }", "{ rotate_lines: true }"}) {
    CAPTURE(text);
    const Folder folder;
    const LoggerConfig config = config_of(world, text);
    NodeUnderTest<LoggerNode> logger(config, "logger", folder.path);
    give_navigation(logger, 10_s);
    std::int64_t number = 0;
    for (SimTime t{0}; t <= 9_s; t += kPingPeriod) logger.give("soundings", ping_at(t, number++, config.vessel.head));
    if (config.rotate_lines) {
      for (int line = 0; line < 3; ++line) {
        msg::MissionState state;
        state.stamp_ns = (3_s * line).count();
        state.line = line;
        logger.give("mission", state);
      }
    }
    logger.run_until(10_s);
    logger.node().finish_run();

    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder.path)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    REQUIRE(files.size() >= 3);
    std::vector<std::uint16_t> numbers;
    std::set<std::int64_t> position_times, attitude_times;  // of all files: none comes twice
    for (std::size_t i = 0; i < files.size(); ++i) {
      CHECK(files[i].filename().string().substr(0, 5) == fmt::format("{:04}_", i));
      formats::Window window(files[i]);
      all::Reader reader(window);
      std::string types;
      std::int64_t first_position_ns = 0, first_ping_ns = 0;
      while (const auto datagram = reader.next()) {
        types += datagram->type;
        if (datagram->type == 'P') CHECK(position_times.insert(datagram->unix_ns()).second);
        if (const auto* attitude = std::get_if<all::Attitude>(&datagram->body)) {
          for (const auto& entry : attitude->entries)
            CHECK(attitude_times.insert(datagram->unix_ns() + entry.after_ms * std::int64_t{1'000'000}).second);
        }
        if (datagram->type == 'P' && first_position_ns == 0) first_position_ns = datagram->unix_ns();
        if (datagram->type == 'N') numbers.push_back(datagram->header.counter);
        if (datagram->type == 'N' && first_ping_ns == 0) first_ping_ns = datagram->unix_ns();
      }
      CHECK(reader.faults().count() == 0);
      CHECK(types.starts_with("IRU"));
      CHECK(types.back() == 'i');
      const auto before = types.substr(0, types.find('N'));
      CHECK(std::count(before.begin(), before.end(), 'P') >= 3);
      CHECK(before.find('A') != std::string::npos);
      CHECK(first_ping_ns - first_position_ns >= 1'000'000'000);
    }
    REQUIRE(numbers.size() > 50);
    for (std::size_t i = 1; i < numbers.size(); ++i) CHECK(numbers[i] == numbers[i - 1] + 1);
  }
}

TEST_CASE("formats that a sidescan alone cannot have, and a sidescan that nobody writes, are refused") {
  World world = bay();
  world.vehicles[0].mountings["side"] = {};
  CHECK_THROWS_WITH(config_of(world),
                    Contains("head: is to be named where vehicles carry several; the scenario's carry: bow, side"));
  CHECK_THROWS_WITH(config_of(world, "{ sidescan: side }"), Contains("all: needs the soundings of a multibeam"));
  CHECK_THROWS_WITH(config_of(world, "{ head: bow, sidescan: side }"), Contains("is written in xtf alone"));
  CHECK_THROWS_WITH(config_of(world, "{ head: bow, formats: [dvd] }"),
                    Contains("\"dvd\" is no format; allowed: all, kmall, wcd, kmwcd, xtf"));
  CHECK(config_of(world, "{ sidescan: side, formats: [xtf] }").head.empty());
}

TEST_CASE("a head that is not there, a vehicle that dives and foreign soundings are refused") {
  CHECK_THROWS_WITH(config_of(bay(), "{ head: stern }"),
                    Contains("\"stern\" is no head of the scenario; its vehicles carry: bow"));
  World diving = bay();
  diving.mission.depth_m = 50;
  CHECK_THROWS_WITH(config_of(diving), Contains("all: the vehicle boat dives"));
}

TEST_CASE("without an estimate there is no file, and the pings left out are counted") {
  const Folder folder;
  const LoggerConfig config = config_of(bay());
  NodeUnderTest<LoggerNode> logger(config, "logger", folder.path);
  for (int i = 0; i < 5; ++i) {
    logger.give("soundings", ping_at(100_ms * i, i, config.vessel.head));
    msg::Attitude attitude;
    attitude.stamp_ns = (100_ms * i).count();
    logger.give("attitude", attitude);
  }
  logger.run_until(1_s);
  logger.node().finish_run();
  CHECK(fs::is_empty(folder.path));
}

TEST_CASE(
    "Kongsberg's formats are refused of heads that stand for others, and of frequencies that are none of theirs") {
  const auto declared = [](const char* instrument, double frequency_hz) {
    msg::HeadDeclaration head{.kind = "multibeam", .instrument = instrument};
    head.channels.push_back({.sectors = {{.frequency_hz = frequency_hz}}});
    return head;
  };
  const auto check = [](const LoggedFormats& formats, const msg::HeadDeclaration& head) {
    logger::check_instrument("log", formats, "bow", head);
  };
  for (const char* instrument : {"t50", "r2sonic2024", "norbit_iwbms"}) {
    CHECK_THROWS_WITH(check({"xtf", "kmall"}, declared(instrument, 300e3)),
                      Contains("log: formats: kmall: bow stands for the class") && Contains(instrument));
    CHECK_NOTHROW(check({"xtf"}, declared(instrument, 300e3)));
  }
  CHECK_NOTHROW(check({"all", "kmall"}, declared("em2040", 300e3)));
  CHECK_NOTHROW(check({"all"}, declared("generic", 200e3)));
  CHECK_THROWS_WITH(check({"all"}, declared("generic", 100e3)), Contains("bow sends at 100 kHz; allowed: xtf"));
  CHECK_NOTHROW(check({"all"}, {}));  // a record of before
  CHECK_NOTHROW(logger::check_soundings("log", {"all"}, "bow", 1'024));
  CHECK_NOTHROW(logger::check_soundings("log", {"xtf"}, "bow", 2'048));
  CHECK_THROWS_WITH(logger::check_soundings("log", {"kmall"}, "bow", 1'025),
                    Contains("bow gives 1025 soundings a ping") && Contains("1024"));
  CHECK(logger::simulated_by("em2040") == "simulated by Ensonify");
  CHECK_THAT(logger::simulated_by("generic"), Contains("generic head"));
}

TEST_CASE("halfway between two moments lies their mean, over north and the antimeridian too") {
  logger::Moment earlier, later;
  earlier.unix_ns = 10;
  later.unix_ns = 20;
  earlier.heading_deg = 359.0;
  later.heading_deg = 2.0;
  earlier.reference = {10.0, 179.9999};
  later.reference = {11.0, -179.9997};
  later.roll_deg = 1.0;
  const logger::Moment middle = logger::between(earlier, later);
  CHECK(middle.unix_ns == 15);
  CHECK_THAT(middle.heading_deg, WithinAbs(0.5, 1e-9));
  CHECK_THAT(middle.reference.latitude_deg, WithinAbs(10.5, 1e-12));
  CHECK_THAT(middle.reference.longitude_deg, WithinAbs(-179.9999, 1e-9));
  CHECK_THAT(middle.roll_deg, WithinAbs(0.5, 1e-12));
}

TEST_CASE("R states what is stabilised, and N no soundings without a deviation") {
  msg::AppliedSettings settings;
  CHECK(logger::runtime(settings).stabilisation == 0);
  settings.yaw_stabilised = true;
  CHECK(logger::runtime(settings).stabilisation == 0x02);
  settings.pitch_stabilised = true;
  CHECK(logger::runtime(settings).stabilisation == 0x82);

  msg::Soundings soundings = ping_at(5_s, 1, bay().vehicles[0].mountings.at("bow").measured);
  soundings.range_sd_m[51] = 1e-4F;  // an eightieth of a step
  const auto raw = logger::raw_range_angle(soundings);
  CHECK(raw.beams[51].quality == 1);
  CHECK(raw.beams[52].quality == 3);  // 0.02 m at 19 m
}
