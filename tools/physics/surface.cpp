#include <memory>
#include <numbers>

#include "kernels/acoustics/sea_surface.h"
#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

struct Inputs {
  double wind_speed_mps = 5.0;
  double frequency_hz = 100e3;
  double sound_speed_mps = 1500.0;
  double grazing_deg = 45.0;
};

}  // namespace

void add_surface(CLI::App& app, Verbs& verbs) {
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

}  // namespace ensonify::physics
