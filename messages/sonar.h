#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "messages/array.h"

namespace ensonify::msg {

/// One of the transmissions that a ping consists of, where heads send several side by side or one after the other.
struct TransmitSector {
  double frequency_hz = 0.0;
  std::string pulse = "cw";
  double pulse_length_s = 0.0;
  double bandwidth_hz = 0.0;
  double source_level_db = 0.0;
  double tilt_rad = 0.0;
  double delay_s = 0.0;
  double focus_range_m = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("frequency_hz", "Hz", "centre frequency", self.frequency_hz);
    visit("pulse", "", "pulse shape of the ping", self.pulse);
    visit("pulse_length_s", "s", "pulse length", self.pulse_length_s);
    visit("bandwidth_hz", "Hz", "band that an fm pulse sweeps, 0 for cw", self.bandwidth_hz);
    visit("source_level_db", "dB re 1 uPa^2 at 1 m", "source level on the axis, rms", self.source_level_db);
    visit("tilt_rad", "rad", "steering from the head's athwartships plane, positive forward", self.tilt_rad);
    visit("delay_s", "s", "start after the ping's time of transmission", self.delay_s);
    visit("focus_range_m", "m", "range of the transmit focus, 0: not focused", self.focus_range_m);
  }
};

/// The settings that a ping was made with. In a message they stand beside its other fields.
struct AppliedSettings {
  double frequency_hz = 0.0;
  std::string pulse = "cw";
  double pulse_length_s = 0.0;
  double tapered_fraction = 0.0;
  double bandwidth_hz = 0.0;
  double source_level_db = 0.0;
  double range_m = 0.0;
  double ping_rate_hz = 0.0;
  double swath_rad = 0.0;
  std::string mode;
  double gain_spreading_db = 0.0;
  double gain_absorption_dbpm = 0.0;
  double gain_offset_db = 0.0;
  double transmit_beamwidth_rad = 0.0;
  double receive_beamwidth_rad = 0.0;
  bool roll_stabilised = false;
  bool pitch_stabilised = false;
  bool yaw_stabilised = false;
  double sound_speed_mps = 0.0;
  std::vector<TransmitSector> sectors;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("frequency_hz", "Hz", "centre frequency in force", self.frequency_hz);
    visit("pulse", "", "cw (rectangular), cw_tapered, fm_up or fm_down", self.pulse);
    visit("pulse_length_s", "s", "pulse length in force", self.pulse_length_s);
    visit("tapered_fraction", "1",
          "part of the length of a cw_tapered pulse that rises and falls, as a raised cosine; 0 for others",
          self.tapered_fraction);
    visit("bandwidth_hz", "Hz", "band that an fm pulse sweeps, 0 for cw", self.bandwidth_hz);
    visit("source_level_db", "dB re 1 uPa^2 at 1 m", "source level in force, on the axis, rms", self.source_level_db);
    visit("range_m", "m", "range setting in force", self.range_m);
    visit("ping_rate_hz", "Hz", "highest ping rate that is set", self.ping_rate_hz);
    visit("swath_rad", "rad", "full angle that the beams are spread over", self.swath_rad);
    visit("mode", "", "operating mode, in the words of the head's documentation", self.mode);
    visit("gain_spreading_db", "dB",
          "S of the gain S log10(R) + 2 A R + O that the receiver applies at range R in m, by its own sound speed",
          self.gain_spreading_db);
    visit("gain_absorption_dbpm", "dB/m", "operator's absorption: A of the gain S log10(R) + 2 A R + O",
          self.gain_absorption_dbpm);
    visit("gain_offset_db", "dB", "offset: O of the gain S log10(R) + 2 A R + O", self.gain_offset_db);
    visit("transmit_beamwidth_rad", "rad", "along-track, one-way, -3 dB", self.transmit_beamwidth_rad);
    visit("receive_beamwidth_rad", "rad", "across-track, -3 dB, not steered", self.receive_beamwidth_rad);
    visit("roll_stabilised", "", "beams are steered against the measured roll", self.roll_stabilised);
    visit("pitch_stabilised", "", "the transmission is steered against the measured pitch", self.pitch_stabilised);
    visit("yaw_stabilised", "", "the transmission is steered against the measured yaw", self.yaw_stabilised);
    visit("sound_speed_mps", "m/s", "sound speed at the face as the head knows it: it steers the beams",
          self.sound_speed_mps);
    visit("sectors", "", "transmit sectors; empty: a single one with the values above, straight, at once",
          self.sectors);
  }
};

