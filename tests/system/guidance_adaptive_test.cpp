// The adaptive survey of scenarios/slope_overlap: autopilot and coverage in closed loop with a kinematic boat, over the
// scenario's own seabed, the mission that of launch/adaptive.yaml. Soundings are geometry: 512 over 122 degrees, evenly
// spaced on level ground, that hit the seabed across the track.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "components/autopilot/testing/loop.h"
#include "components/config/config_reader.h"
#include "components/config/parse_yaml.h"
#include "components/coverage/node.h"
#include "components/terrain/source_of.h"

using namespace ensonify;
using piloted::BoatNode;
using runlines::Vec2;

namespace {

constexpr double kStep_m = 1.0;         // between the heights of the seabed that soundings are laid on
constexpr std::ptrdiff_t kReach = 160;  // such steps to either side
constexpr std::size_t kBeams = 512;
const double kSwath_rad = 122.0 * std::numbers::pi / 180.0;

/// The seabed of slope_overlap, and the adaptive survey of launch/adaptive.yaml over it.
struct Slope {
  static std::string file(const std::string& name) { return std::string(std::getenv("ENSONIFY_SOURCE")) + "/" + name; }
  static ConfigNode mission() {
    ConfigDocument launch = parse_config_file(file("launch/adaptive.yaml"));
    ConfigNode& mission = *launch.root.find("set")->find("mission");
    set_config_value(mission, "adaptive.width_m", ConfigNode::text("2900"));  // there an argument
    return mission;
  }

  World world = read_world(file("scenarios/slope_overlap/scenario.yaml"), {{"mission", mission()}});
  std::vector<float> depths_m;  // west to east, and so northward

  Slope() {
    const auto terrain = source::source_of({world.site, world.seabed, "", 1, {}});
    for (int north = -kHalfNorth; north <= kHalfNorth; ++north) {
      for (int east = -kHalfEast; east <= kHalfEast; ++east) {
        depths_m.push_back(static_cast<float>(-terrain->height_m(kStep_m * Vec2(east, north))));
      }
    }
  }
  static constexpr int kHalfEast = 1490, kHalfNorth = 80;
  /// The nearest post's; NaN beyond.
  double depth_m(const Vec2& place) const {
    const auto east = std::lround(place.x() / kStep_m), north = std::lround(place.y() / kStep_m);
    if (std::abs(east) > kHalfEast || std::abs(north) > kHalfNorth) return std::nan("");
    return depths_m[static_cast<std::size_t>((north + kHalfNorth) * (2 * kHalfEast + 1) + east + kHalfEast)];
  }
};

msg::Soundings sound(const Slope& slope, const motion::State& boat, SimTime now) {
  const Vec2 place = boat.position_enu_m.head<2>();
  const Vec2 starboard(std::cos(boat.heading_rad), -std::sin(boat.heading_rad));
  std::array<double, 2 * kReach + 1> depth_m;
  for (std::ptrdiff_t i = -kReach; i <= kReach; ++i) {
    depth_m[static_cast<std::size_t>(i + kReach)] = slope.depth_m(place + i * kStep_m * starboard);
  }
  msg::Soundings soundings;
  soundings.stamp_ns = now.count();
  soundings.valid = msg::Array<std::uint8_t>({kBeams});
  soundings.position_enu_m = msg::Array<double>({kBeams, 3});
  for (std::size_t beam = 0; beam < kBeams; ++beam) {
    const double tangent = ((static_cast<double>(beam) + 0.5) / kBeams * 2.0 - 1.0) * std::tan(0.5 * kSwath_rad);
    const double cotangent = 1.0 / std::abs(tangent);
    const int side = tangent < 0.0 ? -1 : 1;
    for (std::ptrdiff_t i = 0; i < kReach; ++i) {  // the first step in which the beam is at the seabed
      const double near_m = depth_m[static_cast<std::size_t>(kReach + side * i)];
      const double far_m = depth_m[static_cast<std::size_t>(kReach + side * (i + 1))];
      const double above_near_m = near_m - i * kStep_m * cotangent;
      const double above_far_m = far_m - (i + 1) * kStep_m * cotangent;
      if (std::isnan(near_m) || std::isnan(far_m)) break;
      if (above_far_m > 0.0) continue;
      const double part = above_near_m / (above_near_m - above_far_m);
      const double x_m = side * (i + part) * kStep_m;
      soundings.valid[beam] = 1;
      soundings.position_enu_m(beam, 0) = place.x() + x_m * starboard.x();
      soundings.position_enu_m(beam, 1) = place.y() + x_m * starboard.y();
      soundings.position_enu_m(beam, 2) = -(near_m + part * (far_m - near_m));
      break;
    }
  }
  return soundings;
}

/// A head that pings five times a second but in turns, its soundings by geometry from where the boat truly is.
class SounderNode {
 public:
  struct Config {
    const Slope& slope;
    const BoatNode& boat;
  };

