#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "messages/array.h"

namespace ensonify::msg {

struct View {
  static constexpr const char* kType = "view/1";
  static constexpr const char* kAbout =
      "A ping as a picture for viewers: levels of beams over range in steps of half a decibel. In no record.";
  std::int64_t stamp_ns = 0;
  std::int64_t ping = 0;
  std::string kind;
  std::string beam_axis = "down";
  Array<std::uint8_t> level;
  double level_floor_db = 0.0;
  double level_step_db = 0.5;
  bool peak = false;
  double first_range_m = 0.0;
  double cell_m = 0.0;
  Array<float> beam_angle_rad;
  double sound_speed_mps = 0.0;
  double range_m = 0.0;
  double frequency_hz = 0.0;
  double pulse_length_s = 0.0;
  double source_level_db = 0.0;
  double gain_spreading_db = 0.0;
  double gain_absorption_dbpm = 0.0;
  double added_spreading_db = 0.0;
  double added_absorption_dbpm = 0.0;
  std::array<double, 3> position_enu_m{};
  std::array<double, 4> enu_from_head{};
  double ground_altitude_m = 0.0;
  std::int64_t left_out = 0;
  Array<float> find_angle_rad;
  Array<float> find_range_m;
  Array<std::uint8_t> find_kind;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of transmission, sim time", self.stamp_ns);
    visit("ping", "1", "ping number of this head, from 0", self.ping);
    visit("kind", "", "component that made the ping, as in ping/1", self.kind);
    visit("beam_axis", "", "axis of the head from which beam angles count: down or forward", self.beam_axis);
    visit("level", "1",
          "level of each cell (beam x cell), 0: nothing was received, n: level_floor_db + (n - 1) level_step_db",
          self.level);
    visit("level_floor_db", "dB re 1 uPa", "received level, rms, with the added gain, of the value 1",
          self.level_floor_db);
    visit("level_step_db", "dB", "step between values", self.level_step_db);
    visit("peak", "", "choice of a cell's level: true its strongest sample, false the mean of their powers", self.peak);
    visit("first_range_m", "m", "slant range of the near edge of the first cell", self.first_range_m);
    visit("cell_m", "m", "length of a cell in slant range", self.cell_m);
    visit("beam_angle_rad", "rad", "receive beam axes in the head frame, from beam_axis, positive to starboard",
          self.beam_angle_rad);
    visit("sound_speed_mps", "m/s", "sound speed by which times became ranges: the head's own", self.sound_speed_mps);
    visit("range_m", "m", "range setting in force", self.range_m);
    visit("frequency_hz", "Hz", "centre frequency in force", self.frequency_hz);
    visit("pulse_length_s", "s", "pulse length in force", self.pulse_length_s);
    visit("source_level_db", "dB re 1 uPa^2 at 1 m", "source level in force, on the axis, rms", self.source_level_db);
    visit("gain_spreading_db", "dB", "S of the head's own gain S log10(R) + 2 A R, for a display that wants it",
          self.gain_spreading_db);
    visit("gain_absorption_dbpm", "dB/m", "absorption A of the head's own gain", self.gain_absorption_dbpm);
    visit("added_spreading_db", "dB",
          "S of the gain S log10(R) + 2 A R that was added for display, R in m and no nearer than 1 m",
          self.added_spreading_db);
    visit("added_absorption_dbpm", "dB/m", "absorption A of the gain that was added", self.added_absorption_dbpm);
    visit("position_enu_m", "m", "estimated place of the head at transmission: east, north, up from chart datum",
          self.position_enu_m);
    visit("enu_from_head", "1",
          "estimated attitude of the head at transmission: quaternion w, x, y, z; all 0: not known",
          self.enu_from_head);
    visit("ground_altitude_m", "m",
          "altitude above a level seabed by which ranges lie on the ground; 0: they are slant ranges",
          self.ground_altitude_m);
    visit("left_out", "1", "number of pictures that were left out so far because the run waited for the head",
          self.left_out);
    visit("find_angle_rad", "rad", "beam axes of the ping's valid detections; empty: none are known",
          self.find_angle_rad);
    visit("find_range_m", "m", "slant range of each of these detections, by the head's own sound speed",
          self.find_range_m);
    visit("find_kind", "1", "kind of each of these detections: 1 by amplitude, 2 by phase, 0 neither", self.find_kind);
  }
};

}  // namespace ensonify::msg
