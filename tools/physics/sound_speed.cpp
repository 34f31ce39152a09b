#include "kernels/water/sound_speed.h"

#include <memory>
#include <numbers>

#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

using water::SoundSpeedLaw;

struct Inputs {
  SoundSpeedLaw law = SoundSpeedLaw::kUnesco;
  double temperature_degc = 10.0;
  double salinity_psu = 35.0;
  double depth_m = 0.0;
  double latitude_deg = 45.0;
};

}  // namespace

void add_sound_speed(CLI::App& app, Verbs& verbs) {
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

}  // namespace ensonify::physics
