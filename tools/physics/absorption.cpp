#include "kernels/water/absorption.h"

#include <memory>

#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

using water::AbsorptionLaw;

struct Inputs {
  AbsorptionLaw law = AbsorptionLaw::kFrancoisGarrison;
  double frequency_hz = 300e3;
  water::SeaWater water;
};

}  // namespace

void add_absorption(CLI::App& app, Verbs& verbs) {
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

}  // namespace ensonify::physics
