#include "tools/topic/pretty.h"

#include <catch2/catch.hpp>

#include "messages/all.h"

namespace ensonify::topic_tool {

namespace {

template <class M>
std::string text_of(const M& message) {
  const msg::Body body = msg::encode(message);
  return message_text(msg::decode_value(body, body.size()), msg::find_type(M::kType));
}

}  // namespace

TEST_CASE("each field is shown with its unit, short lists on one line") {
  msg::Pose pose;
  pose.stamp_ns = 20'000'000;
  pose.position_enu_m = {1.5, -2.0, -10.25};
  CHECK(text_of(pose) ==
        "  stamp_ns: 20000000 ns\n"
        "  position_enu_m: [1.5, -2, -10.25] m\n"
        "  enu_from_body: [1, 0, 0, 0]\n"
        "  velocity_enu_mps: [0, 0, 0] m/s\n"
        "  rate_body_radps: [0, 0, 0] rad/s\n"
        "  acceleration_enu_mps2: [0, 0, 0] m/s^2\n"
        "  angular_acceleration_body_radps2: [0, 0, 0] rad/s^2\n");
}

TEST_CASE("a long array shows type, shape, both ends and the range of its values") {
  msg::Ping ping;
  ping.amplitude_upa = msg::Array<float>({2, 50});
  for (std::size_t i = 0; i < 100; ++i) ping.amplitude_upa[i] = static_cast<float>(i) * 0.5F;
  ping.beam_angle_rad = msg::Array<float>::of({-0.5F, 0.5F});
  const std::string text = text_of(ping);
  CHECK(text.find("  amplitude_upa: f4 [2, 50]: 0 0.5 1 ... 48.5 49 49.5 uPa (0 to 49.5)\n") != std::string::npos);
  CHECK(text.find("  beam_angle_rad: f4 [2]: -0.5 0.5 rad\n") != std::string::npos);
}

TEST_CASE("an empty array and a list of structs") {
  CHECK(text_of(msg::Ping{}).find("  amplitude_upa: f4 [") != std::string::npos);
  msg::Health health;
  health.message = "late";
  health.counters.push_back({"late_tile", 3});
  CHECK(
      text_of(health) ==
      "  stamp_ns: 0 ns\n  state: ok\n  message: late\n  counters:\n    [0]:\n      name: late_tile\n      count: 3\n");
}

TEST_CASE("a type that is not known is shown without units") {
  const msg::Body body =
      msg::encode(msg::Guidance{.stamp_ns = 5, .heading_grid_rad = 0.25, .speed_mps = 2.0, .depth_m = 8.0});
  CHECK(message_text(msg::decode_value(body, body.size()), nullptr) ==
        "  stamp_ns: 5\n  heading_grid_rad: 0.25\n  speed_mps: 2\n  depth_m: 8\n  vehicle: \n  hand_back: false\n");
}

TEST_CASE("a field is found by its path, and an element has the unit of its list") {
  const msg::TypeInfo* pose = msg::find_type("pose/1");
  REQUIRE(find_field(pose, "position_enu_m.2") != nullptr);
  CHECK(find_field(pose, "position_enu_m.2")->unit == "m");
  CHECK(find_field(pose, "position") == nullptr);
  REQUIRE(find_field(msg::find_type("health/1"), "counters.0.count") != nullptr);
  CHECK(find_field(msg::find_type("health/1"), "counters.0.count")->name == "count");
  CHECK(find_field(nullptr, "stamp_ns") == nullptr);
}

}  // namespace ensonify::topic_tool
