#include "kernels/acoustics/sonar_equation.h"

#include <algorithm>
#include <cmath>

namespace ensonify::sonar_equation {
namespace {

double db(double ratio) { return 10.0 * std::log10(ratio); }

/// Horizontal distance to where a sphere intersects the level seabed; 0 if it does not.
double ground_range_m(double range_m, double altitude_m) {
  return range_m > altitude_m ? std::sqrt(range_m * range_m - altitude_m * altitude_m) : 0.0;
}

}  // namespace

double two_way_loss_db(const Path& path) {
  return 4.0 * db(path.range_m) + 2.0 * path.absorption_dbpm * path.range_m + 2.0 * path.bubble_loss_db;
}

double target_level_db(double source_level_db, const Path& path, double target_strength_db) {
  return source_level_db - two_way_loss_db(path) + target_strength_db;
}

double seabed_level_db(double source_level_db, const Path& path, double backscatter_db, double area_m2) {
  return target_level_db(source_level_db, path, backscatter_db + db(area_m2));
}

double volume_level_db(double source_level_db, const Path& path, double volume_scattering_db, double solid_angle_sr,
                       double sound_speed_mps, double pulse_length_s) {
  const double volume_m3 = solid_angle_sr * path.range_m * path.range_m * sound_speed_mps * pulse_length_s / 2.0;
  return target_level_db(source_level_db, path, volume_scattering_db + db(volume_m3));
}

double sidescan_area_m2(double range_m, double altitude_m, double along_track_width_rad, double sound_speed_mps,
                        double pulse_length_s) {
  const double half_pulse_m = sound_speed_mps * pulse_length_s / 4.0;
  const double near_m = ground_range_m(range_m - half_pulse_m, altitude_m);
  const double far_m = ground_range_m(range_m + half_pulse_m, altitude_m);
  return range_m * along_track_width_rad * (far_m - near_m);
}

double multibeam_area_m2(double range_m, double beam_angle_rad, double transmit_width_rad, double receive_width_rad,
                         double sound_speed_mps, double pulse_length_s) {
  const double cosine = std::cos(beam_angle_rad);
  const double of_beam_m = range_m * receive_width_rad / (cosine * cosine);
  const double of_pulse_m = sound_speed_mps * pulse_length_s / 2.0 / std::abs(std::sin(beam_angle_rad));
  return range_m * transmit_width_rad * std::min(of_beam_m, of_pulse_m);
}

}  // namespace ensonify::sonar_equation
