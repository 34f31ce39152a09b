#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "components/formats/layout.h"

/// Triton's XTF, revision X41, of which all field lists of this folder are. Its offsets are x to starboard, y forward,
/// z down.
namespace ensonify::formats::xtf {

/// A channel of the packets that follow.
struct ChannelInfo {
  enum Kind : std::uint8_t { kSubbottom = 0, kPort = 1, kStarboard = 2, kBathymetry = 3 };
  std::uint8_t kind = 0;
  std::uint8_t sub_channel = 0;
  std::uint16_t correction = 1;  // 1: slant range
  std::uint16_t unipolar = 1;
  std::uint16_t bytes_per_sample = 2;
  std::uint32_t samples = 0;  // where the packets do not say
  std::array<char, 16> name{};
  float volt_scale = 5.0F;
  float frequency_khz = 0;
  float horizontal_width_deg = 0;
  float tilt_deg = 0;  // below the horizontal
  float vertical_width_deg = 0;
  std::array<float, 3> offset_m{};
  std::array<float, 3> yaw_pitch_roll_deg{};
  std::uint16_t beams = 0;
  std::uint8_t sample_format = 0;  // 0 by bytes; 2 int 4, 3 int 2, 5 float 4, 8 int 1
  std::array<std::uint8_t, 53> spare{};

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire(self.kind, self.sub_channel, self.correction, self.unipolar, self.bytes_per_sample, self.samples, self.name,
         self.volt_scale, self.frequency_khz, self.horizontal_width_deg, self.tilt_deg, self.vertical_width_deg,
         self.offset_m, self.yaw_pitch_roll_deg, self.beams, self.sample_format, self.spare);
  }
  bool operator==(const ChannelInfo&) const = default;
};

/// What a file begins with: 1024 bytes with room for six channels, and 1024 more for every eight further ones.
struct FileHeader {
  static constexpr std::uint8_t kFormat = 123;
  static constexpr std::size_t kBlockBytes = 1024;
  static constexpr std::size_t kFirstChannels = 6;
  static constexpr std::size_t kMoreChannels = 8;  // of each further block

  std::uint8_t system = 1;
  std::array<char, 8> program{};
  std::array<char, 8> program_version{};
  std::array<char, 16> sonar{};
  std::uint16_t sonar_type = 0;  // 0: not named
  std::array<char, 64> notes{};
  std::array<char, 64> file_name{};
  std::uint16_t navigation_units = 3;  // 0: metres; 3: degrees, x longitude, y latitude
  std::uint16_t sonar_channels = 0;
  std::uint16_t bathymetry_channels = 0;
  std::array<std::uint8_t, 8> other_channels{};  // snippets, forward looking, echo strength, interferometry, reserved
  float reference_height_m = 0;
  std::array<std::uint8_t, 12> projection{};
  std::array<std::uint8_t, 10> spheroid{};
  std::int32_t navigation_latency_ms = 0;
  std::array<float, 2> origin{};               // y, x
  std::array<float, 3> navigation_offset_m{};  // y, x, z
  float navigation_yaw_deg = 0;
  std::array<float, 3> motion_offset_m{};  // y, x, z
  std::array<float, 3> motion_yaw_pitch_roll_deg{};
  std::vector<ChannelInfo> channels = std::vector<ChannelInfo>(kFirstChannels);  // used ones first

  /// Room for channels that a file with so many has.
  static std::size_t room(std::size_t channels) {
    if (channels <= kFirstChannels) return kFirstChannels;
    const std::size_t blocks = (channels - kFirstChannels + kMoreChannels - 1) / kMoreChannels;
    return kFirstChannels + blocks * kMoreChannels;
  }
  std::size_t channels_used() const { return std::size_t{sonar_channels} + bathymetry_channels; }

  template <class Self, class Wire>
  static void layout(Self& self, Wire&& wire) {
    wire.constant(kFormat);
    wire(self.system, self.program, self.program_version, self.sonar, self.sonar_type, self.notes, self.file_name,
         self.navigation_units, self.sonar_channels, self.bathymetry_channels, self.other_channels,
         self.reference_height_m, self.projection, self.spheroid, self.navigation_latency_ms, self.origin,
         self.navigation_offset_m, self.navigation_yaw_deg, self.motion_offset_m, self.motion_yaw_pitch_roll_deg);
    wire.resize(self.channels, room(self.channels_used()));
    wire.each(self.channels);
  }
  bool operator==(const FileHeader&) const = default;
};

}  // namespace ensonify::formats::xtf
