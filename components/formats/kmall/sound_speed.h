#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "components/formats/layout.h"

namespace ensonify::formats::kmall {

/// The profile in force from this time on.
struct SoundSpeedProfile {
  static constexpr std::string_view kType = "#SVP";
  static constexpr std::uint8_t kVersion = 1;
  struct Node {
    float depth_m = 0;
    float sound_speed_mps = 0;
    std::uint32_t padding = 0;
    float temperature_degc = 0;  // -99 or -9999: not known
    float salinity_psu = 0;

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.depth_m, self.sound_speed_mps, self.padding, self.temperature_degc, self.salinity_psu);
    }
    bool operator==(const Node&) const = default;
  };
  std::array<char, 4> sensor_format{'S', '0', '1', '\0'};
  std::uint32_t time_s = 0;  // when it was measured, since 1970
  double latitude_deg = 0;   // 200: not known
  double longitude_deg = 0;
  std::vector<Node> nodes;  // genuine files have a stale one behind them: Datagram::rest

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire.constant(std::uint16_t{28});
    wire.count(kU16, self.nodes);
    wire(self.sensor_format, self.time_s, self.latitude_deg, self.longitude_deg);
    wire.each(self.nodes);
  }
  bool operator==(const SoundSpeedProfile&) const = default;
};

/// Sound speed at the transducer.
struct SurfaceSoundSpeed {
  static constexpr std::string_view kType = "#SVT";
  static constexpr std::uint8_t kVersion = 0;
  struct Sample {
    std::uint32_t time_s = 0;
    std::uint32_t time_ns = 0;
    float sound_speed_mps = 0;
    float temperature_degc = 0;  // -9999: not known
    float pressure_pa = 0;
    float salinity_psu = 0;

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.time_s, self.time_ns, self.sound_speed_mps, self.temperature_degc, self.pressure_pa, self.salinity_psu);
    }
    bool operator==(const Sample&) const = default;
  };
  std::uint16_t status = 0;
  std::uint16_t input_format = 0;
  std::uint16_t contents = 0;  // bits: what the input has
  float filter_s = 0;
  float offset_mps = 0;
  std::vector<Sample> samples;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire.constant(std::uint16_t{20});
    wire(self.status, self.input_format);
    wire.count(kU16, self.samples);
    wire.constant(static_cast<std::uint16_t>(fixed_bytes<Sample>()));
    wire(self.contents, self.filter_s, self.offset_mps);
    wire.each(self.samples);
  }
  bool operator==(const SurfaceSoundSpeed&) const = default;
};

}  // namespace ensonify::formats::kmall
