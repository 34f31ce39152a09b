#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "components/config/parameters.h"
#include "kernels/base/frames/local_projection.h"
#include "kernels/base/frames/pose.h"
#include "kernels/vehicle/motion/kinematics.h"
#include "kernels/vehicle/runlines/runline.h"
#include "messages/sonar.h"
#include "scenarios/world/sonar_settings.h"

namespace ensonify {

class ConfigReader;

inline constexpr double kFarAway_m = 100e3;  // nothing in a world is farther from its origin
inline constexpr double kShortest_m = 1.0;   // less is no line

/// Places as the file has them, in metres of the world or, as `positions` says, in degrees; MissionKeys::mission()
/// makes metres of them.
inline Allowed place() { return in(-kFarAway_m, kFarAway_m); }

/// `auto` in the file: runlines laid over an imported raster by whoever can read it.
struct AutoPlan {
  int count = 5;
  double longest_m = 500.0;
  double overlap = 0.2;
  double swath_rad = 2.2689280275926;  // 130 deg
  std::optional<double> spacing_m;
  std::optional<double> heading_rad;

  static void parameters(auto& self, auto&& visit) {
    visit("count", "", in(1, 1000), "number of lines", self.count);
    visit("longest_m", "m", in(1, kFarAway_m), "a line is not longer", self.longest_m);
    visit("overlap", "", in(0, 0.95), "overlap of neighbouring swaths", self.overlap);
    visit("swath_deg", "deg", in(1, 170), "full angle of the swath, from which the spacing follows", self.swath_rad);
    visit("spacing_m", "m", in(0.1, kFarAway_m), "spacing of lines, instead of the overlap", self.spacing_m);
    visit("heading_deg", "deg", in(-360, 360), "heading of the lines, instead of along the longer side of the data",
          self.heading_rad);
  }
};

/// `adaptive` in the file: parallel lines over a rectangle, each laid where the coverage so far ends.
struct AdaptivePlan {
  runlines::Vec2 centre_enu_m = runlines::Vec2::Zero();
  double heading_rad = 0.0;
  double length_m = 100.0;
  double width_m = 100.0;
  double first_line_m = 0.0;
  double swath_rad = 2.0943951023932;  // 120 deg
  double overlap = 0.1;
  double cell_m = 4.0;
  int soundings = 9;

  void check(const ConfigReader& from) const;
  static void parameters(auto& self, auto&& visit) {
    visit("centre_m", "", must(place()), "middle of the rectangle, as positions says", self.centre_enu_m);
    visit("heading_deg", "deg", in(-360, 360), "heading of the first line; the survey goes on to starboard of it",
          self.heading_rad);
    visit("length_m", "m", must(in(kShortest_m, kFarAway_m)), "length of a line", self.length_m);
    visit("width_m", "m", must(in(1, kFarAway_m)), "width of the rectangle, across the lines", self.width_m);
    visit("first_line_m", "m", must(in(0, kFarAway_m)), "distance of the first line from the rectangle's port edge",
          self.first_line_m);
    visit("swath_deg", "deg", in(10, 160), "full angle of the swath that counts", self.swath_rad);
    visit("overlap", "", in(0, 0.9), "overlap of a half swath with what is covered", self.overlap);
    visit("cell_m", "m", in(0.1, 1000), "side of a cell of the coverage", self.cell_m);
    visit("soundings", "", in(1, 10000), "accepted ones that a covered cell has at least", self.soundings);
  }
};

/// `follow` in the file: a track that was recorded, gone along again.
struct FollowTrack {
  enum class Attitude { kRecorded, kModelled };
  enum class Height { kRecorded, kWater };

  std::string file;
  std::string topic;    // of a record; "": the only one with poses
  std::string vehicle;  // "": the only one, or the only one without a start
  double from_s = 0.0;
  std::optional<double> to_s;
  std::optional<Attitude> attitude;  // not given: recorded, where the file has it
  std::optional<Height> height;      // the same
  double longest_gap_s = 10.0;
  frames::Vec3 position_body_m = frames::Vec3::Zero();
  ConfigProblem here;  // where `file` stands, for what is found when it is read
  static constexpr const char* kShort = "file";

