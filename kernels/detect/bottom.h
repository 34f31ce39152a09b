#pragma once

#include <span>
#include <vector>

/// Bottom detection by amplitude: where in its time series each beam heard the seabed. What an instrument can know goes
/// in: amplitudes, its own settings, its beams. Phase detection is not here.
namespace ensonify::detect {

struct Settings {
  double pulse_length_s = 100e-6;
  double gate_db = 13.0;        // the strongest return must stand this far above the beam's noise
  double search_start_s = 0.0;  // echoes are sought between these times after the start of transmission
  double search_end_s = 1e9;
  double sound_speed_mps = 1500.0;  // of the water, as the instrument believes
  double absorption_dbpm = 0.0;     // likewise
  double receive_length_in_waves = 50.0;
};

/// A beam-by-sample image of linear amplitude, uPa rms; sample k is taken at start_s + k * period_s after transmission.
struct Amplitudes {
  int beams = 0;
  int samples = 0;
  double start_s = 0.0;
  double period_s = 50e-6;
  std::span<const float> amplitude_upa;  // beam by beam
};

struct Detection {
  bool valid = false;
  double two_way_s = 0.0;       // from the start of transmission to the start of the echo from the beam's axis
  float snr_db = 0.0F;          // strongest return over noise; also given when it fails the gate
  float echo_energy_db = 0.0F;  // of the whole echo, noise taken off, dB re 1 uPa^2 s
  float quality = 0.0F;         // -log10 of the predicted relative standard deviation of two_way_s [Lurton2010b]
};

/// One detection per beam; detections is resized and overwritten. Independent of the number of threads.
///
/// Noise: median power of the beam over ln 2 (noise power is exponential), from at most 256 samples spread evenly; sd
/// 0.4 dB.
///
/// Gate: the strongest return is the largest mean power over one pulse. Of noise alone a beam passes the gate G (a
/// ratio) with probability below N P(Gamma(n, 1/n) > G), for N samples searched and n samples per pulse: below 1e-5 at
/// 13 dB for N = 2000 and n = 1, below 1e-12 for n = 2. No power at all is no detection.
///
/// Time: the centre of gravity in a window of twice the time that the beam's half-power footprint takes on a level
/// seabed, centred on itself in four passes. Power weighs with R^2 10^(2 alpha R / 10), as a level Lambert seabed makes
/// it fall per sine inside a beam, and 1 / t^2 is averaged, which is linear in the square of that sine. Together they
/// keep the bias below 0.05 % of depth at 60 deg for 1 deg beams, where a plain centre of gravity has 0.2 %.
///
/// sin_beams: one per beam, sine from the plane across the array.
void detect_bottom(const Settings& settings, std::span<const float> sin_beams, const Amplitudes& image,
                   std::vector<Detection>& detections);

/// Area that a beam of a Mills cross sees on a level seabed, m^2, both patterns as rectangles of equal area:
/// R^2 (lambda / L_T) (lambda / L_R) / cos^2(beam). With it the energy of a detection gives the backscatter strength,
/// Sb = echo_energy_db - 10 log10(pulse) - SL + 40 log10 R + 2 alpha R - 10 log10(area).
double beam_area_m2(double range_m, double sin_beam, double transmit_length_in_waves, double receive_length_in_waves);

}  // namespace ensonify::detect
