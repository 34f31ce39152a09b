#pragma once

#include "kernels/base/frames/attitude.h"

/// A body towed on a cable: how deep it runs, how far behind, and how it follows turns.
namespace ensonify::motion {

struct TowCable {
  double out_m = 100.0;            // from the sheave, > 0
  double diameter_m = 0.01;        // > 0
  double weight_npm = 2.0;         // in water, >= 0
  double normal_drag = 1.2;        // drag coefficient of the flow across it, >= 0; a smooth cylinder's
  double tangential_drag = 0.015;  // of the flow along it, on the circumference, >= 0
};

struct TowedBody {
  double weight_n = 300.0;     // in water, less what its wings lift; > 0
  double drag_area_m2 = 0.05;  // drag coefficient times area, >= 0
};

struct TowShape {
  double depth_m = 0.0;    // of the body below the sheave
  double layback_m = 0.0;  // behind it, horizontally
  double tension_n = 0.0;  // at the sheave
};

/// The shape of the cable at a steady speed through the water: an inextensible line without bending stiffness, its
/// weight and drag in balance element by element from the body up [Faltinsen1990]. Density of the water 1025 kg/m^3.
/// Throws std::invalid_argument for values outside what is said above or a negative speed.
TowShape tow_shape(const TowCable& cable, const TowedBody& body, double speed_mps);

/// A towed body on its way. Heights count as the sheave's do.
struct TowState {
  frames::Vec3 position_enu_m = frames::Vec3::Zero();
  double heading_rad = 0.0;  // towards the sheave, horizontally
  double speed_mps = 0.0;    // through the water
  double layback_m = 0.0;
};

/// Behind a sheave that has gone straight at a steady speed for long.
TowState towed_behind(const TowCable& cable, const TowedBody& body, const frames::Vec3& sheave_enu_m,
                      double heading_rad, double speed_mps);

/// One step of a body behind a sheave that ends up at `sheave_enu_m`. Through the water the body goes only towards the
/// sheave, a tractrix: on a circle of radius R it runs on one of sqrt(R^2 - layback^2), later by its layback over the
/// speed. When the sheave comes nearer than the layback it stops. Its depth, and the layback, tend to those of its own
/// speed with `lag_s` (about the cable over its sinking speed). Short steps: 0.1 s or less. `current_enu_mps` carries
/// both.
TowState tow(const TowCable& cable, const TowedBody& body, const TowState& state, const frames::Vec3& sheave_enu_m,
             const frames::Vec2& current_enu_mps, double lag_s, double dt_s);

}  // namespace ensonify::motion