/// Track of the head, as the instrument knows it: the navigation estimate and the measured mounting. Never the truth.
/// In a message it stands beside its other fields.
struct HeadTrack {
  Array<double> pose_time_s;
  Array<double> pose_position_enu_m;
  Array<double> pose_enu_from_head;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("pose_time_s", "s", "times after transmission of the poses; the first is 0: the pose at transmission",
          self.pose_time_s);
    visit("pose_position_enu_m", "m",
          "estimated place of the head (time x 3): east, north, up from chart datum, by the measured mounting",
          self.pose_position_enu_m);
    visit("pose_enu_from_head", "1",
          "estimated attitude of the head (time x 4): quaternion w, x, y, z, head FRD to ENU", self.pose_enu_from_head);
  }
};

struct Ping {
  static constexpr const char* kType = "ping/1";
  static constexpr const char* kAbout = "What one transmission brought back, for any head.";
  std::int64_t stamp_ns = 0;
  std::int64_t ping = 0;
  std::string kind;
  double sample_period_s = 0.0;
  double first_sample_s = 0.0;
  Array<float> beam_angle_rad;
  Array<float> amplitude_upa;
  Array<std::uint8_t> beam_sector;
  Array<std::uint16_t> amplitude_count;
  double count_upa = 0.0;
  Array<float> phase_rad;
  AppliedSettings applied;
  HeadTrack track;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of transmission, sim time", self.stamp_ns);
    visit("ping", "1", "ping number of this head, from 0", self.ping);
    visit("kind", "", "component that made it, such as multibeam or sidescan; empty: not given", self.kind);
    visit("sample_period_s", "s", "time between samples", self.sample_period_s);
    visit("first_sample_s", "s", "time of the first sample after transmission", self.first_sample_s);
    visit("beam_angle_rad", "rad",
          "receive beam axes of this ping in the head frame, positive to starboard: from its down axis, of heads "
          "that look forward (forward_looking, scanning) from its forward axis",
          self.beam_angle_rad);
    visit("amplitude_upa", "uPa",
          "rms pressure amplitude at the receiver (beam x sample), linear, the gain taken out again",
          self.amplitude_upa);
    visit("beam_sector", "1", "index of each beam's transmit sector; empty: 0", self.beam_sector);
    visit("amplitude_count", "1",
          "digitised amplitude (beam x sample) instead of amplitude_upa, linear, the gain still in it",
          self.amplitude_count);
    visit("count_upa", "uPa", "amplitude at the receiver of one count where the gain is 0 dB", self.count_upa);
    visit(
        "phase_rad", "rad",
        "phase (beam x sample) of the starboard half of the receive array over the port half, -pi..pi, about the beam "
        "axis; empty: not formed",
        self.phase_rad);
    AppliedSettings::fields(self.applied, visit);
    HeadTrack::fields(self.track, visit);
  }
};

