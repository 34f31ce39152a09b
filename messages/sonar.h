#pragma once

#include <cstdint>

#include "messages/array.h"

namespace ensonify::msg {

struct Ping {
  static constexpr const char* kType = "ping/1";
  static constexpr const char* kAbout = "What one transmission brought back, for any head.";
  std::int64_t stamp_ns = 0;
  std::int64_t ping = 0;
  double sample_period_s = 0.0;
  double first_sample_s = 0.0;
  Array<float> beam_angle_rad;
  Array<float> amplitude_upa;
  double frequency_hz = 0.0;
  double pulse_length_s = 0.0;
  double source_level_db = 0.0;
  double range_m = 0.0;
  double sound_speed_mps = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of transmission, sim time", self.stamp_ns);
    visit("ping", "1", "ping number of this head, from 0", self.ping);
    visit("sample_period_s", "s", "time between samples", self.sample_period_s);
    visit("first_sample_s", "s", "time of the first sample after transmission", self.first_sample_s);
    visit("beam_angle_rad", "rad", "receive beam axes in the head frame, from its down axis, positive to starboard",
          self.beam_angle_rad);
    visit("amplitude_upa", "uPa", "rms pressure amplitude at the receiver (beam x sample), linear", self.amplitude_upa);
    visit("frequency_hz", "Hz", "centre frequency in force", self.frequency_hz);
    visit("pulse_length_s", "s", "pulse length in force", self.pulse_length_s);
    visit("source_level_db", "dB re 1 uPa^2 at 1 m", "source level in force, on the axis, rms", self.source_level_db);
    visit("range_m", "m", "range setting in force", self.range_m);
    visit("sound_speed_mps", "m/s", "sound speed at the face as the head knows it", self.sound_speed_mps);
  }
};

struct Soundings {
  static constexpr const char* kType = "soundings/1";
  static constexpr const char* kAbout =
      "What the head made of a ping: one entry per beam. Positions use the estimated pose and the measured mounting.";
  std::int64_t stamp_ns = 0;
  std::int64_t ping = 0;
  Array<float> beam_angle_rad;
  Array<float> travel_time_s;
  Array<float> backscatter_db;
  Array<float> quality_db;
  Array<std::uint8_t> valid;
  Array<double> position_enu_m;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of transmission, sim time", self.stamp_ns);
    visit("ping", "1", "ping number of this head, from 0", self.ping);
    visit("beam_angle_rad", "rad", "receive beam axes in the head frame, positive to starboard", self.beam_angle_rad);
    visit("travel_time_s", "s", "two-way travel time of the detection", self.travel_time_s);
    visit("backscatter_db", "dB", "level of the detection re 1 uPa, uncorrected", self.backscatter_db);
    visit("quality_db", "dB", "signal to noise ratio of the detection", self.quality_db);
    visit("valid", "1", "1 where the beam has a detection; other entries of that beam mean nothing if 0", self.valid);
    visit("position_enu_m", "m",
          "sounding (beam x 3): east, north, up from chart datum, by estimate and measured mounting",
          self.position_enu_m);
  }
};

struct Transmit {
  static constexpr const char* kType = "transmit/1";
  static constexpr const char* kAbout = "A head transmitted: other heads may hear it.";
  std::int64_t stamp_ns = 0;
  std::int64_t ping = 0;
  double frequency_hz = 0.0;
  double pulse_length_s = 0.0;
  double source_level_db = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of transmission, sim time", self.stamp_ns);
    visit("ping", "1", "ping number of this head, from 0", self.ping);
    visit("frequency_hz", "Hz", "centre frequency", self.frequency_hz);
    visit("pulse_length_s", "s", "pulse length", self.pulse_length_s);
    visit("source_level_db", "dB re 1 uPa^2 at 1 m", "source level on the axis, rms", self.source_level_db);
  }
};

}  // namespace ensonify::msg
