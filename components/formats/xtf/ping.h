#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "components/formats/xtf/time.h"

namespace ensonify::formats::xtf {

/// What every packet of a ping begins with: where ship and sensor are, and what they measure.
struct PingHeader {
  Time time;
  std::uint8_t hundredths = 0;
  std::uint16_t day_of_year = 0;  // days since 1 January
  std::uint32_t event = 0;
  std::uint32_t ping = 0;
  float half_sound_speed_mps = 750;  // by custom; a value above 1000 is the whole of it
  float tide_m = 0;
  std::uint32_t spare = 0;
  std::array<float, 4> probe_hz{};  // conductivity, temperature, pressure, and degC of the pressure probe
  float conductivity = 0;           // mS/cm
  float water_temperature_degc = 0;
  float pressure_psia = 0;
  float computed_sound_speed_mps = 0;
  std::array<float, 3> magnetometer_mgauss{};
  std::array<float, 6> auxiliary{};
  float speed_log_kn = 0;
  float turbidity = 0;
  float ship_speed_kn = 0;
  float ship_heading_deg = 0;
  double ship_y = 0;  // latitude or northing, as FileHeader::navigation_units says
  double ship_x = 0;
  FixedPoint<std::uint16_t, 10> ship_altitude_m;
  FixedPoint<std::uint16_t, 10> ship_depth_m;
  std::array<std::uint8_t, 4> fix_time{};  // hour, minute, second, hundredth
  float sensor_speed_kn = 0;
  float kilometre = 0;  // along a pipeline
  double sensor_y = 0;
  double sensor_x = 0;
  std::uint16_t sonar_status = 0;
  FixedPoint<std::uint16_t, 10> range_to_fish_m;
  FixedPoint<std::uint16_t, 100> bearing_to_fish_deg;
  std::uint16_t cable_out_m = 0;
  float layback_m = 0;  // 0: the sensor's position is already that of the fish
  float cable_tension = 0;
  float sensor_depth_m = 0;
  float sensor_altitude_m = 0;
  float auxiliary_altitude_m = 0;
  float pitch_deg = 0;  // nose up
  float roll_deg = 0;   // to starboard: port up
  float heading_deg = 0;
  float heave_m = 0;  // up
  float yaw_deg = 0;
  std::uint32_t attitude_time_ms = 0;  // the clock of attitude packets
  float distance_off_track_m = 0;
  std::uint32_t fix_ms = 0;
  std::array<std::uint8_t, 4> computer_time{};  // hour, minute, second, hundredth
  std::array<FixedPoint<std::int16_t, 10, 3>, 2> fish_delta{};
  std::uint8_t fish_error = 0;
  std::uint32_t optional_offset = 0;
  std::uint8_t cable_out_hundredths = 0;
  std::array<std::uint8_t, 6> spare_2{};

  std::optional<std::int64_t> unix_ns() const { return time.unix_ns(hundredths * std::int64_t{10'000'000}); }
  double sound_speed_mps() const {
    return half_sound_speed_mps > 1000 ? double{half_sound_speed_mps} : 2.0 * half_sound_speed_mps;
  }

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.time, self.hundredths, self.day_of_year, self.event, self.ping, self.half_sound_speed_mps, self.tide_m,
         self.spare, self.probe_hz, self.conductivity, self.water_temperature_degc, self.pressure_psia,
         self.computed_sound_speed_mps, self.magnetometer_mgauss, self.auxiliary, self.speed_log_kn, self.turbidity,
         self.ship_speed_kn, self.ship_heading_deg, self.ship_y, self.ship_x, self.ship_altitude_m, self.ship_depth_m,
         self.fix_time, self.sensor_speed_kn, self.kilometre, self.sensor_y, self.sensor_x);
    wire(self.sonar_status, self.range_to_fish_m, self.bearing_to_fish_deg, self.cable_out_m, self.layback_m,
         self.cable_tension, self.sensor_depth_m, self.sensor_altitude_m, self.auxiliary_altitude_m, self.pitch_deg,
         self.roll_deg, self.heading_deg, self.heave_m, self.yaw_deg, self.attitude_time_ms, self.distance_off_track_m,
         self.fix_ms, self.computer_time, self.fish_delta, self.fish_error, self.optional_offset,
         self.cable_out_hundredths, self.spare_2);
  }
  bool operator==(const PingHeader&) const = default;
};

/// One side of one transmission. Port is stored far range first, starboard near range first.
struct Channel {
  std::uint16_t number = 0;  // index of its ChannelInfo
  std::uint16_t downsample_method = 0;
  float slant_range_m = 0;
  float ground_range_m = 0;
  float delay_s = 0;
  float duration_s = 0;
  float seconds_per_ping = 0;
  std::uint16_t processing = 0;
  std::uint16_t frequency_khz = 0;
  std::uint16_t initial_gain = 0;
  std::uint16_t gain = 0;
  std::uint16_t bandwidth_khz = 0;
  std::uint32_t contact = 0;
  std::uint16_t contact_class = 0;
  std::uint8_t contact_sub_number = 0;
  std::uint8_t contact_type = 0;
  std::uint32_t sample_count = 0;  // 0: as the file's header says
  std::uint16_t millivolt_scale = 0;
  float contact_time_off_track_s = 0;
  std::uint8_t contact_close = 0;
  std::uint8_t spare = 0;
  float vsop = 0;
  std::int16_t weight = 0;  // samples are to be scaled by 2 to the power of -weight
  std::array<std::uint8_t, 4> spare_2{};
  Bytes samples;  // as ChannelInfo says
  // Not in the packet, but in the file's header: how many samples there are where sample_count is 0, and their size.
  std::uint32_t default_count = 0;
  std::uint16_t bytes_per_sample = 2;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.number, self.downsample_method, self.slant_range_m, self.ground_range_m, self.delay_s, self.duration_s,
         self.seconds_per_ping, self.processing, self.frequency_khz, self.initial_gain, self.gain, self.bandwidth_khz,
         self.contact, self.contact_class, self.contact_sub_number, self.contact_type, self.sample_count,
         self.millivolt_scale, self.contact_time_off_track_s, self.contact_close, self.spare, self.vsop, self.weight,
         self.spare_2);
    wire.resize(self.samples, self.sample_bytes());
    wire.each(self.samples);
  }
  bool operator==(const Channel&) const = default;

  std::uint64_t sample_bytes() const {
    return std::uint64_t{sample_count > 0 ? sample_count : default_count} * bytes_per_sample;
  }
};

/// A ping of a sidescan. The packet states how many channels it has.
struct SonarPing {
  static constexpr std::uint8_t kType = 0;
  PingHeader header;
  std::vector<Channel> channels;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.header);
    wire.each(self.channels);
  }
  bool operator==(const SonarPing&) const = default;
};

}  // namespace ensonify::formats::xtf
