#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/echo/image.h"

namespace ensonify::echo {

/// Time-varying gain as an operator sets it: it acts on signal and noise alike and knows nothing of the true water.
///
///   gain_db = spreading log10(R) + 2 absorption R + slope R / 100 m + offset,  R = c t / 2 in metres,
///
/// R no nearer than start_range_m and no farther than stop_range_m (the gain is held beyond), then limited to
/// min_db..max_db and rounded to step_db. Kongsberg: spreading "X" 20-40, R2Sonic 0-60 (30 typical) with gain in 2 dB
/// steps, EdgeTech dB per 100 m; 40 suits targets, 30 a seabed, 20 volume echoes.
struct TvgLaw {
  double spreading_db = 30.0;    // per decade of range
  double absorption_dbpm = 0.0;  // as the operator assumes
  double slope_db_per_100m = 0.0;
  double offset_db = 0.0;
  double start_range_m = 1.0;
  double stop_range_m = 1e9;
  double min_db = -300.0, max_db = 300.0;
  double step_db = 0.0;             // 0: continuous
  double sound_speed_mps = 1500.0;  // as the instrument assumes
};

/// The gain in force at each sample, dB; resized. Throws std::invalid_argument for a start range that is not positive,
/// limits or ranges the wrong way round, or a negative step.
void tvg_db(const TvgLaw& law, const Sampling& sampling, std::vector<float>& gain_db);

/// Multiplies amplitudes by the gain, row after row of one value per sample. Throws std::invalid_argument unless the
/// rows are whole.
void apply_gain(std::span<const float> gain_db, std::span<float> amplitude);

/// Amplitudes as counts 0..2^bits - 1 of `step`, the nearest; what is beyond takes the end value, as in a receiver in
/// saturation. An error of rounding is uniform: its mean square is step^2 / 12. Resized. Throws std::invalid_argument
/// for bits outside 1..16 or a step that is not positive.
void amplitude_counts(std::span<const float> amplitude, double step, int bits, std::vector<std::uint16_t>& counts);

}  // namespace ensonify::echo