  void check(const ConfigReader& from) const;
  void complete(ConfigReader& from);
  static void parameters(auto& self, auto&& visit) {
    visit("file", "", must(path()), "the record: CSV, a log of NMEA lines, an MCAP record, .all, .kmall or XTF",
          self.file);
    visit("topic", "", any(), "topic of an MCAP record, of poses or estimates; \"\": the only one of poses",
          self.topic);
    visit("vehicle", "", any(), "vehicle that follows; \"\": the only one, or the only one without a start",
          self.vehicle);
    visit("from_s", "s", in(0, 1e9), "beginning of the part that is followed, from the track's first place on",
          self.from_s);
    visit("to_s", "s", in(0, 1e9), "end of the part that is followed; left out: the track's end", self.to_s);
    visit("attitude", "", one_of({{"recorded", Attitude::kRecorded}, {"modelled", Attitude::kModelled}}),
          "roll, pitch and heave: the file's, or those of the vehicle's model; left out: the file's where it has any",
          self.attitude);
    visit("height", "", one_of({{"recorded", Height::kRecorded}, {"water", Height::kWater}}),
          "height of the vehicle: the file's, or from the water level; left out: the file's where it has one",
          self.height);
    visit("longest_gap_s", "s", in(0.01, 3600), "time without a sample that is bridged; longer ones are refused",
          self.longest_gap_s);
    visit("position_m", "m", in(-500, 500),
          "the place on the body whose track it is: forward, starboard, down (an antenna's third number is negative)",
          self.position_body_m);
  }
};

// --- the steps of a mission, in the order run -------------------------------------------------------------------

// The first parameter of each is the key by which a step is known; GoAt is what has none of them.

/// A line through two places or more, with run-in and run-out.
struct FollowLine {
  std::vector<runlines::Vec2> points_enu_m;
  std::string name = {};

  static void parameters(auto& self, auto&& visit) {
    visit("line", "", must(place()), "two places or more, run through with run-in and run-out", self.points_enu_m);
    visit("name", "", any(), "name of the line, as mission_state/1 reports it", self.name);
  }
};
/// Pass through a place, on a heading where one is given.
struct PassPlace {
  runlines::Vec2 place_enu_m;
  std::optional<double> heading_rad;

  static void parameters(auto& self, auto&& visit) {
    visit("pass", "", must(place()), "a place that is passed through, as positions says", self.place_enu_m);
    visit("heading_deg", "deg", in(-360, 360), "heading there; left out: any", self.heading_rad);
  }
};
/// Go to a place (not given: where the vehicle is), stop and stay there.
struct KeepPlace {
  std::optional<runlines::Vec2> place_enu_m;
  double for_s = 0.0;
  double within_m = 5.0;

  /// Two forms of step have this type, by whether there is a place before one is read.
  static void parameters(auto& self, auto&& visit) {
    if (self.place_enu_m) {
      visit("keep", "", must(place()), "a place to stop and stay at, as positions says", *self.place_enu_m);
      visit("for_s", "s", must(in(0, 1e6)), "time that the vehicle stays at the position", self.for_s);
    } else {
      visit("wait_s", "s", must(in(0, 1e6)), "time that the vehicle stays where it is", self.for_s);
    }
    visit("within_m", "m", in(0.5, 1000), "distance from the position within which the vehicle stays", self.within_m);
  }
};
struct FollowOrbit {
  runlines::Vec2 centre_enu_m;
  double radius_m = 0.0;
  double turns = 1.0;
  bool clockwise = true;

  static void parameters(auto& self, auto&& visit) {
    visit("orbit", "", must(place()), "centre of a circle, as positions says", self.centre_enu_m);
    visit("radius_m", "m", must(in(1, 10000)), "radius of the orbit", self.radius_m);
    visit("turns", "", in(0.05, 1000), "number of rounds", self.turns);
    visit("centre_to", "", one_of({{"starboard", true}, {"port", false}}), "side on which the centre lies",
          self.clockwise);
  }
};
/// Speed and depth from here on; what is not given stays. A depth ends an altitude and the other way round.
struct GoAt {
  std::optional<double> speed_mps, depth_m, altitude_m;

  void check(const ConfigReader& from) const;
  static void parameters(auto& self, auto&& visit) {
    visit("speed_mps", "m/s", in(0.01, 30), "speed from here on", self.speed_mps);
    visit("depth_m", "m", in(0, 11000), "depth from here on, below the water level", self.depth_m);
    visit("altitude_m", "m", in(0.5, 1000), "altitude above the bottom from here on", self.altitude_m);
  }
};
/// A command to a head. `given` has the place in the file of `set_sonar` and of each field that is set.
struct SetSonar {
  std::string head;
  msg::SonarSettings settings;
  std::map<std::string, ConfigProblem> given;

  static void parameters(auto& self, auto&& visit) {
    visit("set_sonar", "", must(any()), "the head", self.head);
    setting_parameters(self.settings, visit, [&](const char* name) { return self.given.contains(name); });
  }
  void complete(ConfigReader& from);
};
struct SetMark {
  std::string text;

