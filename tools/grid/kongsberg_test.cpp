#include <catch2/catch.hpp>
#include <cmath>
#include <span>
#include <vector>

#include "components/errors/exit_error.h"
#include "components/formats/all/writer.h"
#include "components/formats/kmall/reader.h"
#include "components/formats/kmall/writer.h"
#include "components/formats/testing/sample.h"
#include "tools/grid/input.h"

namespace ensonify::grid_tool {
namespace {

using Catch::Matchers::WithinAbs;
using formats::Bytes;
using formats::FixedPoint;
namespace all = formats::all;
namespace kmall = formats::kmall;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr double kNorthPerDegree_m = 111'311.0;  // of latitude, at 54.3 degrees north on WGS 84

std::vector<Sounding> soundings_of(SoundingFile& file) {
  std::vector<Sounding> soundings;
  file.read([&](const Sounding& sounding) { soundings.push_back(sounding); });
  return soundings;
}

void append_position(all::Writer& writer, Bytes& out, std::int64_t unix_ns, double latitude_deg, bool active) {
  writer.append_next(out, unix_ns,
                     all::Position{.latitude_deg = FixedPoint<std::int32_t, 20'000'000>::of(latitude_deg),
                                   .longitude_deg = FixedPoint<std::int32_t, 10'000'000>::of(8.0),
                                   .descriptor = static_cast<std::uint8_t>(active ? 0x81 : 0x02)});
}

/// A vessel that heads east; a second position system says something else. One valid beam 10 m to port and 2 m ahead.
Bytes all_bytes() {
  Bytes bytes;
  all::Writer writer(2040, 42);
  append_position(writer, bytes, formats::sample::kBegin_ns, 54.3, true);
  append_position(writer, bytes, formats::sample::kBegin_ns + kSecond / 2, 54.4, false);
  append_position(writer, bytes, formats::sample::kBegin_ns + kSecond, 54.3001, true);
  all::Soundings xyz{.heading_deg = FixedPoint<std::uint16_t, 100>::of(90.0), .transducer_depth_m = 1.5F};
  xyz.beams.push_back({.z_m = 20.0F, .y_m = -10.0F, .x_m = 2.0F, .quality = 25});
  xyz.beams.push_back({.z_m = 99.0F, .detection = 0x84});
  writer.append_ping(bytes, formats::sample::kBegin_ns + kSecond / 4, 1, 42, xyz);
  return bytes;
}

}  // namespace

TEST_CASE("a sounding of XYZ 88 lies beside the vessel, turned by its heading, between its active fixes") {
  const formats::sample::TemporaryFile file(all_bytes());
  const auto opened = open_file(file.path().string(), {});
  REQUIRE(opened->facts().origin);
  CHECK_THAT(opened->facts().origin->latitude_deg, WithinAbs(54.3, 1e-7));
  CHECK(opened->facts().datum == "water line");
  const auto soundings = soundings_of(*opened);
  REQUIRE(soundings.size() == 1);  // the other is not valid
  // A quarter of the way north; 2 m ahead is east, 10 m to port is north.
  CHECK_THAT(soundings[0].x_m, WithinAbs(2.0, 1e-3));
  CHECK_THAT(soundings[0].y_m, WithinAbs(0.25 * 1e-4 * kNorthPerDegree_m + 10.0, 1e-2));
  CHECK_THAT(soundings[0].depth_m, WithinAbs(21.5, 1e-6));
  // 25 / 2500 of a range of 22.45 m, with 0.08 m and 0.2 % of the depth.
  CHECK_THAT(soundings[0].sd_m, WithinAbs(std::hypot(0.01 * std::sqrt(504.0), 0.08, 0.043), 1e-6));
}

TEST_CASE("a tide takes its level off depths, and the datum says so") {
  const formats::sample::TemporaryFile file(all_bytes());
  const std::string readings = "utc,m\n2026-03-10T11:00:00Z,1.0\n2026-03-10T13:00:00Z,2.0\n";
  const formats::sample::TemporaryFile gauge(std::as_bytes(std::span(readings)));
  const formats::Tide tide(gauge.path().string());
  const auto opened = open_file(file.path().string(), {.tide = tide});
  CHECK(opened->facts().datum == "chart datum, by the tide of " + gauge.path().filename().string());
  CHECK_THAT(soundings_of(*opened).at(0).depth_m, WithinAbs(21.5 - 1.5, 1e-4));  // a quarter of a second after noon
}

TEST_CASE("a ping far from any fix is nowhere") {
  Bytes bytes = all_bytes();
  all::Writer writer(2040, 42);
  all::Soundings xyz{.transducer_depth_m = 1.5F};
  xyz.beams.push_back({.z_m = 20.0F});
  writer.append_ping(bytes, formats::sample::kBegin_ns + 10 * kSecond, 2, 42, xyz);
  const formats::sample::TemporaryFile file(bytes);
  const auto soundings = soundings_of(*open_file(file.path().string(), {}));
  REQUIRE(soundings.size() == 2);
  CHECK(std::isfinite(soundings[0].x_m));
  CHECK(std::isnan(soundings[1].x_m));
}

TEST_CASE("a file without a position or without soundings is refused") {
  Bytes bytes;
  all::Writer writer(2040, 42);
  append_position(writer, bytes, formats::sample::kBegin_ns, 54.3, true);
  const formats::sample::TemporaryFile positions(bytes);
  CHECK_THROWS_WITH(open_file(positions.path().string(), {}), Catch::Contains("holds no soundings (XYZ 88)"));
  bytes.clear();
  writer.append_ping(bytes, formats::sample::kBegin_ns, 1, 42, all::Soundings{});
  const formats::sample::TemporaryFile soundings(bytes);
  CHECK_THROWS_WITH(open_file(soundings.path().string(), {}), Catch::Contains("holds no position"));
}

TEST_CASE("depths of a genuine .all file are those below the water line") {
  const auto file = formats::sample::genuine("records/em710_g_7041.all");
  if (!file) {
    WARN("skipped: there is no ../shared/data");
    return;
  }
  const auto opened = open_file(file->string(), {});
  const auto soundings = soundings_of(*opened);
  REQUIRE(soundings.size() > 1000);
  for (const Sounding& sounding : soundings) {
    REQUIRE(sounding.depth_m > 110.0);  // data/README: 123 m
    REQUIRE(sounding.depth_m < 135.0);
    REQUIRE(std::hypot(sounding.x_m, sounding.y_m) < 500.0);
  }
}

TEST_CASE("soundings of a genuine .kmall file lie where their x and y put them from the vessel") {
  const auto file = formats::sample::genuine("records/em2040p_eg.kmall");
  if (!file) {
    WARN("skipped: there is no ../shared/data");
    return;
  }
  const auto opened = open_file(file->string(), {});
  const auto soundings = soundings_of(*opened);
  const frames::LocalProjection projection(*opened->facts().origin);
  formats::Window window(*file);
  kmall::Reader reader(window);
  std::size_t next = 0;
  while (const auto datagram = reader.next()) {
    const auto* ping = std::get_if<kmall::Soundings>(&datagram->body);
    if (ping == nullptr) continue;
    const frames::Vec2 vessel = projection.enu_of({ping->pose.latitude_deg, ping->pose.longitude_deg});
    const double heading_rad =
        static_cast<double>(ping->pose.heading_deg) * M_PI / 180.0 - projection.convergence_rad(vessel);
    const frames::Vec2 forward(std::sin(heading_rad), std::cos(heading_rad)), starboard(forward.y(), -forward.x());
    for (const auto& sounding : ping->soundings) {
      if (sounding.detection != 0) continue;
      const frames::Vec2 beside =
          vessel + static_cast<double>(sounding.x_m) * forward + static_cast<double>(sounding.y_m) * starboard;
      // The file's floats of latitude and longitude: 1e-10 degrees of some 1e-4; heading to 0.01 degrees, 35 m across.
      REQUIRE_THAT((beside - frames::Vec2(soundings[next].x_m, soundings[next].y_m)).norm(), WithinAbs(0.0, 0.02));
      ++next;
    }
  }
  CHECK(next == soundings.size());
  CHECK(next > 10'000);
}

}  // namespace ensonify::grid_tool
