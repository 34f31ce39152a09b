#include "components/sonar/ping_pictures.h"

#include <catch2/catch.hpp>
#include <vector>

#include "components/view/ping_view.h"

using namespace ensonify;

namespace {

msg::Ping ping_of(std::size_t beams) {
  msg::Ping ping;
  ping.sample_period_s = 1e-4;
  ping.applied.sound_speed_mps = 1500.0;
  ping.beam_angle_rad = msg::Array<float>({beams});
  ping.amplitude_upa = msg::Array<float>({beams, 50});
  for (float& value : ping.amplitude_upa.flat()) value = 100.0F;
  return ping;
}

/// Pictures with the live plane under the test's control.
struct Scene {
  Ports ports{"bow"};
  PingPictures pictures{ports, "view", 1 << 16, "forward"};
  bool watched = true;
  bool late = false;
  std::vector<msg::View> seen;

  Scene() {
    ports.connect(
        {}, {}, [](std::size_t, msg::Body, const msg::Buffer&) {},
        {[this](std::size_t) { return watched; },
         [this](std::size_t, const msg::Body& body) { seen.push_back(msg::decode<msg::View>(body, body.size())); },
         [this] { return late; }});
  }
  bool offer(const msg::Ping& ping, const msg::Soundings* soundings = nullptr) {
    if (!pictures.wanted()) return false;
    pictures.show(ping, soundings);
    return true;
  }
};

}  // namespace

TEST_CASE("a picture is made only while somebody watches, and not where nobody can") {
  Scene scene;
  scene.watched = false;
  CHECK_FALSE(scene.offer(ping_of(2)));
  scene.watched = true;
  CHECK(scene.offer(ping_of(2)));
  REQUIRE(scene.seen.size() == 1);
  CHECK(scene.seen[0].beam_axis == "forward");
  Ports alone("bow");
  PingPictures none(alone, "view", 100, "down");
  CHECK_FALSE(none.wanted());
}

TEST_CASE("fans come at most 30 times a second of wall time, lines with every ping") {
  Scene fan;
  const auto begin = std::chrono::steady_clock::now();
  int shown = 0;
  for (int i = 0; i < 1000; ++i) shown += fan.offer(ping_of(3)) ? 1 : 0;
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  CHECK(shown <= 1 + static_cast<int>(took.count() * PingPictures::kMostPerSecond));
  Scene line;
  for (int i = 0; i < 100; ++i) CHECK(line.offer(ping_of(2)));
}

TEST_CASE("while the run waits for the head there are no pictures, and they are counted") {
  Scene scene;
  scene.offer(ping_of(2));
  scene.late = true;
  for (int i = 0; i < 3; ++i) CHECK_FALSE(scene.offer(ping_of(2)));
  scene.late = false;
  CHECK(scene.offer(ping_of(2)));
  REQUIRE(scene.seen.size() == 2);
  CHECK(scene.seen[0].left_out == 0);
  CHECK(scene.seen[1].left_out == 3);
}

TEST_CASE("a ping without samples shows nothing, and one with soundings its detections") {
  Scene scene;
  msg::Ping empty = ping_of(2);
  empty.amplitude_upa = {};
  scene.offer(empty);
  CHECK(scene.seen.empty());
  msg::Soundings soundings;
  soundings.valid = msg::Array<std::uint8_t>::of({1});
  soundings.beam_angle_rad = msg::Array<float>::of({0.1F});
  soundings.travel_time_s = msg::Array<float>::of({0.01F});
  soundings.applied.sound_speed_mps = 1500.0;
  scene.offer(ping_of(2), &soundings);
  REQUIRE(scene.seen.size() == 1);
  CHECK(scene.seen[0].find_range_m.size() == 1);
}
