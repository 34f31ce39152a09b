#pragma once

namespace ensonify::survey {

/// Pings a second of a head that waits for its farthest echo: 1 / (2 range / sound speed + dead time), not above
/// `highest_hz`. range_m > 0, dead_s >= 0.
double ping_rate_hz(double range_m, double sound_speed_mps, double dead_s, double highest_hz);

/// Length of a beam's footprint along the track straight below: 2 depth tan(width / 2).
double footprint_m(double depth_m, double along_width_rad);

/// Highest speed over ground at which a feature of a length along the track is hit by at least `pings` pings, wherever
/// they fall: (length + footprint) rate / pings, where a ping counts whose footprint touches the feature; with a
/// footprint of 0 only pings whose axis hits it count. pings >= 1.
double fastest_for_feature_mps(double feature_m, double footprint_m, double rate_hz, int pings);

/// Soundings across a feature of a width across the track, at least: of beams equally spaced over the bottom by
/// `beam_spacing_m`.
int soundings_across(double feature_m, double beam_spacing_m);

}  // namespace ensonify::survey
