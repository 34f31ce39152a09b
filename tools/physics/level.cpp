#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "kernels/acoustics/sonar_equation.h"
#include "kernels/seabed/backscatter.h"
#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

namespace se = sonar_equation;

constexpr double kDeg = std::numbers::pi / 180.0;

/// What all echoes have in common; each verb uses its part.
struct Inputs {
  double source_level_db = 210.0;
  double range_m = 50.0;
  double altitude_m = 20.0;
  double beam_angle_deg = 45.0;
  double absorption_db_per_km = 70.0;
  double bubble_loss_db = 0.0;
  double pulse_length_s = 100e-6;
  double sound_speed_mps = 1500.0;
  double along_track_width_deg = 0.5;
  double transmit_width_deg = 1.0;
  double receive_width_deg = 1.0;
  double lambert_mu_db = -25.0;
  double target_strength_db = -20.0;
  double volume_scattering_db = -70.0;
  double solid_angle_sr = 1e-3;
  double patterns_db = 0.0;

  se::Path path(double to_range_m) const { return {to_range_m, absorption_db_per_km * 1e-3, bubble_loss_db}; }
};

Verb& add(CLI::App& level, Verbs& verbs, const std::string& name, const std::string& about, Inputs& in) {
  Verb& verb = verbs.emplace_back(level, name, about);
  verb.number("source_level_db", in.source_level_db, 0, 260, "rms source level on the axis, dB re 1 uPa at 1 m");
  return verb;
}

void add_water(Verb& verb, Inputs& in) {
  verb.number("absorption_db_per_km", in.absorption_db_per_km, 0, 2000, "absorption, as `absorption` gives it");
  verb.number("bubble_loss_db", in.bubble_loss_db, 0, 100, "loss to bubbles under the hull, one way");
}

void add_pulse(Verb& verb, Inputs& in) {
  verb.number("pulse_length_s", in.pulse_length_s, 1e-6, 1, "length of the pulse");
  verb.number("sound_speed_mps", in.sound_speed_mps, 1300, 1800, "speed of sound");
}

void add_range(Verb& verb, Inputs& in) { verb.number("range_m", in.range_m, 1, 20000, "slant range"); }

void add_seabed(Verb& verb, Inputs& in) {
  verb.number("lambert_mu_db", in.lambert_mu_db, -80, 0, "Lambert strength of the seabed, dB re 1 m^2/m^2");
}

Verb::Row seabed_row(const Inputs& in, double range_m, double sin_grazing, double area_m2) {
  const double backscatter_db = seabed::lambert_strength_db(in.lambert_mu_db, sin_grazing);
  const se::Path path = in.path(range_m);
  return {se::two_way_loss_db(path), backscatter_db, area_m2,
          se::seabed_level_db(in.source_level_db, path, backscatter_db, area_m2)};
}

void add_sidescan(CLI::App& level, Verbs& verbs) {
  const auto in = std::make_shared<Inputs>();
  Verb& verb = add(level, verbs, "sidescan", "a sidescan over a level Lambert seabed", *in);
  add_range(verb, *in);
  verb.number("altitude_m", in->altitude_m, 0.1, 20000, "height above the seabed");
  add_water(verb, *in);
  add_pulse(verb, *in);
  verb.number("along_track_width_deg", in->along_track_width_deg, 0.01, 60,
              "one-way 3 dB width of the line that sends and receives");
  add_seabed(verb, *in);
  verb.results({"loss_db", "backscatter_db", "area_m2", "level_db"}, [in] {
    const double width_rad = se::kTwoWayWidth * in->along_track_width_deg * kDeg;
    const double sin_grazing = std::min(1.0, in->altitude_m / in->range_m);
    return seabed_row(
        *in, in->range_m, sin_grazing,
        se::sidescan_area_m2(in->range_m, in->altitude_m, width_rad, in->sound_speed_mps, in->pulse_length_s));
  });
}

void add_multibeam(CLI::App& level, Verbs& verbs) {
  const auto in = std::make_shared<Inputs>();
  Verb& verb =
      add(level, verbs, "multibeam",
          "a Mills cross over a level Lambert seabed; an upper bound, by 1.2 dB where beam and pulse cut alike", *in);
  verb.number("altitude_m", in->altitude_m, 0.1, 20000, "height above the seabed");
  verb.number("beam_angle_deg", in->beam_angle_deg, -85, 85, "beam angle from nadir");
  add_water(verb, *in);
  add_pulse(verb, *in);
  verb.number("transmit_width_deg", in->transmit_width_deg, 0.01, 60, "3 dB width along track");
  verb.number("receive_width_deg", in->receive_width_deg, 0.01, 60, "3 dB width across track, at broadside");
  add_seabed(verb, *in);
  verb.results({"loss_db", "backscatter_db", "area_m2", "level_db"}, [in] {
    const double angle_rad = in->beam_angle_deg * kDeg;
    const double range_m = in->altitude_m / std::cos(angle_rad);
    return seabed_row(*in, range_m, std::cos(angle_rad),
                      se::multibeam_area_m2(range_m, angle_rad, se::kOneWayWidth * in->transmit_width_deg * kDeg,
                                            se::kOneWayWidth * in->receive_width_deg * kDeg, in->sound_speed_mps,
                                            in->pulse_length_s));
  });
}

void add_target(CLI::App& level, Verbs& verbs) {
  const auto in = std::make_shared<Inputs>();
  Verb& verb = add(level, verbs, "target", "a point target", *in);
  add_range(verb, *in);
  add_water(verb, *in);
  verb.number("target_strength_db", in->target_strength_db, -120, 80,
              "target strength, dB re 1 m^2; a rigid sphere has 20 log10(radius / 2)");
  verb.number("patterns_db", in->patterns_db, -200, 0, "both patterns towards the target, 0 on the axes");
  verb.results({"loss_db", "level_db"}, [in] {
    const se::Path path = in->path(in->range_m);
    return Verb::Row{se::two_way_loss_db(path),
                     se::target_level_db(in->source_level_db, path, in->target_strength_db + in->patterns_db)};
  });
}

void add_volume(CLI::App& level, Verbs& verbs) {
  const auto in = std::make_shared<Inputs>();
  Verb& verb = add(level, verbs, "volume", "scatterers that fill the beam", *in);
  add_range(verb, *in);
  add_water(verb, *in);
  add_pulse(verb, *in);
  verb.number("volume_scattering_db", in->volume_scattering_db, -150, 0, "volume scattering strength, dB re 1/m");
  verb.number("solid_angle_sr", in->solid_angle_sr, 1e-9, 4 * std::numbers::pi, "integral of both patterns' product");
  verb.results({"loss_db", "level_db"}, [in] {
    const se::Path path = in->path(in->range_m);
    return Verb::Row{se::two_way_loss_db(path),
                     se::volume_level_db(in->source_level_db, path, in->volume_scattering_db, in->solid_angle_sr,
                                         in->sound_speed_mps, in->pulse_length_s)};
  });
}

}  // namespace

void add_level(CLI::App& app, Verbs& verbs) {
  CLI::App* level = app.add_subcommand("level", "echo levels by the sonar equation, dB re 1 uPa^2 on the beam's axis");
  level->require_subcommand(1);
  add_sidescan(*level, verbs);
  add_multibeam(*level, verbs);
  add_target(*level, verbs);
  add_volume(*level, verbs);
}

}  // namespace ensonify::physics
