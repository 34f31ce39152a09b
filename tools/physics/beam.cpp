// Verbs of beams: pattern and stabilisation.
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numbers>

#include "kernels/acoustics/array/aperture.h"
#include "kernels/acoustics/array/beam_layout.h"
#include "kernels/acoustics/array/near_field.h"
#include "kernels/acoustics/array/stabilisation.h"
#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

using Window = array::Shading::Window;

constexpr double kDeg = std::numbers::pi / 180.0;

enum class Aperture { kLine, kPiston, kSector };

struct Inputs {
  Aperture aperture = Aperture::kLine;
  Window shading = Window::kUniform;
  double side_lobe_db = 30.0;
  double nbar = 4;
  double frequency_hz = 300e3;
  double sound_speed_mps = 1500.0;
  double elements = 128;
  double spacing_m = 0.0025;
  double element_length_m = 0.0;
  double diameter_m = 0.1;
  double sector_width_deg = 40.0;
  double roll_off_sine = 0.2;
  double steer_deg = 0.0;
  double range_m = 0.0;
  double focus_m = 0.0;
  double angle_deg = 0.0;

  double wavelength_m() const { return sound_speed_mps / frequency_hz; }
  double sin_steer() const { return std::sin(steer_deg * kDeg); }
};

double or_far_away(double distance_m) { return distance_m > 0.0 ? distance_m : array::kFarAway_m; }

array::LineArray line_of(const Inputs& in) {
  const array::Shading shading{
      .window = in.shading, .side_lobe_db = in.side_lobe_db, .nbar = static_cast<int>(std::lround(in.nbar))};
  return {.spacing_m = in.spacing_m,
          .weights = array::shading_weights(shading, static_cast<int>(std::lround(in.elements))),
          .element_length_m = in.element_length_m};
}

/// A beam as the sine of its axis and its amplitude by sine.
struct Beam {
  double axis_sine = 0.0;
  double step = 0.001;  // of sine, in which its power cannot fall to a half and rise again
  std::function<std::complex<double>(double sine)> amplitude;
};

Beam line_beam(const Inputs& in, const array::LineArray& line, double sin_steer) {
  return {.axis_sine = sin_steer,
          .step = std::min(0.01, in.wavelength_m() / (64.0 * line.length_m())),
          .amplitude = [=](double sine) {
            return array::near_field_amplitude(line, in.wavelength_m(), sine, sin_steer, or_far_away(in.range_m),
                                               or_far_away(in.focus_m));
          }};
}

Beam beam_of(const Inputs& in) {
  const double wavelength_m = in.wavelength_m();
  if (in.aperture == Aperture::kPiston) {
    const double diameter_in_waves = in.diameter_m / wavelength_m;
    return {.axis_sine = 0.0, .step = std::min(0.01, 1.0 / (64.0 * diameter_in_waves)), .amplitude = [=](double sine) {
              return array::piston_amplitude(diameter_in_waves, sine);
            }};
  }
  if (in.aperture == Aperture::kSector) {
    const double half_rad = 0.5 * in.sector_width_deg * kDeg, centre_rad = in.steer_deg * kDeg;
    const array::SectorBeam sector = array::sector_beam(wavelength_m, std::sin(centre_rad - half_rad),
                                                        std::sin(centre_rad + half_rad), in.roll_off_sine);
    return line_beam(in, sector.array, sector.sin_steer);
  }
  return line_beam(in, line_of(in), in.sin_steer());
}

Verb::Row pattern(const Inputs& in) {
  const Beam beam = beam_of(in);
  const std::complex<double> amplitude = beam.amplitude(std::sin(in.angle_deg * kDeg));
  const auto edges =
      array::half_power_edges([&](double sine) { return std::norm(beam.amplitude(sine)); }, beam.axis_sine, beam.step);
  return {20.0 * std::log10(std::abs(amplitude)), std::arg(amplitude) / kDeg, std::asin(edges.lower_sine) / kDeg,
          std::asin(edges.upper_sine) / kDeg};
}

using frames::Attitude;
using frames::Vec3;

struct RollingHead {
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
Verb::Row hold(const RollingHead& in) {
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

void add_pattern(CLI::App& app, Verbs& verbs) {
  Verb& verb = verbs.emplace_back(app, "pattern",
                                  "beam pattern of an array, over the angle from the plane across it, and the beam's "
                                  "half-power edges; 0 dB is the axis of the unsteered array in the far field");
  const auto in = std::make_shared<Inputs>();
  verb.choice("aperture", in->aperture,
              {{"line", Aperture::kLine}, {"piston", Aperture::kPiston}, {"sector", Aperture::kSector}},
              "a line of elements, a circular piston (neither steered nor focused), or a flat-topped transmit sector");
  verb.choice("shading", in->shading,
              {{"uniform", Window::kUniform},
               {"hann", Window::kHann},
               {"hamming", Window::kHamming},
               {"dolph-chebyshev", Window::kDolphChebyshev},
               {"taylor", Window::kTaylor}},
              "weights of a line's elements");
  verb.number("side_lobe_db", in->side_lobe_db, 13, 100, "side lobes below the main lobe (Dolph-Chebyshev, Taylor)");
  verb.number("nbar", in->nbar, 1, 100, "level side lobes of a Taylor shading");
  verb.number("frequency_hz", in->frequency_hz, 1e3, 1e7, "frequency");
  verb.number("sound_speed_mps", in->sound_speed_mps, 1000, 2000, "sound speed at the face");
  verb.number("elements", in->elements, 1, 1024, "elements of a line");
  verb.number("spacing_m", in->spacing_m, 1e-5, 1, "from element to element");
  verb.number("element_length_m", in->element_length_m, 0, 1, "length of each along the line; 0: a point");
  verb.number("diameter_m", in->diameter_m, 1e-4, 10, "of a piston");
  verb.number("sector_width_deg", in->sector_width_deg, 1, 170, "between the -6 dB edges of a sector");
  verb.number("roll_off_sine", in->roll_off_sine, 0.01, 1, "width of a sector's edges in sine, 0 to -50 dB");
  verb.number("steer_deg", in->steer_deg, -90, 90, "direction of the beam's axis or the sector's centre");
  verb.number("range_m", in->range_m, 0, 1e6, "distance at which the pattern is taken; 0: far field");
  verb.number("focus_m", in->focus_m, 0, 1e6, "distance at which the beam is focused; 0: off");
  verb.number("angle_deg", in->angle_deg, -90, 90, "direction");
  verb.results({"pattern_db", "phase_deg", "lower_edge_deg", "upper_edge_deg"}, [in] { return pattern(*in); });
}

void add_stabilisation(CLI::App& app, Verbs& verbs) {
  Verb& verb =
      verbs.emplace_back(app, "stabilisation",
                         "where a beam of a rolling head really points that is steered by a late and wrong "
                         "motion sensor; pitch is stabilised; the bound is error + latency x largest roll rate");
  const auto in = std::make_shared<RollingHead>();
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
