#include "tools/console/values.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "kernels/base/frames/attitude.h"
#include "messages/motion.h"
#include "messages/navigation.h"
#include "messages/soundings.h"

using namespace ensonify;
using namespace ensonify::console;
using Catch::Matchers::WithinAbs;

namespace {

template <msg::Message M>
msg::Packet packet_of(const std::string& topic, const M& message, std::uint64_t seq = 0) {
  msg::Packet packet{topic, {}, msg::encode(message), {}};
  packet.envelope.seq = seq;
  packet.envelope.epoch = 1;
  return packet;
}

const std::map<std::string, std::string> kTypes{
    {"nav/attitude", "attitude/1"}, {"boat/pose", "pose/1"}, {"bow/soundings", "soundings/1"}};

/// Rolls of 1, 2, 3 ... degrees at a rate; `left_out` are numbers of messages that do not come.
void roll(Values& values, int count, double rate_hz, const std::set<int>& left_out = {}) {
  for (int i = 0; i < count; ++i) {
    if (left_out.contains(i)) continue;
    msg::Attitude attitude;
    attitude.stamp_ns = static_cast<std::int64_t>(i / rate_hz * 1e9);
    attitude.roll_rad = (i + 1) * M_PI / 180.0;
    values.take("attitude/1", packet_of("nav/attitude", attitude, static_cast<std::uint64_t>(i)));
  }
}

msg::ConsoleSeries series_of(const Values& values, const std::string& name) {
  Values::Seen seen;
  const auto news = values.news({name}, seen);
  return news ? news->series.at(0) : msg::ConsoleSeries{};
}

}  // namespace

TEST_CASE("ten points a second are kept as they are, in degrees") {
  Values values;
  values.want({"nav/attitude.roll_rad"}, kTypes);
  CHECK(values.topics() == std::set<std::string>{"nav/attitude"});
  roll(values, 20, 10.0);
  const auto series = series_of(values, "nav/attitude.roll_rad");
  CHECK(series.unit == "deg");
  REQUIRE(series.value.size() == 20);
  for (std::size_t i = 0; i < 20; ++i) {
    CHECK_THAT(series.value[i], WithinAbs(static_cast<double>(i) + 1.0, 1e-9));
    CHECK_THAT(series.time_s[i], WithinAbs(0.1 * static_cast<double>(i), 1e-9));
  }
}

TEST_CASE("of a hundred a second the least and the greatest of 0.2 s are kept") {
  Values values;
  values.want({"nav/attitude.roll_rad"}, kTypes);
  roll(values, 101, 100.0);
  const auto series = series_of(values, "nav/attitude.roll_rad");
  REQUIRE(series.value.size() == 10);  // five slots of 0.2 s that are over
  CHECK_THAT(series.value[0], WithinAbs(1.0, 1e-9));
  CHECK_THAT(series.value[1], WithinAbs(20.0, 1e-9));
  CHECK_THAT(series.value[9], WithinAbs(100.0, 1e-9));
}

TEST_CASE("a message that was lost and a long silence are points without a value") {
  Values values;
  values.want({"nav/attitude.roll_rad"}, kTypes);
  roll(values, 20, 5.0, {7});
  const auto lost = series_of(values, "nav/attitude.roll_rad");
  REQUIRE(lost.value.size() == 20);
  CHECK(std::isnan(lost.value[7]));
  CHECK_THAT(lost.time_s[7], WithinAbs(1.4, 1e-9));

  Values silent;
  silent.want({"boat/pose.depth_m"}, kTypes);
  for (const double time_s : {0.0, 0.2, 0.4, 3.0, 3.2}) {
    msg::Pose pose;
    pose.stamp_ns = static_cast<std::int64_t>(time_s * 1e9);
    pose.position_enu_m[2] = -time_s;
    silent.take("pose/1", packet_of("boat/pose", pose,
                                    static_cast<std::uint64_t>(time_s * 5.0 > 3 ? time_s * 5 - 12 : time_s * 5)));
  }
  const auto series = series_of(silent, "boat/pose.depth_m");
  REQUIRE(series.value.size() == 6);
  CHECK(std::isnan(series.value[3]));
  CHECK_THAT(series.value[4], WithinAbs(3.0, 1e-9));
}

