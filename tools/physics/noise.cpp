#include "kernels/water/noise.h"

#include <memory>

#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

struct Inputs {
  double frequency_hz = 300e3;
  double wind_speed_mps = 5.0;
  water::Receiver receiver;
};

}  // namespace

void add_noise(CLI::App& app, Verbs& verbs) {
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

}  // namespace ensonify::physics
