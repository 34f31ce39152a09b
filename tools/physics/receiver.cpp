#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "kernels/acoustics/detect/seabed_image.h"
#include "kernels/acoustics/echo/gain.h"
#include "kernels/acoustics/echo/pulse.h"
#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

struct PulseInputs {
  bool chirp = false;
  echo::Window window = echo::Window::kNone;
  double pulse_length_s = 100e-6;
  double tapered_fraction = 0.0;
  double bandwidth_hz = 50e3;
  double dynamic_range_db = 40.0;
  double time_s = 0.0;

  echo::Pulse pulse() const {
    if (chirp) return echo::compressed_chirp(pulse_length_s, bandwidth_hz, window, dynamic_range_db);
    return echo::tapered_pulse(pulse_length_s, tapered_fraction);
  }
};

void add_pulse(CLI::App& app, Verbs& verbs) {
  Verb& verb = verbs.emplace_back(app, "pulse", "envelope of a point's echo behind the receiver's filter, peak 1");
  const auto in = std::make_shared<PulseInputs>();
  verb.choice("pulse", in->chirp, {{"tone", false}, {"chirp", true}}, "a tone, or a linear sweep");
  verb.choice("window", in->window,
              {{"none", echo::Window::kNone},
               {"hann", echo::Window::kHann},
               {"hamming", echo::Window::kHamming},
               {"blackman", echo::Window::kBlackman}},
              "of a chirp's matched filter");
  verb.number("pulse_length_s", in->pulse_length_s, 1e-6, 1, "length of the pulse");
  verb.number("tapered_fraction", in->tapered_fraction, 0, 1, "of a tone's length that rises and falls");
  verb.number("bandwidth_hz", in->bandwidth_hz, 1, 1e6, "that a chirp sweeps");
  verb.number("dynamic_range_db", in->dynamic_range_db, 10, 120, "a chirp's side lobes below this are cut");
  verb.number("time_s", in->time_s, -1, 1, "after the echo's start (tone) or its peak (chirp)");
  verb.results({"envelope"}, [in] { return Verb::Row{in->pulse().at(in->time_s)}; });
}

struct GainInputs {
  echo::TvgLaw law;
  double range_m = 50.0;
};

void add_gain(CLI::App& app, Verbs& verbs) {
  Verb& verb = verbs.emplace_back(app, "gain", "time-varying gain as an operator sets it");
  const auto in = std::make_shared<GainInputs>();
  verb.number("range_m", in->range_m, 0.01, 1e5, "slant range");
  verb.number("spreading_db", in->law.spreading_db, 0, 80, "per decade of range");
  verb.number("absorption_dbpm", in->law.absorption_dbpm, 0, 2, "absorption that the operator assumes");
  verb.number("slope_db_per_100m", in->law.slope_db_per_100m, 0, 1000, "besides, proportional to range");
  verb.number("offset_db", in->law.offset_db, -300, 300, "at all ranges");
  verb.number("max_db", in->law.max_db, -300, 300, "the most");
  verb.number("step_db", in->law.step_db, 0, 20, "it is rounded to; 0: continuous");
  verb.results({"gain_db"}, [in] {
    std::vector<float> gain_db;
    echo::tvg_db(in->law, {2.0 * in->range_m / in->law.sound_speed_mps, 1e-4, 1}, gain_db);
    return Verb::Row{static_cast<double>(gain_db[0])};
  });
}

struct FlatteningInputs {
  detect::FlatteningModel model;
  double crossover_deg = 25.0;
  double level_db = 100.0;
  double spreading_db = 30.0;
  double range_m = 30.0;
};

void add_flattening(CLI::App& app, Verbs& verbs) {
  Verb& verb = verbs.emplace_back(
      app, "flattening", "what flattening of a seabed image assumes, and what it makes of an echo; beams of 1 degree");
  const auto in = std::make_shared<FlatteningInputs>();
  verb.number("range_m", in->range_m, 0.1, 1e5, "slant range");
  verb.number("level_db", in->level_db, -120, 260, "of the echo, dB re 1 uPa");
  verb.number("source_level_db", in->model.source_level_db, 0, 260, "rms during the pulse, dB re 1 uPa at 1 m");
  verb.number("pulse_length_s", in->model.pulse_length_s, 1e-6, 1, "length of the pulse");
  verb.number("absorption_dbpm", in->model.absorption_dbpm, 0, 2, "absorption that is assumed");
  verb.number("nearest_range_m", in->model.nearest_range_m, 0.1, 1e5, "range of normal incidence");
  verb.number("normal_excess_db", in->model.normal_excess_db, -50, 50, "strength there over the oblique coefficient");
  verb.number("crossover_deg", in->crossover_deg, 1, 60, "incidence from which Lambert's law holds");
  verb.number("spreading_db", in->spreading_db, 0, 80, "of the range law, per decade of range");
  verb.results({"area_db", "angular_db", "flattened_db", "range_law_db"}, [in] {
    detect::FlatteningModel model = in->model;
    model.crossover_rad = in->crossover_deg * std::numbers::pi / 180.0;
    const double upa = std::pow(10.0, in->level_db / 20.0);
    return Verb::Row{detect::assumed_area_db(model, in->range_m), detect::assumed_angular_db(model, in->range_m),
                     detect::flattened_reflectivity_db(model, upa, in->range_m),
                     detect::range_law_reflectivity_db({in->spreading_db, model.absorption_dbpm, 0.0},
                                                       model.source_level_db, upa, in->range_m)};
  });
}

}  // namespace

void add_receiver(CLI::App& app, Verbs& verbs) {
  add_pulse(app, verbs);
  add_gain(app, verbs);
  add_flattening(app, verbs);
}

}  // namespace ensonify::physics
