#pragma once

#include <string>
#include <vector>

#include "components/sonar/head_config.h"
#include "kernels/acoustics/array/shading.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/survey/uncertainty/sounding.h"

namespace ensonify {

class ConfigReader;

/// Parameters of default.yaml besides those of all heads.
struct MultibeamParameters {
  enum class Spacing { kEquiangle, kEquidistant, kHighDensity };

  /// One of the transmissions that a ping consists of. They share the swath from port to starboard.
  struct Sector {
    double share = 1.0;  // of the swath, over the sum of all shares
    double frequency_hz = 0.0;
    double tilt_rad = 0.0;  // of its fan, forward
    double delay_s = 0.0;   // after the ping's time of transmission

    bool operator==(const Sector&) const = default;
  };

  /// seabed_image/1, and the seabed that it is flattened by.
  struct Image {
    bool published = false;
    double normal_strength_db = -15.0;  // at normal incidence
    double oblique_strength_db = -25.0;
    double crossover_rad = 25.0 * kDegree;  // Lambert's law takes over there

    bool operator==(const Image&) const = default;
  };

  /// Terms of the stated uncertainty of soundings besides the errors of detection and estimate.
  struct Uncertainty {
    uncertainty::Sources sources{.cast_mps = 0.3,
                                 .face_mps = 0.05,
                                 .lever_arm_m = {0.005, 0.005, 0.005},
                                 .roll_rad = 0.01 * kDegree,
                                 .pitch_rad = 0.03 * kDegree,
                                 .yaw_rad = 0.03 * kDegree,
                                 .position_latency_s = 0.005,
                                 .attitude_latency_s = 0.0005,
                                 .along_rad = 0.1 * kDegree};
    // Of an estimate that does not state.
    double position_m = 0.02;  // each horizontal axis
    double height_m = 0.02;
    double level_rad = 0.02 * kDegree;
    double heading_rad = 0.05 * kDegree;

    uncertainty::Navigation unstated() const;
    bool operator==(const Uncertainty&) const = default;
  };

  static constexpr double kDegree = 3.14159265358979323846 / 180.0;

  double frequency_hz = 300e3;
  int beams = 256;
  double swath_rad = 130.0 * kDegree;
  Spacing spacing = Spacing::kEquiangle;
  int soundings = 0;                              // of high density; 0: twice the beams
  int detections_per_beam = 1;                    // at most
  double transmit_beamwidth_rad = 1.0 * kDegree;  // along-track, one-way, -3 dB
  double receive_beamwidth_rad = 1.0 * kDegree;   // across-track at nadir
  // Of both lines, at these widths. With a uniform receive line the outermost beams receive the nadir's echo through
  // its side lobes stronger than their own in some 60 m of water; with a uniform transmit line soundings of a level
  // seabed are too deep by what comes from far fore and aft (docs/physics/acoustics/detection.md).
  array::Shading transmit_shading{array::Shading::Window::kTaylor, 30.0, 4};
  array::Shading receive_shading{array::Shading::Window::kTaylor, 30.0, 4};
  double back_loss_db = 40.0;           // one-way, behind the face
  double electronic_noise_db = -200.0;  // of each element, as sound in the water, re 1 uPa^2/Hz
  std::vector<Sector> sectors;          // from port to starboard; empty: one transmission over the swath
  double sector_rejection_db = 80.0;    // by a sector's filter, of what lies outside its band
  bool chirp = false;                   // a linear sweep and its matched filter; else a tone
  double pulse_length_s = 100e-6;
  double tapered_fraction = 0.0;  // of a tone's length that rises and falls; its level is that in between
  double bandwidth_hz = 0.0;      // that a chirp sweeps
  echo::Window window = echo::Window::kHamming;  // of its matched filter
  double source_level_db = 215.0;                // rms during the pulse, re 1 uPa at 1 m; the most that can be set
  bool roll_stabilised = true;                   // beams and sectors are steered against the measured roll
  bool pitch_stabilised = true;                  // fans are steered against the measured pitch
  bool yaw_stabilised = false;                   // and against the measured heading, from its mean
  double heading_mean_s = 20.0;                  // time constant of that mean
  double attitude_latency_s = 0.0;               // of the motion sensor
  bool auto_range = true;                        // else range_m, to start with
  double range_m = 200.0;                        // the longest range of reception
  double sample_rate_hz = 20e3;                  // of the complex envelope, at least two for what a pulse resolves
  double detection_threshold_db = 13.0;          // signal to noise ratio of a sounding, at least
  double least_range_m = 2.0;                    // nearer, nothing is taken for the seabed
  bool refuse_second_echo = true;                // by way of the surface, where it stands for the seabed
  std::string mode = "bathymetry";               // or water_column: every ping with amplitude and phase
  int amplitude_every = 1;                       // ping/1 is published for every n-th ping; soundings for all
  int phase_every = 0;                           // and has the phase in every n-th ping; 0: never
  bool snippets = false;                         // snippets/1 of every ping
  Image image;
  Uncertainty uncertainty;

  bool operator==(const MultibeamParameters&) const = default;
};

/// A Mills-cross multibeam echo sounder: a transmit line along the head's x axis, a receive line along its y axis. Its
/// sound speed is that at the mission's depth as the instrument knows it: it turns range into time. The absorption of
/// its gain is the operator's: soundings and images are made with it too.
struct MultibeamConfig : HeadConfig, MultibeamParameters {
  MultibeamConfig() {  // what it has other defaults for than heads in general
    dead_time_s = 0.5e-3;
    gain_absorption_dbpm = 0.07;
    quality = 0.25;
  }
  static MultibeamConfig read(ConfigReader& from, const World& world, const std::string& process);
  /// Parameters only.
  bool operator==(const MultibeamConfig& other) const {
    return same_parameters(*this, other) && MultibeamParameters::operator==(other);
  }

  /// Settings that it starts with, and what a command can make of them.
  HeadSettings start() const;
  SettingLimits limits() const;

  /// The sectors as given, or the one that a head without sectors has.
  std::vector<Sector> all_sectors() const;

  /// Echo of one point behind the receiver's filter.
  echo::Pulse pulse(double of_length_s) const;
  /// Duration of a point's echo: of a tone its length, of a chirp 1 / bandwidth. Range resolution is half of it times
  /// c.
  double resolved_s(double of_pulse_length_s) const { return chirp ? 1.0 / bandwidth_hz : of_pulse_length_s; }
  /// From transmission to the end of the last echo.
  double reception_s(double of_range_m, double of_pulse_length_s) const;
  int samples(double of_range_m, double of_pulse_length_s) const;
  /// With the longest range and pulse that can be set.
  double longest_reception_s() const;
  int most_samples() const;

 private:
  double last_start_s(double of_range_m) const;  // of the last echo
};

}  // namespace ensonify