  static void parameters(auto& self, auto&& visit) {
    visit("mark", "", must(any()), "text of a mark in the record", self.text);
  }
};
using MissionStep = std::variant<FollowLine, PassPlace, KeepPlace, FollowOrbit, GoAt, SetSonar, SetMark>;

/// A step with a place is another form than one without; the last has no key of its own.
template <>
struct FormsOf<MissionStep> {
  static std::vector<MissionStep> all() {
    return {FollowLine{},
            PassPlace{runlines::Vec2::Zero(), {}},
            KeepPlace{runlines::Vec2(0, 0)},
            KeepPlace{},
            FollowOrbit{runlines::Vec2::Zero()},
            SetSonar{},
            SetMark{},
            GoAt{}};
  }
};

/// Rules for giving a mission up: come to the surface, stop and end the run. Not given: never.
struct AbortRules {
  std::optional<double> after_s;  // of sim time
  std::optional<double> position_sd_m;
  std::optional<double> too_low_s;

  static void parameters(auto& self, auto&& visit) {
    visit("after_s", "s", in(0, 1e9), "time after the start of the run", self.after_s);
    visit("position_sd_m", "m", in(0.01, 1e6), "estimated standard deviation of position, the larger horizontal axis",
          self.position_sd_m);
    visit("too_low_s", "s", in(0, 1e6), "time below the least altitude in one piece", self.too_low_s);
  }
};

/// What an autopilot does with a vehicle that it gets because the pilot before it fell silent.
enum class WhenSilent { kGoOn, kHold, kSurface, kHome };

struct Mission {
  double speed_mps = 2.0;
  double depth_m = 0.0;
  std::optional<double> altitude_m;
  double least_altitude_m = 0.0;
  double run_in_m = 10.0;
  double run_out_m = 0.0;
  int repeat = 1;
  std::vector<MissionStep> steps;           // in order; lawnmowers are already laid out
  std::vector<runlines::Runline> runlines;  // all straight pieces of the steps' lines, in order
  std::optional<AutoPlan> auto_plan;        // set: `steps` is empty until it has been resolved
  std::optional<AdaptivePlan> adaptive;     // set: `steps` is the first line only
  std::optional<FollowTrack> follow;        // set: `steps` is empty
  AbortRules abort;
  WhenSilent when_silent = WhenSilent::kGoOn;
  std::optional<runlines::Vec2> home_enu_m;  // not given: where the autopilot first found the vehicle

  /// What of it has one value; steps and plans are in MissionKeys.
  static void parameters(auto& self, auto&& visit) {
    visit("speed_mps", "m/s", in(0.01, 30), "speed through the water", self.speed_mps);
    visit("speed_kn", "kn", again(in(0.02, 58)), "speed in knots, instead of speed_mps", self.speed_mps);
    visit("depth_m", "m", in(0, 11000), "depth of the vehicle's reference point below the water level", self.depth_m);
    visit("altitude_m", "m", in(0.5, 1000),
          "altitude above the bottom, by the altimeter; instead of the depth, once it is known", self.altitude_m);
    visit("least_altitude_m", "m", in(0, 1000), "obstacle floor; 0: none", self.least_altitude_m);
    visit("run_in_m", "m", in(0, 10000), "straight way before each line", self.run_in_m);
    visit("run_out_m", "m", in(0, 10000), "straight way behind each line", self.run_out_m);
    visit("repeat", "", in(1, 100000), "times that the steps are run", self.repeat);
    visit("abort", "rules for giving the mission up: come to the surface, stop and end the run", self.abort);
    visit("when_silent", "",
          one_of({{"go_on", WhenSilent::kGoOn},
                  {"hold", WhenSilent::kHold},
                  {"surface", WhenSilent::kSurface},
                  {"home", WhenSilent::kHome}}),
          "act of the autopilot when a pilot that steered in its place falls silent: the mission goes on, it holds its "
          "position, gives the mission up, or goes home and stays there",
          self.when_silent);
    visit("home_m", "", place(), "position to go home to, as positions says; left out: where the vehicle began",
          self.home_enu_m);
  }
  /// Depth at which each of `runlines` is run, below the water level; nothing where the bottom is followed.
  std::vector<std::optional<double>> runline_depths_m() const;
  std::vector<std::string> sonars() const;  // heads that SetSonar names, in order, each once
};

inline constexpr const char* kMissionFormat = "mission/1";

/// The depth in force after an order, given the one before it; nothing: the bottom is followed.
std::optional<double> depth_after(const GoAt& order, std::optional<double> before_m);

/// Steps for plain lines.
std::vector<MissionStep> steps_of(const std::vector<runlines::Runline>& lines);

/// The first line of an adaptive survey.
runlines::Runline first_line(const AdaptivePlan& plan);

}  // namespace ensonify
