#pragma once

#include <string>
#include <vector>

#include "components/sonar/head_config.h"
#include "components/sonar/line_design.h"
#include "components/sonar/ranged_pulse.h"
#include "kernels/acoustics/array/shading.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/survey/uncertainty/sounding.h"

namespace ensonify {

/// Parameters of default.yaml besides those of all heads.
struct MultibeamParameters {
  enum class Spacing { kEquiangle, kEquidistant, kHighDensity };

  /// One of the transmissions that a ping consists of. They share the swath from port to starboard.
  struct Sector {
    double share = 1.0;  // of the swath, over the sum of all shares
    double frequency_hz = 0.0;
    double tilt_rad = 0.0;  // of its fan, forward
    double delay_s = 0.0;   // after the ping's time of transmission

    template <class Self, class Visit>
    static void parameters(Self& self, Visit&& visit) {
      visit("share", "", in(0.01, 100), "share of the swath, over the sum of all shares", self.share);
      visit("frequency_hz", "Hz", computed(in(50e3, 1e6)), "left out: the head's", self.frequency_hz);
      visit("tilt_deg", "deg", in(-20, 20), "tilt of the sector's fan, forward", self.tilt_rad);
      visit("delay_s", "s", in(0, 0.1), "delay after the ping's time of transmission", self.delay_s);
    }
  };

  /// seabed_image/1, and the seabed that it is flattened by.
  struct Image {
    bool published = false;
    double normal_strength_db = -15.0;  // at normal incidence
    double oblique_strength_db = -25.0;
    double crossover_rad = 25.0 * kDegree;  // Lambert's law takes over there

    template <class Self, class Visit>
    static void parameters(Self& self, Visit&& visit) {
      visit("published", "", any(), "seabed_image/1 for every ping", self.published);
      visit("normal_strength_db", "dB", in(-80, 20),
            "strength of the seabed that it is flattened by, at normal incidence", self.normal_strength_db);
      visit("oblique_strength_db", "dB", in(-80, 20),
            "strength that it is flattened by at oblique incidence, with Lambert's law", self.oblique_strength_db);
      visit("crossover_deg", "deg", in(1, 60), "incidence from which on the oblique strength holds",
            self.crossover_rad);
    }
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

    template <class Self, class Visit>
    static void parameters(Self& self, Visit&& visit) {
      visit("position_m", "m", in(0, 1000), "sigma of an estimate that does not state its own: east and north each",
            self.position_m);
      visit("height_m", "m", in(0, 1000), "sigma of the height, of an estimate that does not state its own",
            self.height_m);
      visit("level_deg", "deg", in(0, 10), "sigma of roll and pitch, of an estimate that does not state its own",
            self.level_rad);
      visit("heading_deg", "deg", in(0, 10), "sigma of the heading, of an estimate that does not state its own",
            self.heading_rad);
      visit("heave_m", "m", in(0, 10), "sigma of heave, where the estimate's height does not hold it",
            self.sources.heave_m);
      visit("draught_m", "m", in(0, 10), "sigma of the draught, where the estimate's height does not hold it",
            self.sources.draught_m);
      visit("squat_m", "m", in(0, 10), "sigma of squat, where the estimate's height does not hold it",
            self.sources.squat_m);
      visit("tide_m", "m", in(0, 10), "sigma of the tide, where the estimate's height does not hold it",
            self.sources.tide_m);
      visit("cast_mps", "m/s", in(0, 100), "sigma of the applied sound speed profile, all of it",
            self.sources.cast_mps);
      visit("face_mps", "m/s", in(0, 100), "sigma of the sound speed at the face", self.sources.face_mps);
      visit("lever_arm_m", "m", in(0, 10), "forward, starboard, down", self.sources.lever_arm_m);
      visit("roll_deg", "deg", in(0, 10), "sigma of the mounting's roll, as a patch test leaves it",
            self.sources.roll_rad);
      visit("pitch_deg", "deg", in(0, 10), "sigma of the mounting's pitch", self.sources.pitch_rad);
      visit("yaw_deg", "deg", in(0, 10), "sigma of the mounting's yaw", self.sources.yaw_rad);
      visit("position_latency_s", "s", in(0, 10), "sigma of the latency of east and north",
            self.sources.position_latency_s);
      visit("attitude_latency_s", "s", in(0, 10), "sigma of the latency of attitude and heave",
            self.sources.attitude_latency_s);
      visit("along_deg", "deg", in(0, 10),
            "sigma of the angle from the plane of the transmit beam to where the echo came from",
            self.sources.along_rad);
    }
  };

