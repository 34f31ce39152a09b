#pragma once

#include <cstdint>

#include "messages/sonar.h"

namespace ensonify::msg {

/// Bits of Soundings::flags.
enum SoundingFlag : std::uint8_t {
  kWeak = 1,       // below the detection threshold
  kCutOff = 2,     // the echo goes on where reception ended
  kOutOfGate = 4,  // outside the operator's depth or range gate
  kUncertain = 8,  // predicted uncertainty beyond what is accepted
  kSideLobe = 16,  // taken for the side lobe of another beam
};

struct Soundings {
  static constexpr const char* kType = "soundings/1";
  static constexpr const char* kAbout =
      "What the head made of a ping: one entry per beam, or one per detection where `beam` is given. Positions use the "
      "estimated pose and the measured mounting.";
  std::int64_t stamp_ns = 0;
  std::int64_t ping = 0;
  double sample_period_s = 0.0;
  Array<std::uint16_t> beam;
  Array<std::uint8_t> detection;
  Array<std::uint8_t> sector;
  Array<float> beam_angle_rad;
  Array<float> travel_time_s;
  Array<float> backscatter_db;
  Array<float> backscatter_strength_db;
  Array<float> quality_db;
  Array<float> range_sd_m;
  Array<float> angle_sd_rad;
  Array<float> window_s;
  Array<std::uint8_t> kind;
  Array<std::uint8_t> flags;
  Array<std::uint8_t> valid;
  Array<double> position_enu_m;
  Array<float> tvu_m;
  Array<float> thu_m;
  AppliedSettings applied;
  HeadTrack track;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of transmission, sim time", self.stamp_ns);
    visit("ping", "1", "ping number of this head, from 0", self.ping);
    visit("sample_period_s", "s", "time between the samples that detection used", self.sample_period_s);
    visit("beam", "1", "index of each entry's beam, rising; empty: entry i is beam i", self.beam);
    visit("detection", "1", "number of the detection within its beam, from 0, the first return first; empty: 0",
          self.detection);
    visit("sector", "1", "index of each entry's transmit sector; empty: 0", self.sector);
    visit("beam_angle_rad", "rad", "receive beam axes in the head frame, positive to starboard", self.beam_angle_rad);
    visit("travel_time_s", "s", "two-way travel time of the detection", self.travel_time_s);
    visit("backscatter_db", "dB", "level of the detection re 1 uPa, uncorrected", self.backscatter_db);
    visit(
        "backscatter_strength_db", "dB",
        "backscattering strength re 1 m^2 per m^2 that the head makes of the level: by its settings, on a flat seabed; "
        "empty: not computed",
        self.backscatter_strength_db);
    visit("quality_db", "dB", "signal to noise ratio of the detection", self.quality_db);
    visit("range_sd_m", "m", "predicted standard deviation of the range, sonar only; empty: not predicted",
          self.range_sd_m);
    visit("angle_sd_rad", "rad", "predicted standard deviation of the angle, sonar only; empty: not predicted",
          self.angle_sd_rad);
    visit("window_s", "s", "length of the window that the detection used; empty: not given", self.window_s);
    visit("kind", "1", "1 by amplitude, 2 by phase (of a blend, the one that weighs more), 0 neither; empty: 1",
          self.kind);
    visit(
        "flags", "1",
        "why an entry is not valid, added up: 1 weak, 2 cut off by the range, 4 out of the gate, 8 uncertain, 16 side "
        "lobe; empty: not given",
        self.flags);
    visit("valid", "1",
          "1 where the beam has a sounding; where 0, position_enu_m is NaN, and so is what was not measured",
          self.valid);
    visit("position_enu_m", "m",
          "sounding (beam x 3): east, north, up from chart datum, by estimate and measured mounting",
          self.position_enu_m);
    visit("tvu_m", "m",
          "predicted total vertical uncertainty of position_enu_m: 95 % of the errors are within; empty: not given",
          self.tvu_m);
    visit("thu_m", "m", "stated 95 % of the horizontal error, as a radius; empty: not given", self.thu_m);
    AppliedSettings::fields(self.applied, visit);
    HeadTrack::fields(self.track, visit);
  }
};

