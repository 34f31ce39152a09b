#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "components/formats/layout.h"

namespace ensonify::formats::all {

/// Installation parameters: 'I' opens a file, 'i' closes it.
struct Installation {
  static constexpr std::string_view kTypes = "Ii";
  std::uint16_t secondary_serial = 0;  // of the second head; 0: there is none
  std::string text;                    // KEY=value, each ended by a comma; perhaps zeros at the end

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.secondary_serial);
    wire.rest(self.text);
  }
  bool operator==(const Installation&) const = default;
};

/// Settings in force from this time on.
struct Runtime {
  static constexpr std::string_view kTypes = "R";
  std::uint8_t operator_status = 0;
  std::uint8_t processor_status = 0;
  std::uint8_t bsp_status = 0;
  std::uint8_t head_status = 0;
  std::uint8_t mode = 0;
  std::uint8_t filter = 0;
  std::uint16_t minimum_depth_m = 0;
  std::uint16_t maximum_depth_m = 0;
  FixedPoint<std::uint16_t, 100> absorption_dbpkm;
  std::uint16_t pulse_length_us = 0;
  FixedPoint<std::uint16_t, 10> transmit_width_deg;
  std::int8_t transmit_power_db = 0;  // re maximum
  FixedPoint<std::uint8_t, 10> receive_width_deg;
  FixedPoint<std::uint8_t, 1, 50> receive_bandwidth_hz;
  std::uint8_t mode_2 = 0;
  std::uint8_t tvg_crossover_deg = 0;
  std::uint8_t sound_speed_source = 0;  // 0 sensor, 1 manual, 2 profile
  std::uint16_t maximum_port_m = 0;
  std::uint8_t beam_spacing = 0;
  std::uint8_t maximum_port_deg = 0;
  std::uint8_t stabilisation = 0;  // bits of yaw and pitch
  std::uint8_t maximum_starboard_deg = 0;
  std::uint16_t maximum_starboard_m = 0;
  FixedPoint<std::int16_t, 10> transmit_tilt_deg;
  std::uint8_t filter_2 = 0;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.operator_status, self.processor_status, self.bsp_status, self.head_status, self.mode, self.filter,
         self.minimum_depth_m, self.maximum_depth_m, self.absorption_dbpkm, self.pulse_length_us,
         self.transmit_width_deg, self.transmit_power_db, self.receive_width_deg, self.receive_bandwidth_hz,
         self.mode_2, self.tvg_crossover_deg, self.sound_speed_source, self.maximum_port_m, self.beam_spacing,
         self.maximum_port_deg, self.stabilisation, self.maximum_starboard_deg, self.maximum_starboard_m,
         self.transmit_tilt_deg, self.filter_2);
  }
  bool operator==(const Runtime&) const = default;
};

}  // namespace ensonify::formats::all
