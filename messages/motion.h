#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace ensonify::msg {

struct Pose {
  static constexpr const char* kType = "pose/1";
  static constexpr const char* kAbout =
      "Where a vehicle truly is. Truth: acoustics uses it, instruments and records of instruments never do.";
  std::int64_t stamp_ns = 0;
  std::array<double, 3> position_enu_m{};
  std::array<double, 4> enu_from_body{1, 0, 0, 0};
  std::array<double, 3> velocity_enu_mps{};
  std::array<double, 3> rate_body_radps{};
  std::array<double, 3> acceleration_enu_mps2{};
  std::array<double, 3> angular_acceleration_body_radps2{};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of validity, sim time", self.stamp_ns);
    visit("position_enu_m", "m", "body origin in the world frame: east, north, up from chart datum",
          self.position_enu_m);
    visit("enu_from_body", "1", "attitude quaternion w, x, y, z (w >= 0) from body FRD to world ENU",
          self.enu_from_body);
    visit("velocity_enu_mps", "m/s", "velocity of the body origin in the world frame", self.velocity_enu_mps);
    visit("rate_body_radps", "rad/s", "angular rate in the body frame, FRD", self.rate_body_radps);
    visit("acceleration_enu_mps2", "m/s^2",
          "acceleration of the body origin in the world frame; less gravity, turned to the body, it is the specific "
          "force",
          self.acceleration_enu_mps2);
    visit("angular_acceleration_body_radps2", "rad/s^2", "rate of the angular rate, body frame",
          self.angular_acceleration_body_radps2);
  }
};

struct Guidance {
  static constexpr const char* kType = "guidance/1";
  static constexpr const char* kAbout = "What a pilot (autopilot or agent) asks of a vehicle.";
  std::int64_t stamp_ns = 0;
  double heading_grid_rad = 0.0;
  double speed_mps = 0.0;
  double depth_m = std::numeric_limits<double>::quiet_NaN();
  std::string vehicle;
  bool hand_back = false;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of the command, sim time", self.stamp_ns);
    visit("heading_grid_rad", "rad", "heading to steer, clockwise from grid north", self.heading_grid_rad);
    visit("speed_mps", "m/s", "speed through the water to reach, forward", self.speed_mps);
    visit("depth_m", "m", "depth of the body origin below the water level to hold; NaN: as before", self.depth_m);
    visit("vehicle", "", "name of the vehicle that is meant; empty: whichever receives it", self.vehicle);
    visit("hand_back", "1", "release of the vehicle to the next of those who may steer it", self.hand_back);
  }
};

struct Helm {
  static constexpr const char* kType = "helm/1";
  static constexpr const char* kAbout = "Who steers a vehicle, of several that may, and why.";
  std::int64_t stamp_ns = 0;
  std::string steered_by;
  std::vector<std::string> pilots;
  std::string why;
  std::int64_t refused = 0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of the state, sim time", self.stamp_ns);
    visit("steered_by", "", "name of the pilot whose commands are obeyed; empty: nobody's", self.steered_by);
    visit("pilots", "", "names of those who may steer it, the first before the others", self.pilots);
    visit("why", "", "reason of the last change: commands, silent, hand_back; empty: none yet", self.why);
    visit("refused", "1", "number of commands refused so far, of all pilots", self.refused);
  }
};

struct MissionState {
  static constexpr const char* kType = "mission_state/1";
  static constexpr const char* kAbout = "What the mission is doing.";
  std::int64_t stamp_ns = 0;
  std::string state;
  std::int64_t line = -1;
  std::int64_t line_count = 0;
  std::string line_name;
  double cross_track_m = 0.0;
  double distance_to_go_m = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of the state, sim time", self.stamp_ns);
    visit("state", "", "run_in, on_line, run_out or turn; pass, keep or orbit; await_line; stand_by; abort or done",
          self.state);
    visit("line", "1", "index of the runline being run, -1 before the first", self.line);
    visit("line_count", "1", "number of runlines in the mission", self.line_count);
    visit("line_name", "", "name of the runline being run; empty: it has none", self.line_name);
    visit("cross_track_m", "m", "estimated distance right of the runline, positive to starboard", self.cross_track_m);
    visit("distance_to_go_m", "m", "distance to the end of the runline", self.distance_to_go_m);
  }
};

}  // namespace ensonify::msg
