#pragma once

namespace ensonify::water {

/// Level of thermal noise as an omnidirectional receiver hears it, dB re 1 uPa^2/Hz.
///
/// NL = -15 + 20 log10(f in kHz) [Mellen1952]; it dominates above about 100 kHz in moderate wind.
double thermal_noise_level_db(double frequency_hz);

/// Level in a band: + 10 log10(bandwidth) - directivity index, dB re 1 uPa^2.
double in_band_level_db(double spectral_level_db, double bandwidth_hz, double directivity_index_db);

}  // namespace ensonify::water
