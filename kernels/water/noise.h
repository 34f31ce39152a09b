#pragma once

namespace ensonify::water {

/// Level of thermal noise as an omnidirectional receiver receives it, dB re 1 uPa^2/Hz.
///
/// NL = -15 + 20 log10(f in kHz) [Mellen1952]; it dominates above about 100 kHz in moderate wind.
double thermal_noise_level_db(double frequency_hz);

/// Level of the noise that wind makes at the sea surface, dB re 1 uPa^2/Hz; no noise (-inf dB) without wind.
///
/// Knudsen's spectra [Knudsen1948] by the rule of fives [Wenz1962]: 51 dB at 1 kHz in 5 knots, 5 dB more for each
/// doubling of the wind, 5 dB less per octave; for 2.5..40 knots (1.3..21 m/s). Knudsen's data end at 25 kHz, and above
/// 50 kHz the law is an extrapolation. In more than about 15 m/s it is too high, for bubbles swallow the noise
/// [FarmerLemon1984].
double wind_noise_level_db(double frequency_hz, double wind_speed_mps);

/// Thermal and wind noise together.
double ambient_noise_level_db(double frequency_hz, double wind_speed_mps);

/// Level in a band: + 10 log10(bandwidth) - directivity index, dB re 1 uPa^2.
double in_band_level_db(double spectral_level_db, double bandwidth_hz, double directivity_index_db);

/// Receiver's noise and losses.
struct Receiver {
  double bandwidth_hz = 10e3;
  double directivity_index_db = 0.0;    // of the receiving array, against noise from all directions
  double electronic_noise_db = -200.0;  // as if in the water at the array's face, dB re 1 uPa^2/Hz; -200 is none
};

/// Noise at the output of a beam, dB re 1 uPa^2: ambient noise less the directivity index, and the electronics' own,
/// which no array keeps out, in the receiver's band. The spectrum is taken as flat over the band.
double received_noise_level_db(double frequency_hz, double wind_speed_mps, const Receiver& receiver);

}  // namespace ensonify::water
