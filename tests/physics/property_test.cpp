#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "components/sonar/testing/random_head.h"
#include "components/sonar/testing/seabed.h"
#include "tests/physics/heads.h"
#include "tests/physics/heads_found.h"

// Laws that hold for any legal head, at any place, over any seabed: random ones, always the same.

using namespace ensonify;
using namespace ensonify::physics;

namespace {

World random_world(Draws& draw) {
  World world = world_with("head");
  Water& water = world.water;
  water.temperature_degc = draw.between(-2, 30);
  water.salinity_psu = draw.between(0, 40);
  water.wind_speed_mps = draw.yes() ? 0.0 : draw.between(0, 20);
  if (draw.yes()) {
    water.profile.samples = {{0.0, draw.between(1450, 1540), {}, {}},
                             {draw.between(1, 8), draw.between(1450, 1540), {}, {}},
                             {draw.between(9, 30), draw.between(1450, 1540), {}, {}}};
  }
  if (draw.yes()) water.scattering_layers = {{draw.between(0, 5), draw.between(6, 30), draw.between(-90, -40)}};
  if (draw.yes()) water.bubble_loss_db = draw.between(0, 20);
  const auto sediments = seabed::named_sediments();
  world.seabed.sediments = {{0, sediments[static_cast<std::size_t>(draw.whole(0, 13))].parameters},
                            {1, seabed::Lambert{draw.between(-40, -5)}},
                            {2, *seabed::material_of("rigid")}};
  return world;
}

constexpr double kTile_m = 32.0, kPosts_m = 0.5;

/// Waves, steps, boxes with sheer walls, holes, three classes.
msg::Tile random_seabed(Draws& draw) {
  const double depth = draw.between(5, 15), swell = draw.between(0, 2), length = draw.between(2, 20);
  const double box_m = draw.between(0, 6), every = draw.between(3, 12), hole = draw.yes() ? draw.between(0, 8) : 0.0;
  msg::Tile tile = tile_of(kTile_m, kPosts_m, [&](double east, double north) {
    if (std::hypot(east - 6.0, north + 5.0) < hole) return std::nan("");
    const bool box = std::fmod(std::abs(east), every) < 1.5 && std::fmod(std::abs(north), every) < 1.5;
    return -depth + swell * std::sin(6.28 * (east + 0.3 * north) / length) + (box ? box_m : 0.0);
  });
  for (std::size_t i = 0; i < tile.sediment.size(); ++i) tile.sediment.flat()[i] = static_cast<std::uint8_t>(i / 7 % 4);
  return tile;
}

/// Anywhere and anyhow; in turn above the water, on a post to the bit, half a millimetre above one, inside a box, below
/// everything, at the tile's edge.
Course random_course(Draws& draw, const msg::Tile& tile, int number) {
  Course course;
  const auto post = static_cast<std::size_t>(draw.whole(0, 64)), row = static_cast<std::size_t>(draw.whole(0, 64));
  const double height = tile.height_m(row, post);
  const frames::Vec3 on_post(-0.5 * kTile_m + kPosts_m * double(post), -0.5 * kTile_m + kPosts_m * double(row),
                             std::isnan(height) ? -9.0 : height);
  course.start_enu_m = {draw.between(-12, 12), draw.between(-12, 12), draw.between(-8, 0)};
  switch (number % 8) {
    case 0: course.start_enu_m.z() = draw.between(0, 4); break;
    case 1: course.start_enu_m = on_post; break;
    case 2: course.start_enu_m = on_post + frames::Vec3(0, 0, 5e-4); break;
    case 3: course.start_enu_m = on_post - frames::Vec3(0, 0, 0.7); break;
    case 4: course.start_enu_m.z() = -40.0; break;
    case 5: course.start_enu_m.x() = 0.5 * kTile_m; break;
    default: break;
  }
  if (draw.yes()) course.velocity_enu_mps = {draw.between(-10, 10), draw.between(-10, 10), draw.between(-1, 1)};
  if (draw.yes()) {
    course.enu_from_body = frames::enu_from_body({.heading_rad = draw.between(0, 6.28),
                                                  .pitch_rad = draw.between(-1.57, 1.57),
                                                  .roll_rad = draw.between(-3, 3)});
  }
  return course;
}

/// What a head publishes in the time of two pings.
struct Run {
  std::vector<msg::Ping> pings;
  std::vector<msg::Soundings> soundings;
  std::vector<msg::SeabedImage> images;
  std::vector<msg::Health> health;
};

template <class Node>
Run run(const std::string& yaml, Draws& draw, int number) {
  const World world = random_world(draw);
  const msg::Tile tile = random_seabed(draw);
  const Course course = random_course(draw, tile, number);
  NodeUnderTest<Node> head(config_of<Node>(yaml, world, "head"));
  give_course(head, course, 300_ms);
  head.give("tile", tile);
  head.run_until(300_ms);
  Run run;
  for (const OutPort& out : head.ports().outs()) {
    if (out.type != msg::Ping::kType) continue;
    std::ranges::move(head.template step_until<msg::Ping>(out.port, 300_ms), std::back_inserter(run.pings));
  }
  run.soundings = head.template step_until<msg::Soundings>("soundings", 300_ms);
  run.images = head.template step_until<msg::SeabedImage>("seabed_image", 300_ms);
  run.health = head.template step_until<msg::Health>("health", 300_ms);
  return run;
}

int check_finite(const Run& run) {
  for (const msg::Ping& ping : run.pings) {
    for (const float a : ping.amplitude_upa.flat()) REQUIRE(std::isfinite(a));
    for (const float angle : ping.beam_angle_rad.flat()) REQUIRE(std::isfinite(angle));
    for (const float phase : ping.phase_rad.flat()) REQUIRE(std::isfinite(phase));
    CHECK(ping.amplitude_upa.size() + ping.amplitude_count.size() > 0);
  }
  for (const msg::Soundings& s : run.soundings) {
    for (std::size_t i = 0; i < s.valid.size(); ++i) {
      if (s.valid[i] == 0) continue;
      REQUIRE(std::isfinite(s.travel_time_s[i]));
      for (const auto* values : {&s.backscatter_db, &s.backscatter_strength_db, &s.quality_db, &s.range_sd_m,
                                 &s.angle_sd_rad, &s.window_s}) {
        if (values->size() > 0) REQUIRE(std::isfinite((*values)[i]));
      }
      for (std::size_t axis = 0; axis < 3; ++axis) REQUIRE(std::isfinite(s.position_enu_m(i, axis)));
    }
  }
  for (const msg::SeabedImage& image : run.images) {
    for (const float strength : image.strength_db.flat()) REQUIRE(std::isfinite(strength));
  }
  REQUIRE_FALSE(run.health.empty());
  return static_cast<int>(run.pings.size());
}

constexpr int kCases = 24;

/// Of `kCases` random heads of a kind: how many pings they made.
template <class Node>
int all_finite() {
  int pings = 0;
  for (int number = 0; number < kCases; ++number) {
    Draws draw(static_cast<std::uint64_t>(number));
    const std::string yaml = RandomParameters<Node>::yaml(draw);
    INFO("case " << number << "\n" << yaml);
    pings += check_finite(run<Node>(yaml, draw, number));
  }
  return pings;
}

}  // namespace