struct Snippets {
  static constexpr const char* kType = "snippets/1";
  static constexpr const char* kAbout =
      "The amplitudes around each detection, uncorrected: as received, no law taken out.";
  std::int64_t stamp_ns = 0;
  std::int64_t ping = 0;
  double sample_period_s = 0.0;
  Array<std::uint16_t> beam;
  Array<float> first_sample_s;
  Array<std::uint32_t> centre;
  Array<std::uint32_t> offset;
  Array<float> amplitude_upa;
  AppliedSettings applied;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of transmission, sim time", self.stamp_ns);
    visit("ping", "1", "ping number of this head, from 0", self.ping);
    visit("sample_period_s", "s", "time between samples", self.sample_period_s);
    visit("beam", "1", "index of each snippet's beam, rising; beams without a detection have none", self.beam);
    visit("first_sample_s", "s", "time of each snippet's first sample after transmission", self.first_sample_s);
    visit("centre", "1", "sample of the detection, counted from its snippet's first", self.centre);
    visit("offset", "1", "start of each snippet in amplitude_upa, and last the number of all samples", self.offset);
    visit("amplitude_upa", "uPa", "rms pressure amplitudes at the receiver, linear, snippet after snippet",
          self.amplitude_upa);
    AppliedSettings::fields(self.applied, visit);
  }
};

struct SeabedImage {
  static constexpr const char* kType = "seabed_image/1";
  static constexpr const char* kAbout =
      "Backscattering strength along the swath, as the head makes it: snippets after the corrections stated here.";
  std::int64_t stamp_ns = 0;
  std::int64_t ping = 0;
  double sample_period_s = 0.0;
  Array<std::uint16_t> beam;
  Array<float> first_sample_s;
  Array<std::uint32_t> centre;
  Array<std::uint32_t> offset;
  Array<float> strength_db;
  double spreading_db = 0.0;
  double absorption_dbpm = 0.0;
  double normal_incidence_range_m = 0.0;
  double normal_incidence_strength_db = 0.0;
  double oblique_strength_db = 0.0;
  double crossover_angle_rad = 0.0;
  bool lambert_removed = false;
  AppliedSettings applied;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of transmission, sim time", self.stamp_ns);
    visit("ping", "1", "ping number of this head, from 0", self.ping);
    visit("sample_period_s", "s", "time between samples", self.sample_period_s);
    visit("beam", "1", "index of each series' beam, rising; beams without a detection have none", self.beam);
    visit("first_sample_s", "s", "time of each series' first sample after transmission", self.first_sample_s);
    visit("centre", "1", "sample of the detection, counted from its series' first", self.centre);
    visit("offset", "1", "start of each series in strength_db, and last the number of all samples", self.offset);
    visit("strength_db", "dB", "strength re 1 m^2 per m^2 after the corrections, series after series",
          self.strength_db);
    visit("spreading_db", "dB", "S of the two-way loss S log10(R) + 2 A R that was made up for, R in m",
          self.spreading_db);
    visit("absorption_dbpm", "dB/m", "operator's absorption: A of the two-way loss that was made up for",
          self.absorption_dbpm);
    visit("normal_incidence_range_m", "m", "range of the first return, about which strengths are flattened",
          self.normal_incidence_range_m);
    visit("normal_incidence_strength_db", "dB", "strength at normal incidence that was assumed for it",
          self.normal_incidence_strength_db);
    visit("oblique_strength_db", "dB", "strength at the crossover angle and beyond that was assumed for it",
          self.oblique_strength_db);
    visit("crossover_angle_rad", "rad", "incidence up to which the first return is flattened, 0: not at all",
          self.crossover_angle_rad);
    visit("lambert_removed", "", "true when Lambert's law beyond the crossover angle was taken out too",
          self.lambert_removed);
    AppliedSettings::fields(self.applied, visit);
  }
};

}  // namespace ensonify::msg
