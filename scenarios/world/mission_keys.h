#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "components/config/config_reader.h"
#include "scenarios/world/mission.h"

/// A mission as a file has it.
namespace ensonify {

struct RunlineKeys {
  runlines::Vec2 from = runlines::Vec2::Zero(), to = runlines::Vec2::Zero();

  static void parameters(auto& self, auto&& visit) {
    visit("from_m", "", must(place()), "start of the line, as positions says", self.from);
    visit("to_m", "", must(place()), "end of the line, as positions says", self.to);
  }
};

struct LawnmowerKeys {
  std::optional<runlines::Vec2> centre;
  double heading_rad = 0.0, length_m = 0.0, spacing_m = 0.0;
  int count = 0;

  static void parameters(auto& self, auto&& visit) {
    visit("centre_m", "", place(), "middle of all lines, as positions says; left out: the origin", self.centre);
    visit("heading_deg", "deg", in(-360, 360), "heading of the first line", self.heading_rad);
    visit("length_m", "m", must(in(1, kFarAway_m)), "length of a line", self.length_m);
    visit("spacing_m", "m", must(in(0.1, kFarAway_m)), "spacing from line to line", self.spacing_m);
    visit("count", "", must(in(1, 1000)), "number of lines", self.count);
  }
};

// --- plans, of which a mission has one ------------------------------------------------------------------------------

struct RunlinesPlan {
  std::vector<RunlineKeys> runlines;
  static void parameters(auto& self, auto&& visit) {
    visit("runlines", "straight lines in their order", self.runlines);
  }
};
struct LawnmowerPlan {
  LawnmowerKeys lawnmower;
  static void parameters(auto& self, auto&& visit) { visit("lawnmower", "parallel lines, to and fro", self.lawnmower); }
};
struct PlanOfRaster {
  AutoPlan plan;
  static void parameters(auto& self, auto&& visit) { visit("auto", "lines laid over an imported raster", self.plan); }
};
struct PlanOfCoverage {
  AdaptivePlan plan;
  static void parameters(auto& self, auto&& visit) {
    visit("adaptive", "parallel lines over a rectangle, each laid where the coverage so far ends", self.plan);
  }
};
struct PlanOfTrack {
  FollowTrack plan;
  static void parameters(auto& self, auto&& visit) { visit("follow", "a recorded track, gone along again", self.plan); }
};
struct StepsPlan {
  std::vector<MissionStep> steps;
  static void parameters(auto& self, auto&& visit) { visit("steps", "list of what is done, in order", self.steps); }
};
/// Another file has it.
struct NoPlan {
  static void parameters(auto&, auto&&) {}
};

/// `mission:` of a scenario; its keys may stand in a file of their own (`file:`), mission/1, and then some of them here
/// as well: those count. Places are metres in the world, or with `positions: geodetic` degrees [latitude, longitude];
/// what lies farther than 100 km from `origin` is a problem, which says if latitude and longitude look swapped. Without
/// an origin (it comes from a raster) geodetic places are a problem.
struct MissionKeys {
  using Plan = std::variant<RunlinesPlan, LawnmowerPlan, PlanOfRaster, PlanOfCoverage, PlanOfTrack, StepsPlan, NoPlan>;

  bool in_scenario = true;  // else in a file of its own
  bool geodetic = false;
  Mission values;  // what has one value
  Plan plan = NoPlan{};
  std::string file;

  static void parameters(auto& self, auto&& visit) {
    visit("positions", "", one_of({{"metres", false}, {"geodetic", true}}),
          "places are [east, north] from the site's origin, or [latitude, longitude] in degrees", self.geodetic);
    Mission::parameters(self.values, visit);
    visit(one_form("", ""), self.plan);
    // What it holds is among the other keys once it has been read.
    if (self.in_scenario)
      visit("file", "", again(path()), "a mission of its own, mission/1; what stands beside it counts", self.file);
  }
  void read_base(ConfigReader& from);
  void complete(ConfigReader& from);
  /// Makes metres of places; what is wrong with them, and with the whole, is added to what it was read from.
  Mission mission(const std::optional<frames::Geodetic>& origin) const;

 private:
  int plans_ = 0;  // in both files
  bool plan_geodetic_ = false;
  std::optional<ConfigReader> from_, plan_from_;  // the scenario's section, and what has the plan
};

}  // namespace ensonify
