#pragma once

namespace ensonify::sonar_equation {

/// Closed forms of the active sonar equation [Lurton2010, ch. 3]: a straight path, one absorption, a plane seabed, mean
/// levels. Rays, meshes and beams are judged against them.
///
/// Levels are 10 log10 of mean-square pressure re 1 uPa^2: the equivalent plane wave on the beam's axis. The source
/// level is the rms level during the pulse at 1 m on the transmitter's axis. Angles are from nadir (beam) or from the
/// seabed (grazing).

/// The way to a target and back.
struct Path {
  double range_m;
  double absorption_dbpm = 0.0;
  double bubble_loss_db = 0.0;  // one way, stated by the user: bubbles under the hull or in a wake
};

/// 40 log10 R + 2 alpha R + 2 x bubble loss, dB.
double two_way_loss_db(const Path& path);

/// Echo of a point target on the axes of both patterns: SL - loss + TS, with TS in dB re 1 m^2.
double target_level_db(double source_level_db, const Path& path, double target_strength_db);

/// Echo of a patch of seabed: SL - loss + Sb + 10 log10(area). backscatter_db is the strength per m^2 at the patch's
/// grazing angle.
double seabed_level_db(double source_level_db, const Path& path, double backscatter_db, double area_m2);

/// Reverberation of scatterers that fill the beam: SL - loss + Sv + 10 log10(solid angle R^2 c tau / 2), where the
/// solid angle is the integral of the product of both patterns, and tau the pulse length.
double volume_level_db(double source_level_db, const Path& path, double volume_scattering_db, double solid_angle_sr,
                       double sound_speed_mps, double pulse_length_s);

/// Ratio of the equivalent width of a uniform line to its 3 dB width: the integral of the pattern over angle, for the
/// line used one way (sinc^2) or both ways (sinc^4, as a ratio to the one-way 3 dB width).
constexpr double kOneWayWidth = 1.1288;
constexpr double kTwoWayWidth = 0.7525;

/// Area, in m^2, that a sidescan receives at once: a strip of a level seabed. Its length is range times the equivalent
/// two-way width along track; it reaches from where the sphere of range R - c tau/4 cuts the seabed to where R + c
/// tau/4 does, so it holds at nadir too. No area before the first bottom echo.
double sidescan_area_m2(double range_m, double altitude_m, double along_track_width_rad, double sound_speed_mps,
                        double pulse_length_s);

/// Area, in m^2, that a beam of a Mills cross receives on a level seabed: transmit width along track; across track the
/// smaller of the beam's footprint R width / cos^2(angle), where the steered array has widened by 1 / cos, and the
/// pulse's c tau/2 / sin(angle). Equivalent widths at broadside. An upper bound: by 1.2 dB where both are equal, by
/// less than 0.15 dB beyond 35 degrees (for 1 degree and 100 us at 20 m).
double multibeam_area_m2(double range_m, double beam_angle_rad, double transmit_width_rad, double receive_width_rad,
                         double sound_speed_mps, double pulse_length_s);

}  // namespace ensonify::sonar_equation
