#pragma once

#include <cstdint>
#include <string>

#include "components/sonar/head_config.h"
#include "components/sonar/line_design.h"
#include "components/sonar/ranged_pulse.h"
#include "kernels/acoustics/array/shading.h"

namespace ensonify {

/// Rotation of a mechanically scanned head's transducer about the head's z axis. Angles from the x axis, positive to
/// starboard.
struct Scan {
  double centre_rad = 0.0;
  double width_rad = 360.0 * kDegree;  // of the sector; from 360 degrees on it turns without an end
  double step_rad = 0.9 * kDegree;
  int steps_per_ping = 1;
  bool reversing = false;  // back and forth; else always to starboard, and from the sector's end back to its start

  bool operator==(const Scan&) const = default;
  static constexpr double kDegree = 3.14159265358979323846 / 180.0;
};

/// Turned between two pings.
double stride_rad(const Scan& scan);

/// Pings from one end of the sector to the other; in a full turn, pings of the turn. At least 1.
std::int64_t pings_per_sweep(const Scan& scan);

/// Angle of the transducer at a ping, -pi..pi; the first is the sector's port end.
double scan_angle_rad(const Scan& scan, std::int64_t ping);

/// A mechanically scanned head: one transducer, a pencil or a fan, that turns step by step about the head's z axis.
struct ScanningConfig : HeadConfig {
  double frequency_hz = 750e3;
  double horizontal_beamwidth_rad = 2.0 * Scan::kDegree;  // -3 dB, one-way
  array::Shading shading;                                 // of the transducer across that width
  double vertical_beamwidth_rad = 25.0 * Scan::kDegree;   // -3 dB, one-way
  double tilt_rad = 0.0;                                  // down from the plane that it turns in
  Scan scan;
  PulseDesign pulse{.length_s = 32e-6, .most_samples = 1200};
  double source_level_db = 207.0;  // rms during the pulse, re 1 uPa at 1 m; the most that can be set
  double range_m = 20.0;           // to start with
  double longest_range_m = 50.0;
  double electronic_noise_db = -200.0;  // as sound in the water, re 1 uPa^2/Hz

  ScanningConfig() {  // what it has other defaults for than heads in general
    ping_rate_hz = 50.0;
    dead_time_s = 20e-3;
    processing_latency_s = 5e-3;
    gain_spreading_db = 0.0;
  }
  static constexpr double kFastest_hz = 200.0;
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("frequency_hz", "Hz", in(50e3, 3e6), "frequency of the tone", self.frequency_hz);
    visit("horizontal_beamwidth_deg", "deg", in(0.2, 20), "horizontal beamwidth at -3 dB, one-way",
          self.horizontal_beamwidth_rad);
    visit("shading", "shading of the transducer, which is as wide as it takes for the beamwidth", self.shading);
    visit("vertical_beamwidth_deg", "deg", in(0.2, 90), "vertical beamwidth at -3 dB, one-way",
          self.vertical_beamwidth_rad);
    visit("tilt_deg", "deg", in(-90, 90), "down from the plane that the transducer turns in", self.tilt_rad);
    visit("sector_centre_deg", "deg", in(-180, 180),
          "middle of the sector from the head's forward axis, positive to starboard", self.scan.centre_rad);
    visit("sector_width_deg", "deg", in(0.1, 360),
          "width of the sector at the start; 360: the transducer turns without an end", self.scan.width_rad);
    visit("step_deg", "deg", in(0.05, 30), "step of the transducer", self.scan.step_rad);
    visit("steps_per_ping", "", in(1, 100), "turned between two pings", self.scan.steps_per_ping);
    visit("turning", "", one_of({{"continuous", false}, {"reversing", true}}), "always to starboard, or back and forth",
          self.scan.reversing);
    PulseDesign::parameters(self.pulse, visit);
    visit("source_level_db", "dB", in(-300, kHighest_db),
          "rms during the pulse, re 1 uPa at 1 m; the most that can be set", self.source_level_db);
    visit("range_m", "m", in(0.5, 1000), "range at the start", self.range_m);
    visit("longest_range_m", "m", in(0.5, 1000), "longest range that can be set", self.longest_range_m);
    visit("electronic_noise_db", "dB", in(-200, 150), "electronic noise as sound in the water, re 1 uPa^2/Hz",
          self.electronic_noise_db);
    HeadParameters::parameters(self, visit);
    label_kinds(self, visit);
    sound_speed(self, visit);
  }
  static ScanningConfig read(ConfigReader& from, const World& world, const std::string& process);

  HeadSettings start() const;
  SettingLimits limits() const;
};

}  // namespace ensonify