TEST_CASE("ten minutes are kept, and who comes late gets them in pieces") {
  Values values;
  values.want({"nav/attitude.roll_rad"}, kTypes);
  roll(values, 10'000, 10.0);
  Values::Seen seen;
  std::size_t count = 0;
  std::int64_t next = -1;
  while (const auto news = values.news({"nav/attitude.roll_rad"}, seen)) {
    const auto& series = news->series.at(0);
    CHECK(series.value.size() <= Values::kMostPoints);
    if (next >= 0) CHECK(series.first == next);
    next = series.first + static_cast<std::int64_t>(series.value.size());
    count += series.value.size();
  }
  CHECK(count == 6001);
}

TEST_CASE("heading, roll, pitch, speed and depth follow from a pose") {
  msg::Pose pose;
  pose.enu_from_body = frames::wxyz_of(frames::enu_from_body({2.0, 0.1, -0.2}));
  pose.velocity_enu_mps = {3.0, 4.0, 5.0};
  pose.position_enu_m = {1.0, 2.0, -7.5};
  const msg::Value value = msg::to_value(pose);
  LastPing last;
  const auto of = [&](const char* field) { return scalar_in(value, "pose/1", field, last); };
  CHECK_THAT(of("heading_grid_rad"), WithinAbs(2.0 * 180 / M_PI, 1e-9));
  CHECK_THAT(of("pitch_rad"), WithinAbs(0.1 * 180 / M_PI, 1e-9));
  CHECK_THAT(of("roll_rad"), WithinAbs(-0.2 * 180 / M_PI, 1e-9));
  CHECK_THAT(of("speed_mps"), WithinAbs(5.0, 1e-9));
  CHECK_THAT(of("depth_m"), WithinAbs(7.5, 1e-9));
  CHECK_THAT(of("position_enu_m.1"), WithinAbs(2.0, 1e-9));
}

TEST_CASE("a ping's depth is that of the valid sounding nearest to the axis, its rate that of its number") {
  Values values;
  values.want({"bow/soundings.depth_m", "bow/soundings.pings_per_s"}, kTypes);
  for (int i = 0; i < 3; ++i) {
    msg::Soundings soundings;
    soundings.stamp_ns = i * 500'000'000;
    soundings.ping = 4 * i;  // three of four pings are left out
    soundings.valid = msg::Array<std::uint8_t>::of({1, 0, 1});
    soundings.beam_angle_rad = msg::Array<float>::of({-0.5F, 0.0F, 0.4F});
    soundings.position_enu_m = msg::Array<double>({3, 3});
    for (std::size_t k = 0; k < 3; ++k) soundings.position_enu_m(k, 2) = -20.0 - static_cast<double>(k);
    values.take("soundings/1", packet_of("bow/soundings", soundings, static_cast<std::uint64_t>(i)));
  }
  const auto depth = series_of(values, "bow/soundings.depth_m");
  REQUIRE(depth.value.size() == 3);
  CHECK_THAT(depth.value[2], WithinAbs(22.0, 1e-9));
  const auto rate = series_of(values, "bow/soundings.pings_per_s");
  REQUIRE(rate.value.size() == 3);
  CHECK(std::isnan(rate.value[0]));
  CHECK_THAT(rate.value[2], WithinAbs(8.0, 1e-9));
  CHECK(rate.unit == "Hz");
}

TEST_CASE("a measurement that is not valid has no value") {
  msg::Altitude altitude;
  altitude.range_m = 12.0;
  LastPing last;
  CHECK(std::isnan(scalar_in(msg::to_value(altitude), "altitude/1", "range_m", last)));
  altitude.valid = true;
  CHECK(scalar_in(msg::to_value(altitude), "altitude/1", "range_m", last) == 12.0);
  CHECK(scalar_in(msg::to_value(altitude), "altitude/1", "valid", last) == 1.0);
  CHECK(scalars_of("unknown/7").empty());
}

TEST_CASE("another run voids the points of the one before") {
  Values values;
  values.want({"nav/attitude.roll_rad"}, kTypes);
  roll(values, 5, 10.0);
  Values::Seen seen;
  REQUIRE(values.news({"nav/attitude.roll_rad"}, seen));
  values.clear();
  roll(values, 3, 10.0);
  const auto news = values.news({"nav/attitude.roll_rad"}, seen);
  REQUIRE(news);
  CHECK(news->generation == 2);
  CHECK(news->series.at(0).first == 0);
  CHECK(news->series.at(0).value.size() == 3);
}