// Half of the cases, or more, must have something to say for the check to mean anything: some have no tile below.
TEMPLATE_LIST_TEST_CASE("no head makes a number that is none", "", HeadsFound) {
  INFO(TestType::kComponent);
  CHECK(all_finite<TestType>() > kCases);
}

namespace {

template <class M>
bool same_bits(const M& a, const M& b) {
  const msg::Body one = msg::encode(a), two = msg::encode(b);
  return msg::same_bytes(one.map, two.map) && std::ranges::equal(one.arrays, two.arrays, msg::same_bytes);
}

/// The same random head with one thread and with two.
template <class Node>
void check_threads() {
  for (const int number : {6, 7, 14}) {  // heads in the water
    const auto with = [&](std::size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      Draws draw(static_cast<std::uint64_t>(number));
      const std::string yaml = RandomParameters<Node>::yaml(draw);
      return run<Node>(yaml, draw, number);
    };
    const Run one = with(1), two = with(2);
    INFO("case " << number);
    REQUIRE(one.pings.size() == two.pings.size());
    for (std::size_t i = 0; i < one.pings.size(); ++i) CHECK(same_bits(one.pings[i], two.pings[i]));
    REQUIRE(one.soundings.size() == two.soundings.size());
    for (std::size_t i = 0; i < one.soundings.size(); ++i) CHECK(same_bits(one.soundings[i], two.soundings[i]));
  }
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a head makes the same bits with one thread and with two", "", HeadsFound) {
  INFO(TestType::kComponent);
  check_threads<TestType>();
}
