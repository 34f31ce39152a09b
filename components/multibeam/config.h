#pragma once

#include <string>

#include "components/runtime/config/scenario.h"
#include "components/runtime/sim_time.h"

namespace ensonify {

class ConfigReader;

/// A Mills-cross multibeam echo sounder: a transmit line along the head's x axis, a receive line along its y axis.
struct MultibeamConfig {
  enum class Spacing { kEquiangle, kEquidistant };

  double frequency_hz = 300e3;
  int beams = 256;
  double swath_rad = 130.0 * kDegree;
  Spacing spacing = Spacing::kEquiangle;
  double transmit_beamwidth_rad = 1.0 * kDegree;  // along-track, one-way, -3 dB
  double receive_beamwidth_rad = 1.0 * kDegree;   // across-track at nadir
  double pulse_length_s = 100e-6;                 // rectangular CW
  double source_level_db = 215.0;                 // rms during the pulse, re 1 uPa at 1 m
  bool roll_stabilised = true;                    // beams and fan are steered against the measured roll
  bool pitch_stabilised = true;                   // the fan is steered against the measured pitch
  double attitude_latency_s = 0.0;                // of the motion sensor
  bool auto_range = true;                         // else range_m always
  double range_m = 200.0;                         // the longest range that is listened to
  double ping_rate_hz = 10.0;                     // at most; the interval is never less than 2 R / c + dead time
  double dead_time_s = 0.5e-3;
  double processing_latency_s = 20e-3;   // from the last echo to the published ping
  double sample_rate_hz = 20e3;          // of the complex envelope, at least 2 / pulse length
  double quality = 0.25;                 // of the rays (trace::RaySettings)
  double detection_threshold_db = 13.0;  // signal to noise ratio of a sounding, at least
  int amplitude_every = 1;               // ping/1 is published for every n-th ping; soundings for all

  // From the scenario.
  Scenario world;
  std::string process;
  HeadMounting mounting;
  double sound_speed_mps = 1500.0;  // at the mission's depth as the instrument knows it: it turns range into time

  static MultibeamConfig read(ConfigReader& from, const Scenario& scenario, const std::string& process);
  /// The parameters of its own, which default.yaml lists.
  bool operator==(const MultibeamConfig& other) const;

  Rate ping_rate() const;
  /// From transmission to the last echo of this range.
  SimTime listening_time(double of_range_m) const {
    return from_seconds(2.0 * of_range_m / sound_speed_mps + pulse_length_s);
  }
  int samples(double of_range_m) const;

  static constexpr double kDegree = 3.14159265358979323846 / 180.0;
};

}  // namespace ensonify
