#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "components/formats/kmall/header.h"

namespace ensonify::formats::kmall {

/// Where the vessel's reference point is, with the sentence that it came from.
struct PositionPart {
  SensorPart sensor;
  std::uint32_t sensor_time_s = 0;  // since 1970, of the sentence
  std::uint32_t sensor_time_ns = 0;
  float fix_quality_m = 0;
  double latitude_deg = 0;  // 200: not known
  double longitude_deg = 0;
  float speed_mps = 0;
  float course_deg = 0;
  float height_m = 0;    // of the reference point above the ellipsoid
  std::string sentence;  // with $ and line end, perhaps with zeros

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.sensor, self.sensor_time_s, self.sensor_time_ns, self.fix_quality_m, self.latitude_deg,
         self.longitude_deg, self.speed_mps, self.course_deg, self.height_m);
    wire.rest(self.sentence);
  }
  bool operator==(const PositionPart&) const = default;
};

struct Position : PositionPart {
  static constexpr std::string_view kType = "#SPO";
  static constexpr std::uint8_t kVersion = 0;
  bool operator==(const Position&) const = default;
};

/// The same from a system that only serves as a reference.
struct CompatiblePosition : PositionPart {
  static constexpr std::string_view kType = "#CPO";
  static constexpr std::uint8_t kVersion = 0;
  bool operator==(const CompatiblePosition&) const = default;
};

/// About a second of attitude and velocity, as the sensor gives it: not corrected for its mounting.
struct Motion {
  static constexpr std::string_view kType = "#SKM";
  static constexpr std::uint8_t kVersion = 1;
  struct Sample {
    std::array<char, 4> type{'#', 'K', 'M', 'B'};
    std::uint16_t stated_bytes = 132;
    std::uint16_t version = 1;
    std::uint32_t time_s = 0;
    std::uint32_t time_ns = 0;
    std::uint32_t status = 0;  // set bits: which of the values are not there
    double latitude_deg = 0;
    double longitude_deg = 0;
    float ellipsoid_height_m = 0;
    float roll_deg = 0;   // port up
    float pitch_deg = 0;  // bow up
    float heading_deg = 0;
    float heave_m = 0;                       // down
    std::array<float, 3> rate_degps{};       // roll, pitch, yaw
    std::array<float, 3> velocity_mps{};     // north, east, down
    std::array<float, 3> position_sd_m{};    // latitude, longitude, height
    std::array<float, 3> attitude_sd_deg{};  // roll, pitch, heading
    float heave_sd_m = 0;
    std::array<float, 3> acceleration_mps2{};  // north, east, down
    std::uint32_t delayed_time_s = 0;
    std::uint32_t delayed_time_ns = 0;
    float delayed_heave_m = 0;

    template <class Self, class Wire>
    static void layout(Self& self, Wire&& wire) {
      wire(self.type, self.stated_bytes, self.version, self.time_s, self.time_ns, self.status, self.latitude_deg,
           self.longitude_deg, self.ellipsoid_height_m, self.roll_deg, self.pitch_deg, self.heading_deg, self.heave_m,
           self.rate_degps, self.velocity_mps, self.position_sd_m, self.attitude_sd_deg, self.heave_sd_m,
           self.acceleration_mps2, self.delayed_time_s, self.delayed_time_ns, self.delayed_heave_m);
    }
    bool operator==(const Sample&) const = default;
  };
  std::uint8_t sensor = 0;
  std::uint8_t status = 0;
  std::uint16_t input_format = 0;  // 1 KM binary, 2 EM 3000, 5 Seapath 23, 7 POS M/V
  std::uint16_t contents = 0;      // bits: what the input has
  std::vector<Sample> samples;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire.constant(std::uint16_t{12});
    wire(self.sensor, self.status, self.input_format);
    wire.count(kU16, self.samples);
    wire.constant(static_cast<std::uint16_t>(fixed_bytes<Sample>()));
    wire(self.contents);
    wire.each(self.samples);
  }
  bool operator==(const Motion&) const = default;
};

/// A clock's sentence, and how far ours is off.
struct Clock {
  static constexpr std::string_view kType = "#SCL";
  static constexpr std::uint8_t kVersion = 0;
  SensorPart sensor;
  float offset_s = 0;          // as the operator set it
  std::int32_t deviation = 0;  // of our clock, microseconds; nanoseconds with newer firmware
  std::string sentence;

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.sensor, self.offset_s, self.deviation);
    wire.rest(self.sentence);
  }
  bool operator==(const Clock&) const = default;
};

}  // namespace ensonify::formats::kmall
