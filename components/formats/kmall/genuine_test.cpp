// A genuine EM 2040P file, read and written again. Where the folder of data is absent, the cases say so and pass.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "components/formats/kmall/reader.h"
#include "components/formats/kmall/writer.h"
#include "components/formats/testing/contents.h"
#include "components/formats/testing/sample.h"

using namespace ensonify::formats;
using namespace ensonify::formats::kmall;
using Catch::Matchers::WithinAbs;

namespace {

std::vector<Datagram> read_genuine() {
  const auto path = sample::genuine("records/em2040p_eg.kmall");
  if (!path) {
    WARN("skipped: no data/records/em2040p_eg.kmall in the folder that ENSONIFY_SHARED names");
    return {};
  }
  Window file(*path);
  auto contents = sample::contents_of<Datagram, Reader>(file);
  CHECK(contents.faults.count() == 0);
  return contents.datagrams;
}

}  // namespace

TEST_CASE("a genuine .kmall file read and written again is the same bytes") {
  const std::vector<Datagram> datagrams = read_genuine();
  if (datagrams.empty()) return;
  Bytes written;
  std::map<std::string, int> known;
  for (const Datagram& datagram : datagrams) {
    append(written, datagram);
    if (!std::holds_alternative<Raw>(datagram.body)) ++known[datagram.type];
    // Behind the profile stands a stale node, in every genuine file.
    CAPTURE(datagram.type);
    CHECK(datagram.rest.size() == (datagram.type == "#SVP" ? 20 : 0));
  }
  CHECK(written == sample::bytes_of(*sample::genuine("records/em2040p_eg.kmall")));
  CHECK(known == std::map<std::string, int>{{"#IIP", 1},
                                            {"#IOP", 1},
                                            {"#SVP", 1},
                                            {"#SCL", 1},
                                            {"#SVT", 2},
                                            {"#SPO", 2},
                                            {"#CPO", 2},
                                            {"#SKM", 1},
                                            {"#MRZ", 25}});
}

TEST_CASE("genuine pings hold their soundings re the reference point, port first") {
  const std::vector<Datagram> datagrams = read_genuine();
  if (datagrams.empty()) return;
  for (const Datagram& datagram : datagrams) {
    const auto* ping = std::get_if<Soundings>(&datagram.body);
    if (ping == nullptr) continue;
    CAPTURE(datagram.offset);
    CHECK(ping->main_soundings == 512);
    // The transmitter is 0.51 m below and 1.1 m ahead of the reference point; the vessel pitches.
    CHECK_THAT(ping->pose.transducer_depth_m + ping->pose.water_line_m, WithinAbs(0.51, 0.1));
    CHECK_THAT(ping->pose.latitude_deg, WithinAbs(27.58301, 1e-4));
    const Sounding& first = ping->soundings.front();
    const Sounding& last = ping->soundings[ping->main_soundings - 1U];
    CHECK((first.angle_deg > 0 && first.y_m < 0));
    CHECK((last.angle_deg < 0 && last.y_m > 0));
    // Over water as shallow as this the paths are all but straight: range, angle and depth belong together.
    const Sounding& middle = ping->soundings[256];
    CHECK_THAT(middle.travel_time_s * ping->pose.sound_speed_mps / 2,
               WithinAbs(std::hypot(middle.x_m - 1.1, middle.y_m, middle.z_m - 0.51), 0.2));
  }
}

TEST_CASE("genuine motion is a second of samples at 100 Hz") {
  const std::vector<Datagram> datagrams = read_genuine();
  for (const Datagram& datagram : datagrams) {
    const auto* motion = std::get_if<Motion>(&datagram.body);
    if (motion == nullptr) continue;
    REQUIRE(motion->samples.size() == 102);
    const auto time_s = [&](std::size_t i) { return motion->samples[i].time_s + 1e-9 * motion->samples[i].time_ns; };
    CHECK_THAT(time_s(101) - time_s(0), WithinAbs(1.01, 0.02));
    CHECK(std::abs(motion->samples[0].roll_deg) < 10);
  }
}