  SounderNode(const Config& config, Ports& ports)
      : config_(config), soundings_(ports.out<msg::Soundings>("soundings", {.max_bytes = 65536, .rate = Rate{5, 1}})) {
    ports.in<msg::Estimate>("estimate", [](const msg::Estimate&) {});  // the boat has come as far as this head
    ports.in<msg::MissionState>("mission", [this](const msg::MissionState& mission) { state_ = mission.state; },
                                {.delay = 100_ms});
  }

  SimTime step(SimTime now) {
    if (!state_.empty() && state_ != "turn") soundings_.send(sound(config_.slope, config_.boat.at(now), now));
    return now + 200_ms;
  }

 private:
  Config config_;
  std::string state_;
  Ports::Out<msg::Soundings> soundings_;
};

/// Runs a mission over the slope while coverage observes, and, where the mission is adaptive, lays the lines. Returns
/// coverage's report.
nlohmann::json run_line(const Slope& slope, const World& surveyed) {
  auto empty = ConfigReader::from_text("{}", "test.yaml");
  const auto pilot_config = AutopilotConfig::read(empty, surveyed, "pilot");
  const auto coverage_config = CoverageConfig::read(empty, slope.world, "coverage");
  const auto folder = std::filesystem::temp_directory_path() / "ensonify_adaptive_test";
  std::filesystem::create_directories(folder);

  NodesUnderTest nodes;
  const auto& boat =
      nodes.add<BoatNode>("boat", {pilot_config.plan.limits, start_of(pilot_config.plan, surveyed.mission.runlines)});
  nodes.add<AutopilotNode>("pilot", pilot_config);
  nodes.add<SounderNode>("sounder", {slope, boat});
  const auto& coverage = nodes.add<CoverageNode>("coverage", coverage_config, folder);
  REQUIRE(nodes.run_until(14400_s));
  coverage.finish_run();
  std::ifstream stream(folder / "coverage.json");
  return nlohmann::json::parse(stream);
}

/// The same survey with so many lines at one distance, from the shallow side to the deep one.
World with_fixed_lines(const Slope& slope, std::size_t count) {
  World fixed = slope.world;
  const AdaptivePlan plan = *std::exchange(fixed.mission.adaptive, std::nullopt);
  fixed.mission.runlines.clear();
  for (std::size_t i = 0; i < count; ++i) {
    AdaptivePlan at = plan;
    at.first_line_m = plan.width_m * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    runlines::Runline line = first_line(at);
    if (i % 2 == 1) std::swap(line.start_enu_m, line.end_enu_m);
    fixed.mission.runlines.push_back(line);
  }
  fixed.mission.steps = steps_of(fixed.mission.runlines);
  return fixed;
}

}  // namespace

TEST_CASE("slope_overlap needs 45 % less track than fixed spacing, without gaps, near bound") {
  const Slope slope;
  const auto report = run_line(slope, slope.world);
  INFO(report.dump(2));
  CHECK(report["holes"] == 0);
  CHECK(report["covered"] == 1.0);
  CHECK(report["share_of_fixed"] <= 0.55);
  // All lines, those over holes too; fixed spacing and bound by one depth, the shallowest cell's.
  CHECK(report["bound"] == Approx(survey::adaptive_share(report["shallowest_m"], report["deepest_m"])));
  CHECK(report["share_of_fixed"] <= 1.15 * report["bound"].get<double>());
  CHECK(report["share_of_fixed"] > report["bound"]);

  // Lines at one distance are run too: as many as adaptive ones over 0.55 leave gaps, so what covers as
  // much takes more.
  const auto lines = report["lines"].get<double>();
  const auto wide = run_line(slope, with_fixed_lines(slope, static_cast<std::size_t>(lines / 0.55)));
  INFO(wide.dump(2));
  CHECK(wide["covered"] < 1.0);
}
