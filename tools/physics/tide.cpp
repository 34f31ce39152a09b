#include "kernels/vehicle/vertical/tide.h"

#include <memory>
#include <numbers>

#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

struct Inputs {
  double mean_m = 2.0, m2_m = 1.5, s2_m = 0.5, k1_m = 0.0, o1_m = 0.0;
  double t_h = 0.0;
};

}  // namespace

void add_tide(CLI::App& app, Verbs& verbs) {
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

}  // namespace ensonify::physics
