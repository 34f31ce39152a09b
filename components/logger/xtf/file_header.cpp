#include "components/logger/xtf/file_header.h"

#include <algorithm>
#include <numbers>

#include "components/formats/text.h"
#include "kernels/base/frames/pose.h"

namespace ensonify::logger {

using namespace formats::xtf;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Name, and mounting as measured: the format's x is to starboard, its y forward.
ChannelInfo channel(ChannelInfo::Kind kind, const std::string& name, const msg::HeadDeclaration& head,
                    double frequency_hz) {
  ChannelInfo info{.kind = kind, .name = formats::padded<16>(name)};
  info.frequency_khz = static_cast<float>(1e-3 * frequency_hz);
  info.horizontal_width_deg = static_cast<float>(head.finest_beam_rad / kDegree);
  const auto& [forward_m, starboard_m, down_m] = head.position_body_m;
  info.offset_m = {static_cast<float>(starboard_m), static_cast<float>(forward_m), static_cast<float>(down_m)};
  const frames::Attitude turned =
      frames::attitude_of(frames::enu_from_ned() * frames::quaternion_of(head.body_from_head));
  info.yaw_pitch_roll_deg = {static_cast<float>(frames::wrap_pi(turned.heading_rad) / kDegree),
                             static_cast<float>(turned.pitch_rad / kDegree),
                             static_cast<float>(turned.roll_rad / kDegree)};
  return info;
}

double frequency_hz(const msg::ChannelDeclaration& declared) {
  return declared.sectors.empty() ? 0.0 : declared.sectors.front().frequency_hz;
}

}  // namespace

FileHeader xtf_file_header(const std::string& file_name, const std::optional<msg::HeadDeclaration>& sidescan,
                           const std::optional<msg::HeadDeclaration>& multibeam, XtfSamples samples) {
  std::vector<ChannelInfo> channels;
  FileHeader header{.notes = formats::padded<64>("simulated by Ensonify"), .file_name = formats::padded<64>(file_name)};
  constexpr std::string_view kProgram = "Ensonify";  // fills its field
  std::copy(kProgram.begin(), kProgram.end(), header.program.begin());
  if (sidescan) {
    header.sonar = formats::padded<16>(sidescan->instrument.empty() ? "sidescan" : sidescan->instrument);
    for (const msg::ChannelDeclaration& transmission : sidescan->channels) {
      for (const bool port : {true, false}) {
        const std::string side = port ? "port" : "starboard";
        ChannelInfo& info = channels.emplace_back(channel(
            port ? ChannelInfo::kPort : ChannelInfo::kStarboard,
            transmission.name.empty() ? side : side + " " + transmission.name, *sidescan, frequency_hz(transmission)));
        info.sub_channel = static_cast<std::uint8_t>(channels.size() - 1);
        info.bytes_per_sample = bytes_of(samples);
        info.sample_format = format_of(samples);
      }
    }
    header.sonar_channels = static_cast<std::uint16_t>(channels.size());
  }
  if (multibeam) {
    if (!sidescan)
      header.sonar = formats::padded<16>(multibeam->instrument.empty() ? "multibeam" : multibeam->instrument);
    channels.push_back(channel(ChannelInfo::kBathymetry, "bathymetry", *multibeam,
                               multibeam->channels.empty() ? 0.0 : frequency_hz(multibeam->channels.front())));
    header.bathymetry_channels = 1;
  }
  header.channels = channels;
  header.channels.resize(FileHeader::room(channels.size()));
  return header;
}

}  // namespace ensonify::logger
