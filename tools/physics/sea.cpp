// Verbs of the water, its surface and what rides on it.
#include <memory>
#include <numbers>

#include "kernels/acoustics/sea_surface.h"
#include "kernels/vehicle/motion/disturbance.h"
#include "kernels/vehicle/vertical/tide.h"
#include "kernels/water/absorption.h"
#include "kernels/water/noise.h"
#include "kernels/water/sound_speed.h"
#include "tools/physics/verb.h"

namespace ensonify::physics {

void add_absorption(CLI::App& app, Verbs& verbs) {
  using water::AbsorptionLaw;

  struct Inputs {
    AbsorptionLaw law = AbsorptionLaw::kFrancoisGarrison;
    double frequency_hz = 300e3;
    water::SeaWater water;
  };

  Verb& verb = verbs.emplace_back(app, "absorption", "absorption of sound in sea water");
  const auto in = std::make_shared<Inputs>();
  verb.choice(
      "law", in->law,
      {{"francois-garrison", AbsorptionLaw::kFrancoisGarrison}, {"ainslie-mccolm", AbsorptionLaw::kAinslieMcColm}},
      "whose fit to the measurements");
  verb.number("frequency_hz", in->frequency_hz, 100, 2e6, "frequency; the laws end at 1 MHz");
  verb.number("temperature_degc", in->water.temperature_degc, -6, 45, "temperature");
  verb.number("salinity_psu", in->water.salinity_psu, 0, 50, "practical salinity");
  verb.number("depth_m", in->water.depth_m, 0, 12000, "depth below the surface");
  verb.number("ph", in->water.ph, 7, 9, "acidity; matters below 10 kHz");
  verb.results({"absorption_db_per_km"},
               [in] { return Verb::Row{1e3 * water::absorption_dbpm(in->law, in->frequency_hz, in->water)}; });
}

void add_sound_speed(CLI::App& app, Verbs& verbs) {
  using water::SoundSpeedLaw;

  struct Inputs {
    SoundSpeedLaw law = SoundSpeedLaw::kUnesco;
    double temperature_degc = 10.0;
    double salinity_psu = 35.0;
    double depth_m = 0.0;
    double latitude_deg = 45.0;
  };

  Verb& verb =
      verbs.emplace_back(app, "sound-speed", "speed of sound in sea water, and whether the law was made for it");
  const auto in = std::make_shared<Inputs>();
  verb.choice("law", in->law,
              {{"mackenzie", SoundSpeedLaw::kMackenzie},
               {"unesco", SoundSpeedLaw::kUnesco},
               {"del-grosso", SoundSpeedLaw::kDelGrosso}},
              "whose fit to the measurements");
  verb.number("temperature_degc", in->temperature_degc, -4, 45, "temperature (ITS-90)");
  verb.number("salinity_psu", in->salinity_psu, 0, 50, "practical salinity");
  verb.number("depth_m", in->depth_m, 0, 12000, "depth below the surface");
  verb.number("latitude_deg", in->latitude_deg, -90, 90, "latitude, for the pressure at depth");
  verb.results({"pressure_bar", "in_range", "sound_speed_mps"}, [in] {
    const double latitude_rad = in->latitude_deg * std::numbers::pi / 180.0;
    return Verb::Row{
        water::sea_pressure_pa(in->depth_m, latitude_rad) * 1e-5,
        water::in_range(in->law, in->temperature_degc, in->salinity_psu, in->depth_m, latitude_rad) ? 1.0 : 0.0,
        water::sound_speed_mps(in->law, in->temperature_degc, in->salinity_psu, in->depth_m, latitude_rad)};
  });
}

void add_noise(CLI::App& app, Verbs& verbs) {
  struct Inputs {
    double frequency_hz = 300e3;
    double wind_speed_mps = 5.0;
    water::Receiver receiver;
  };

  Verb& verb =
      verbs.emplace_back(app, "noise",
                         "spectral levels of ambient noise, dB re 1 uPa^2/Hz, and what a receiver makes of it, "
                         "dB re 1 uPa^2");
  const auto in = std::make_shared<Inputs>();
  verb.number("frequency_hz", in->frequency_hz, 100, 2e6, "frequency; wind noise is an extrapolation above 50 kHz");
  verb.number("wind_speed_mps", in->wind_speed_mps, 0, 60, "wind");
  verb.number("bandwidth_hz", in->receiver.bandwidth_hz, 1, 1e6, "band of the receiver");
  verb.number("directivity_index_db", in->receiver.directivity_index_db, 0, 80,
              "directivity index of the receiving array");
  verb.number("electronic_noise_db", in->receiver.electronic_noise_db, -200, 200,
              "the electronics' own noise, as if in the water, dB re 1 uPa^2/Hz");
  verb.results({"thermal_db", "wind_db", "ambient_db", "received_db"}, [in] {
    const double f = in->frequency_hz;
    const double wind_mps = in->wind_speed_mps;
    return Verb::Row{water::thermal_noise_level_db(f), water::wind_noise_level_db(f, wind_mps),
                     water::ambient_noise_level_db(f, wind_mps),
                     water::received_noise_level_db(f, wind_mps, in->receiver)};
  });
}

void add_surface(CLI::App& app, Verbs& verbs) {
  struct Inputs {
    double wind_speed_mps = 5.0;
    double frequency_hz = 100e3;
    double sound_speed_mps = 1500.0;
    double grazing_deg = 45.0;
  };

  Verb& verb =
      verbs.emplace_back(app, "surface",
                         "the sea surface from below after TR 9407: backscatter strength by parts, dB re 1 m2\n"
                         "per m2; rms height of a developed sea; what is left of the mirror reflection");
  const auto in = std::make_shared<Inputs>();
  verb.number("wind_speed_mps", in->wind_speed_mps, 0, 50, "wind, 10 m up for the echo, 19.5 m for the height");
  verb.number("frequency_hz", in->frequency_hz, 1e3, 2e6, "frequency; above 100 kHz the law is extrapolated");
  verb.number("sound_speed_mps", in->sound_speed_mps, 1300, 1700, "of the water at the surface");
  verb.number("grazing_deg", in->grazing_deg, 0, 90, "grazing angle from the mean surface");
  verb.results({"bubbles_db", "facets_db", "ripples_db", "interface_db", "bubble_loss_db", "total_db", "rms_height_m",
                "coherent_reflection"},
               [in] {
                 const double grazing_rad = in->grazing_deg * std::numbers::pi / 180.0;
                 const double k_radpm = 2.0 * std::numbers::pi * in->frequency_hz / in->sound_speed_mps;
                 const double rms_height_m = surface::rms_wave_height_m(in->wind_speed_mps);
                 const auto part = surface::sea_surface_backscatter(grazing_rad, in->frequency_hz, in->wind_speed_mps);
                 return Verb::Row{
                     db(part.bubbles),    db(part.facets),
                     db(part.ripples),    db(part.interface),
                     part.bubble_loss_db, db(part.total),
                     rms_height_m,        surface::coherent_reflection(k_radpm, rms_height_m, grazing_rad)};
               });
}

void add_tide(CLI::App& app, Verbs& verbs) {
  struct Inputs {
    double mean_m = 2.0, m2_m = 1.5, s2_m = 0.5, k1_m = 0.0, o1_m = 0.0;
    double t_h = 0.0;
  };

  Verb& verb = verbs.emplace_back(app, "tide", "a tide of up to four constituents that are all high at t = 0");
  const auto in = std::make_shared<Inputs>();
  verb.number("mean_m", in->mean_m, -20, 20, "mean level above chart datum");
  verb.number("m2_m", in->m2_m, 0, 20, "amplitude of M2");
  verb.number("s2_m", in->s2_m, 0, 20, "amplitude of S2");
  verb.number("k1_m", in->k1_m, 0, 20, "amplitude of K1");
  verb.number("o1_m", in->o1_m, 0, 20, "amplitude of O1");
  verb.number("t_h", in->t_h, -1e6, 1e6, "time in hours");
  verb.results({"level_m", "rate_mph"}, [in] {
    const auto constituent = [](const char* name, double amplitude_m) {
      const double speed_radps = *vertical::constituent_speed_degph(name) * std::numbers::pi / 180.0 / 3600.0;
      return vertical::Constituent{speed_radps, amplitude_m, 0.0};
    };
    const vertical::HarmonicTide tide{in->mean_m,
                                      {constituent("M2", in->m2_m), constituent("S2", in->s2_m),
                                       constituent("K1", in->k1_m), constituent("O1", in->o1_m)}};
    const vertical::Level level = vertical::Tide(tide).at(in->t_h * 3600.0);
    return Verb::Row{level.height_m, level.rate_mps * 3600.0};
  });
}

void add_disturbance(CLI::App& app, Verbs& verbs) {
  struct Inputs {
    std::string_view preset = motion::kDisturbancePresets[0];
    double seed = 1.0;
    double t_s = 0.0;
  };

  Verb& verb = verbs.emplace_back(app, "disturbance",
                                  "a vessel's irregular motion about its mean pose, by presets: six axes at a time");
  const auto in = std::make_shared<Inputs>();
  std::vector<std::pair<std::string, std::string_view>> presets;
  for (const std::string_view name : motion::kDisturbancePresets) presets.emplace_back(std::string(name), name);
  verb.choice("preset", in->preset, presets, "whose motion");
  verb.number("seed", in->seed, 0, 1e9, "another motion with the same statistics; a whole number");
  verb.number("t_s", in->t_s, 0, 1e6, "time");
  verb.results({"surge_m", "sway_m", "heave_m", "roll_deg", "pitch_deg", "heading_deg"}, [in] {
    const random::Stream stream(static_cast<std::uint64_t>(in->seed), "physics/disturbance");
    const auto off = motion::Disturbance(*motion::disturbance_preset(in->preset), stream).at(in->t_s);
    constexpr double kDegree = std::numbers::pi / 180.0;
    return Verb::Row{off.surge_m.value,
                     off.sway_m.value,
                     off.heave_m.value,
                     off.roll_rad.value / kDegree,
                     off.pitch_rad.value / kDegree,
                     off.heading_rad.value / kDegree};
  });
}

}  // namespace ensonify::physics
