#pragma once

#include <array>
#include <string>

#include "components/config/parameters.h"
#include "kernels/vehicle/motion/towed_body.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

/// Positioning of the body aboard the vessel.
struct TowPositioning {
  enum class By {
    kLayback,  // from the cable out and the depth: so far back on the vessel's own track
    kUsbl,     // from fixes of an acoustic array under the vessel
  };
  static constexpr double kDegree_rad = 3.14159265358979323846 / 180.0;

  By by = By::kLayback;
  double cable_scale = 0.0;
  double layback_factor = 1.0;
  double usbl_gain = 0.2;
  double depth_white_m = 0.05;
  double heading_white_rad = 0.5 * kDegree_rad;
  double level_white_rad = 0.05 * kDegree_rad;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("by", "", one_of({{"layback", By::kLayback}, {"usbl", By::kUsbl}}),
          "source of the body's position: the cable out and the depth, or fixes of an acoustic array under the vessel",
          self.by);
    visit("cable_scale", "", in(-0.5, 0.5), "relative error of the cable counter, as it is", self.cable_scale);
    visit("layback_factor", "", in(0.1, 1.5), "layback over that of a straight cable, as it is assumed",
          self.layback_factor);
    visit("usbl_gain", "", in(0.001, 1), "share of a fix's difference from the estimate that is taken over",
          self.usbl_gain);
    visit("depth_white_m", "m", in(0, 100), "standard deviation of the body's own depth, each sample",
          self.depth_white_m);
    visit("heading_white_deg", "deg", in(0, 90), "white noise of the body's own heading", self.heading_white_rad);
    visit("level_white_deg", "deg", in(0, 90), "white noise of the body's own roll and pitch, each",
          self.level_white_rad);
  }
};

template <>
struct ParametersOf<motion::TowCable> {
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("out_m", "m", in(1, 10000), "length from the sheave", self.out_m);
    visit("diameter_m", "m", in(1e-4, 1), "diameter of the cable", self.diameter_m);
    visit("weight_npm", "N/m", in(0, 1000), "weight in water", self.weight_npm);
    visit("normal_drag", "", in(0, 10), "drag coefficient of the flow across it", self.normal_drag);
    visit("tangential_drag", "", in(0, 10), "drag of the flow along the cable, on the circumference",
          self.tangential_drag);
  }
  static void check(const ConfigReader&, const motion::TowCable&) {}
};

template <>
struct ParametersOf<motion::TowedBody> {
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("weight_n", "N", in(1, 1e6), "weight in water, less what its wings lift", self.weight_n);
    visit("drag_area_m2", "m^2", in(0, 100), "drag coefficient times area", self.drag_area_m2);
  }
  static void check(const ConfigReader&, const motion::TowedBody&) {}
};

struct TowedBodyParameters {
  std::string vehicle;
  int pose_rate_hz = 50;
  motion::TowCable cable;
  motion::TowedBody body;
  std::array<double, 3> sheave_m{-5.0, 0.0, -2.0};
  double depth_lag_s = 10.0;
  TowPositioning positioning;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("vehicle", "", any(), "vehicle of the scenario; \"\": the one with the process's name, or the only one",
          self.vehicle);
    visit("pose_rate_hz", "Hz", in(10, 200), "rate of the true pose and of the estimate", self.pose_rate_hz);
    visit("cable", "the cable from the vessel to the body", self.cable);
    visit("body", "the body at its end", self.body);
    visit("sheave_m", "m", in(-500, 500), "place on the vessel: forward, starboard, down", self.sheave_m);
    visit("depth_lag_s", "s", in(0.1, 10000),
          "time constant with which depth and layback follow speed: about the cable over its sinking speed",
          self.depth_lag_s);
    visit("positioning", "positioning of the body aboard the vessel", self.positioning);
  }
};

struct TowedBodyConfig : TowedBodyParameters {
  // From the scenario.
  std::string process;
  std::string name;  // of the body
  std::uint64_t seed = 1;
  motion::DisturbanceParameters disturbance;
  motion::Current current;

  static TowedBodyConfig read(ConfigReader& from, const World& world, const std::string& process);
};

}  // namespace ensonify
