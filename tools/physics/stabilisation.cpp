#include "kernels/acoustics/array/stabilisation.h"

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

using frames::Attitude;
using frames::Vec3;

constexpr double kDeg = std::numbers::pi / 180.0;

struct Inputs {
  bool roll_stabilised = true;
  double roll_amplitude_deg = 10.0;
  double roll_period_s = 6.0;
  double pitch_deg = 0.0;
  double sensor_error_deg = 0.0;
  double latency_s = 0.02;
  double flight_s = 0.05;
  double across_deg = 65.0;
  double time_s = 0.0;

  Attitude attitude_at(double t_s) const {
    return {.pitch_rad = pitch_deg * kDeg,
            .roll_rad = roll_amplitude_deg * kDeg * std::sin(2.0 * std::numbers::pi * t_s / roll_period_s)};
  }
  Attitude measured_at(double t_s) const {
    Attitude attitude = attitude_at(t_s - latency_s);
    attitude.roll_rad += sensor_error_deg * kDeg;
    return attitude;
  }
  double largest_roll_rate_degps() const { return roll_amplitude_deg * 2.0 * std::numbers::pi / roll_period_s; }
};

/// Steers as the instrument would, then checks where the beam is with the true attitude.
Verb::Row hold(const Inputs& in) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  const array::Stabilisation stabilisation{.pitch = true, .yaw = false, .roll = in.roll_stabilised};
  const double receive_s = in.time_s + in.flight_s;
  const auto at_transmit = array::held_from_head(stabilisation, in.measured_at(in.time_s), 0.0);
  const auto at_receive = array::held_from_head(stabilisation, in.measured_at(receive_s), 0.0);
  const double sin_transmit = array::transmit_sine(at_transmit, array::direction_held(0.0));
  const auto wanted = array::fan_direction(at_transmit, sin_transmit, in.across_deg * kDeg);
  const double sin_receive = wanted ? array::across_sine(at_receive, *wanted) : kNowhere;

  const auto level_from_head = [&](double t_s) { return array::held_from_head({}, in.attitude_at(t_s), 0.0); };
  const auto found = array::cone_intersection(level_from_head(in.time_s) * Vec3::UnitX(), sin_transmit,
                                              level_from_head(receive_s) * Vec3::UnitY(), sin_receive);
  const double across_deg = found ? std::atan2(found->y(), found->z()) / kDeg : kNowhere;
  return {in.attitude_at(receive_s).roll_rad / kDeg,
          in.measured_at(receive_s).roll_rad / kDeg,
          sin_transmit,
          sin_receive,
          across_deg,
          across_deg - in.across_deg,
          std::abs(in.sensor_error_deg) + in.latency_s * in.largest_roll_rate_degps()};
}

}  // namespace

void add_stabilisation(CLI::App& app, Verbs& verbs) {
  Verb& verb =
      verbs.emplace_back(app, "stabilisation",
                         "where a beam of a rolling head really points that is steered by a late and wrong "
                         "motion sensor; pitch is stabilised; the bound is error + latency x largest roll rate");
  const auto in = std::make_shared<Inputs>();
  verb.choice("roll_stabilised", in->roll_stabilised, {{"yes", true}, {"no", false}}, "receive beams follow the roll");
  verb.number("roll_amplitude_deg", in->roll_amplitude_deg, 0, 45, "of a sine");
  verb.number("roll_period_s", in->roll_period_s, 0.1, 100, "of the same");
  verb.number("pitch_deg", in->pitch_deg, -45, 45, "constant, measured without error");
  verb.number("sensor_error_deg", in->sensor_error_deg, -10, 10, "measured roll minus true roll");
  verb.number("latency_s", in->latency_s, 0, 10, "age of the measured roll when it is used");
  verb.number("flight_s", in->flight_s, 0, 10, "from transmission to reception");
  verb.number("across_deg", in->across_deg, -89, 89, "where the beam should point, from the vertical");
  verb.number("time_s", in->time_s, 0, 1e6, "of transmission");
  verb.results(
      {"roll_deg", "measured_roll_deg", "sin_transmit", "sin_receive", "true_across_deg", "error_deg", "bound_deg"},
      [in] { return hold(*in); });
}

}  // namespace ensonify::physics
