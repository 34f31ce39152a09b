#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "components/sonar/testing/ping.h"
#include "components/sonar/testing/seabed.h"
#include "components/sonar/tile_set.h"
#include "tests/physics/heads.h"
#include "tests/physics/heads_found.h"

// Heads as values, without their nodes.

using namespace ensonify;
using namespace ensonify::physics;

namespace {

template <class Node>
struct HeadOf;
template <class Head>
struct HeadOf<HeadNode<Head>> {
  using Type = Head;
};

/// Each setting in turn that a command can change and a design may depend on, far from where it starts.
std::vector<HeadSettings> other_settings(const HeadInputs::Channel& channel) {
  std::vector<HeadSettings> all;
  for (const auto& [name, member] :
       {std::pair{"range_m", &HeadSettings::range_m}, std::pair{"pulse_length_s", &HeadSettings::pulse_length_s},
        std::pair{"swath_rad", &HeadSettings::swath_rad}}) {
    const SettingLimit* limit = channel.limits.find(name);
    if (limit == nullptr || limit->least == limit->most) continue;
    HeadSettings& other = all.emplace_back(channel.settings);
    const double middle = std::lerp(limit->least, limit->most, 0.4);
    other.*member = middle == channel.settings.*member ? limit->most : middle;
    other.auto_range = false;
  }
  return all;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a head's image depends on its own settings, not on those of pings before", "", HeadsFound) {
  using Head = typename HeadOf<TestType>::Type;
  INFO(TestType::kComponent);
  World world = world_with("head");
  world.seabed.sediments = {{0, seabed::Lambert{-25.0}}};
  const auto config = config_of<TestType>("quality: 0.05\n", world, "head");
  TileSet tiles;
  tiles.insert(tile_of(128.0, 1.0, [](double east, double) { return -12.0 + std::sin(0.3 * east); }));
  frames::PoseHistory truth(1'000'000'000);
  truth.push(0, {{0.0, 0.0, -2.0}, frames::enu_from_ned()});
  const Surroundings surroundings = around(truth, tiles.scene());

  const HeadInputs::Channel channel = Head::plan(config).channels.front();
  HeadSettings settings = channel.settings;
  settings.auto_range = false;
  settings.range_m = std::min(settings.range_m, 30.0);
  const auto image = [&](Head& head, const HeadSettings& with) {
    return image_of(head, {3, SimTime{0}, std::min(with.range_m, 40.0)}, with, surroundings).amplitude_upa;
  };
  Head fresh(config, 0);
  const auto alone = image(fresh, settings);
  CHECK(std::ranges::any_of(alone.flat(), [](float amplitude) { return amplitude > 0.0F; }));
  const auto others = other_settings(channel);
  REQUIRE_FALSE(others.empty());
  for (const HeadSettings& other : others) {
    Head head(config, 0);
    INFO("range " << other.range_m << ", pulse " << other.pulse_length_s << ", swath " << other.swath_rad);
    CHECK_FALSE(image(head, other) == alone);
    CHECK(image(head, settings) == alone);
  }
}