struct BottomTrack {
  static constexpr const char* kType = "bottom_track/1";
  static constexpr const char* kAbout =
      "The first bottom return of a head, by its own echoes: what a slant range is corrected with. Never the truth.";
  std::int64_t stamp_ns = 0;
  std::int64_t ping = 0;
  bool valid = false;
  double travel_time_s = 0.0;
  double altitude_m = 0.0;
  double quality_db = 0.0;
  double sound_speed_mps = 0.0;
  Array<float> beam_travel_time_s;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of transmission, sim time", self.stamp_ns);
    visit("ping", "1", "ping number of this head, from 0", self.ping);
    visit("valid", "", "true when the bottom was found; the rest means nothing if not", self.valid);
    visit("travel_time_s", "s", "two-way time of the first bottom return, over all beams and smoothed",
          self.travel_time_s);
    visit("altitude_m", "m", "altitude: half of the two-way time at the head's sound speed", self.altitude_m);
    visit("quality_db", "dB", "step of the level at the return, over the water column's", self.quality_db);
    visit("sound_speed_mps", "m/s", "sound speed that the head used", self.sound_speed_mps);
    visit("beam_travel_time_s", "s", "first bottom return of each beam (sidescan: port, starboard), NaN: none",
          self.beam_travel_time_s);
  }
};

struct Transmit {
  static constexpr const char* kType = "transmit/1";
  static constexpr const char* kAbout = "A head transmitted: other heads may receive it.";
  std::int64_t stamp_ns = 0;
  std::int64_t ping = 0;
  double frequency_hz = 0.0;
  double pulse_length_s = 0.0;
  double bandwidth_hz = 0.0;
  double source_level_db = 0.0;
  std::int64_t next_ns = 0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of transmission, sim time; of a sector that is sent later in the ping, its own",
          self.stamp_ns);
    visit("ping", "1", "ping number of this head, from 0; equal for all sectors of a ping", self.ping);
    visit("frequency_hz", "Hz", "centre frequency", self.frequency_hz);
    visit("pulse_length_s", "s", "pulse length", self.pulse_length_s);
    visit("bandwidth_hz", "Hz", "band that an fm pulse sweeps, 0 for cw", self.bandwidth_hz);
    visit("source_level_db", "dB re 1 uPa^2 at 1 m", "source level on the axis, rms", self.source_level_db);
    visit("next_ns", "ns", "sim time at which the head intends to transmit next; 0: unknown", self.next_ns);
  }
};

/// Value of a command's setting that is to stay as it is.
inline constexpr double kUnchanged = std::numeric_limits<double>::quiet_NaN();

struct SonarSettings {
  static constexpr const char* kType = "sonar_settings/1";
  static constexpr const char* kAbout =
      "A command to a head: settings from its next ping on. NaN or empty text leaves a setting as it is.";
  std::int64_t stamp_ns = 0;
  double range_m = kUnchanged;
  double source_level_db = kUnchanged;
  double pulse_length_s = kUnchanged;
  double gain_spreading_db = kUnchanged;
  double gain_absorption_dbpm = kUnchanged;
  double gain_offset_db = kUnchanged;
  double swath_rad = kUnchanged;
  double ping_rate_hz = kUnchanged;
  std::string mode;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of the command, sim time", self.stamp_ns);
    visit("range_m", "m", "range of reception; 0: the head chooses, where it can", self.range_m);
    visit("source_level_db", "dB re 1 uPa^2 at 1 m", "source level on the axis, rms", self.source_level_db);
    visit("pulse_length_s", "s", "pulse length; 0: the head chooses, where it can", self.pulse_length_s);
    visit("gain_spreading_db", "dB", "S of the gain S log10(R) + 2 A R + O at range R in m", self.gain_spreading_db);
    visit("gain_absorption_dbpm", "dB/m", "operator's absorption: A of the gain S log10(R) + 2 A R + O",
          self.gain_absorption_dbpm);
    visit("gain_offset_db", "dB", "offset: O of the gain S log10(R) + 2 A R + O", self.gain_offset_db);
    visit("swath_rad", "rad", "full angle to spread the beams over", self.swath_rad);
    visit("ping_rate_hz", "Hz", "highest ping rate", self.ping_rate_hz);
    visit("mode", "", "operating mode, in the words of the head's documentation", self.mode);
  }
};

}  // namespace ensonify::msg
