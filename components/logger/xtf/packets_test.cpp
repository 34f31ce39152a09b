#include "components/logger/xtf/packets.h"

#include <catch2/catch.hpp>
#include <limits>

#include "components/formats/utc.h"

using namespace ensonify;
using namespace ensonify::logger;

namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
/// 10 September 2025, 23:59:59.
const std::int64_t kEvening_ns = formats::unix_ns(20250910, 86'399'000);

}  // namespace

TEST_CASE("times are rounded to what a field can say, over midnight too") {
  XtfMoment at{.unix_ns = kEvening_ns + 996'000'000};
  const auto header = xtf_ping_header(at, {kEvening_ns}, 7, 1480.0, 0.0);
  CHECK(header.time == formats::xtf::Time{2025, 9, 11, 0, 0, 0});
  CHECK(header.hundredths == 0);
  CHECK(header.day_of_year == 253);  // days since 1 January: 10 September is 252
  CHECK(header.attitude_time_ms == 996);
  CHECK(header.fix_time == header.computer_time);
  CHECK(header.unix_ns() == kEvening_ns + kSecond_ns);
  const auto attitude = xtf_attitude(at, {kEvening_ns});
  CHECK(attitude.time_ms == header.attitude_time_ms);  // one clock
  CHECK(attitude.milliseconds == 996);
  CHECK(attitude.unix_ns() == at.unix_ns);
}

TEST_CASE("a ping says half the sound speed, knots, and decimetres above the seabed") {
  const XtfMoment at{.unix_ns = kEvening_ns,
                     .sensor_latitude_deg = 54.25,
                     .sensor_longitude_deg = 8.5,
                     .sensor_depth_m = 3.0,
                     .roll_deg = -2.0,
                     .heave_up_m = 0.25,
                     .speed_mps = 2.0};
  const auto header = xtf_ping_header(at, {kEvening_ns}, 7, 1480.0, 12.0);
  CHECK(header.half_sound_speed_mps == 740.0F);
  CHECK(header.sound_speed_mps() == 1480.0);
  CHECK(header.sensor_speed_kn == Approx(3.8877));
  CHECK(header.sensor_altitude_m == 12.0F);
  CHECK(header.ship_altitude_m.value() == Approx(15.0));
  CHECK(header.layback_m == 0.0F);
  CHECK(header.sensor_y == 54.25);
  CHECK(header.heave_m == 0.25F);
  CHECK(header.roll_deg == -2.0F);
}

TEST_CASE("every beam of a multibeam's ping is there, without a detection too") {
  msg::Soundings soundings;
  soundings.beam_angle_rad = msg::Array<float>({3});
  soundings.travel_time_s = msg::Array<float>({3});
  soundings.valid = msg::Array<std::uint8_t>({3});
  soundings.sector = msg::Array<std::uint8_t>({3});
  soundings.backscatter_strength_db = msg::Array<float>({3});
  for (std::size_t i = 0; i < 3; ++i) {
    soundings.beam_angle_rad[i] = static_cast<float>(i) - 1.0F;
    soundings.travel_time_s[i] = i == 1 ? std::numeric_limits<float>::quiet_NaN() : 0.04F;
    soundings.valid[i] = i == 1 ? 0 : 1;
    soundings.sector[i] = i == 2 ? 1 : 0;
    soundings.backscatter_strength_db[i] = -20.0F;
  }
  soundings.applied.sectors.resize(2);
  soundings.applied.sectors[1].tilt_rad = 0.1;
  soundings.applied.sectors[1].delay_s = 0.002;
  const auto ping = xtf_multibeam({}, soundings);
  REQUIRE(ping.beams.size() == 3);
  CHECK(ping.beams[0].angle_deg == Approx(-57.29578));
  CHECK(ping.beams[0].quality == 3);
  CHECK(ping.beams[1].quality == 0);
  CHECK(ping.beams[1].travel_time_s == 0.0);
  CHECK(ping.beams[2].travel_time_s == Approx(0.04));
  CHECK(ping.beams[2].tilt_deg == Approx(5.729578));
  CHECK(ping.beams[2].delay_s == 0.002);
}