  static constexpr double kLongestPulse_s = 10e-3;
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
  std::string instrument = "generic";            // class whose settings these are
  std::string mode = "bathymetry";               // or water_column: every ping with amplitude and phase
  int amplitude_every = 1;                       // ping/1 is published for every n-th ping; soundings for all
  int phase_every = 0;                           // and has the phase in every n-th ping; 0: never
  bool snippets = false;                         // snippets/1 of every ping
  Image image;
  Uncertainty uncertainty;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("frequency_hz", "Hz", in(50e3, 1e6), "centre frequency", self.frequency_hz);
    visit("instrument", "", one_of({"generic", "em2040", "t50", "r2sonic2024", "norbit_iwbms"}),
          "class of instruments whose settings these are; what files a logger writes follows from it", self.instrument);
    visit("beams", "", in(2, 1024), "across the track", self.beams);
    visit("swath_deg", "deg", in(1, 170), "width of the swath at the start", self.swath_rad);
    visit("spacing", "",
          one_of({{"equiangle", Spacing::kEquiangle},
                  {"equidistant", Spacing::kEquidistant},
                  {"high_density", Spacing::kHighDensity}}),
          "equidistant: equal distances on a flat seabed; high_density: equiangle beams, soundings equidistant",
          self.spacing);
    visit("soundings", "", in(0, 2048),
          "number of soundings with high_density, at least as many as beams; 0: twice as many", self.soundings);
    visit("detections_per_beam", "", in(1, 8), "detections of a beam, at most", self.detections_per_beam);
    visit("transmit_beamwidth_deg", "deg", in(0.1, 20), "along-track, one-way, -3 dB", self.transmit_beamwidth_rad);
    visit("receive_beamwidth_deg", "deg", in(0.1, 20), "across-track at nadir; a steered beam is wider by 1 / cos",
          self.receive_beamwidth_rad);
    visit("transmit_shading", "shading of the transmit line, which is as long as it takes for its width",
          self.transmit_shading);
    visit("receive_shading", "shading of the receive line, which is as long as it takes for its width",
          self.receive_shading);
    visit("back_loss_db", "dB", in(0, 100), "one-way, behind the face", self.back_loss_db);
    visit("electronic_noise_db", "dB", in(-200, 150),
          "electronic noise of each element, as sound in the water, re 1 uPa^2/Hz", self.electronic_noise_db);
    visit("sectors", "transmissions of a ping, from port to starboard; none: one over the whole swath", self.sectors);
    visit("sector_rejection_db", "dB", in(0, 200),
          "rejection by each sector's filter, of the other sectors' echoes outside its band", self.sector_rejection_db);
    visit("pulse", "", one_of({{"tone", false}, {"chirp", true}}), "a linear sweep and its matched filter, or a tone",
          self.chirp);
    visit("pulse_length_s", "s", in(5e-6, kLongestPulse_s), "length of the pulse at the start", self.pulse_length_s);
    visit("tapered_fraction", "", in(0, 1), kTaperAbout, self.tapered_fraction);
    visit("bandwidth_hz", "Hz", in(0, 500e3), "bandwidth that a chirp sweeps; it resolves c / 2B", self.bandwidth_hz);
    visit("window", "", filter_windows(), "window of a chirp's matched filter", self.window);
    visit("source_level_db", "dB", in(-300, HeadParameters::kHighest_db),
          "rms during the pulse, re 1 uPa at 1 m; the most that can be set", self.source_level_db);
    visit("roll_stabilised", "", any(),
          "beams and sectors are steered against the measured roll, where there is an attitude", self.roll_stabilised);
    visit("pitch_stabilised", "", any(), "fans are steered against the measured pitch", self.pitch_stabilised);
    visit("yaw_stabilised", "", any(), "the fans of sectors are steered against the measured heading, from its mean",
          self.yaw_stabilised);
    visit("heading_mean_s", "s", in(0.1, 1000), "time constant of the mean heading", self.heading_mean_s);
    visit("attitude_latency_s", "s", in(0, 1), "latency of the motion sensor", self.attitude_latency_s);
    visit("auto_range", "", any(), "range follows the last detections, never beyond range_m; false: range_m",
          self.auto_range);
    visit("range_m", "m", in(1, 2000), "the longest range of reception", self.range_m);
    visit("sample_rate_hz", "Hz", in(1e3, 1e6),
          "rate of the complex envelope, at least 2 / pulse length of a tone, 2 x bandwidth of a chirp",
          self.sample_rate_hz);
    visit("detection_threshold_db", "dB", in(0, 60), "signal to noise ratio of a sounding, at least",
          self.detection_threshold_db);
    visit("least_range_m", "m", in(0, 2000),
          "range below which nothing is taken for the seabed: the surface above a shallow head, ringing",
          self.least_range_m);
    visit("refuse_second_echo", "", any(),
          "a return from twice the depth that the beams about it detect is not the seabed", self.refuse_second_echo);
    visit("mode", "", one_of({"bathymetry", "water_column"}), "water_column: ping/1 for every ping, with phase",
          self.mode);
    visit("amplitude_every", "", in(1, 1'000'000), "ping/1 is published for every n-th ping; soundings/1 for all",
          self.amplitude_every);
    visit("phase_every", "", in(0, 1'000'000), "ping/1 is published with phase for every n-th ping; 0: never",
          self.phase_every);
    visit("snippets", "", any(), "snippets/1 for every ping", self.snippets);
    visit("seabed_image", "seabed_image/1, and the seabed that it is flattened by", self.image);
    visit("uncertainty", "standard deviations that make tvu_m and thu_m of soundings/1, all of them assumed",
          self.uncertainty);
  }
};

/// A Mills-cross multibeam echo sounder: a transmit line along the head's x axis, a receive line along its y axis. Its
/// sound speed is that at the mission's depth as the instrument knows it: it turns range into time. The absorption of
/// its gain is the operator's: soundings and images are made with it too.
struct MultibeamConfig : HeadConfig, MultibeamParameters {
  MultibeamConfig() {  // what it has other defaults for than heads in general
    dead_time_s = 0.5e-3;
    gain_absorption_dbpm = 0.07;
  }
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    MultibeamParameters::parameters(self, visit);
    HeadParameters::parameters(self, visit);
    energy_labels(self, visit);
  }
  static MultibeamConfig read(ConfigReader& from, const World& world, const std::string& process);

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
