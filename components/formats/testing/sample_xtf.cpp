#include <algorithm>

#include "components/formats/testing/sample.h"
#include "components/formats/text.h"
#include "components/formats/xtf/writer.h"

namespace ensonify::formats::sample {

namespace {

using namespace xtf;

constexpr std::uint32_t kSamples = 50;

FileHeader header() {
  FileHeader header{.program = padded<8>("Sample"),
                    .sonar = padded<16>("Sample sidescan"),
                    .file_name = padded<64>("sample.xtf"),
                    .sonar_channels = 2,
                    .bathymetry_channels = 1};
  header.channels[0] = {.kind = ChannelInfo::kPort, .name = padded<16>("port"), .frequency_khz = 600};
  header.channels[1] = {
      .kind = ChannelInfo::kStarboard, .sub_channel = 1, .name = padded<16>("starboard"), .frequency_khz = 600};
  header.channels[2] = {.kind = ChannelInfo::kBathymetry, .name = padded<16>("bathymetry"), .frequency_khz = 300};
  return header;
}

PingHeader ping_header(std::uint32_t number) {
  const std::int64_t time_ns = kBegin_ns + number * std::int64_t{50'000'000};
  return {.time = Time::of(time_ns),
          .hundredths = static_cast<std::uint8_t>(5 * number),
          .day_of_year = 68,
          .ping = number,
          .ship_speed_kn = 4,
          .ship_y = 54.0 + 1e-6 * number,
          .ship_x = 8.0,
          .sensor_y = 54.0 + 1e-6 * number,
          .sensor_x = 8.0,
          .sensor_depth_m = 3.0F,
          .sensor_altitude_m = 12.0F};
}

SonarPing sidescan(std::uint32_t number) {
  SonarPing ping{.header = ping_header(number)};
  for (std::uint16_t side = 0; side < 2; ++side) {
    Channel channel{.number = side, .slant_range_m = 30, .duration_s = 0.04F, .frequency_khz = 600};
    std::vector<std::uint16_t> samples(kSamples);
    for (std::uint32_t i = 0; i < kSamples; ++i) samples[i] = static_cast<std::uint16_t>(i < 20 ? 3 : 2'000 - 10 * i);
    if (side == 0) std::reverse(samples.begin(), samples.end());
    const ByteView bytes = std::as_bytes(std::span(samples));
    channel.sample_count = kSamples;
    channel.samples.assign(bytes.begin(), bytes.end());
    ping.channels.push_back(std::move(channel));
  }
  return ping;
}

MultibeamPing multibeam(std::uint32_t number) {
  MultibeamPing ping{.header = ping_header(number)};
  for (std::int32_t i = 0; i < 5; ++i) {
    ping.beams.push_back({.number = i, .quality = 3, .travel_time_s = 0.02, .angle_deg = -40.0 + 20.0 * i});
  }
  return ping;
}

}  // namespace

File xtf_file() {
  File file;
  append(file.bytes, header());
  const auto next = [&](Body body) {
    file.offsets.push_back(file.bytes.size());
    append(file.bytes, packet_of(std::move(body)));
  };
  next(Notes{.time = Time::of(kBegin_ns), .text = padded<200>("Made up for tests")});
  for (std::uint32_t number = 0; number < 3; ++number) {
    next(RawNavigation{
        .time = Time::of(kBegin_ns), .tenths_ms = static_cast<std::uint16_t>(500 * number), .y = 54.0, .x = 8.0});
    next(Attitude{.pitch_deg = 1,
                  .roll_deg = -2,
                  .heave_m = 0.1F,
                  .time = Time::of(kBegin_ns),
                  .milliseconds = static_cast<std::uint16_t>(50 * number)});
    next(sidescan(number));
    next(multibeam(number));
  }
  next(MultiTransmitPing{.header = ping_header(3), .beams = {{.number = 0, .travel_time_s = 0.02F}}});
  next(RawSerial{.time = Time::of(kBegin_ns), .text = "$GPZDA,120000.00,10,03,2026,,*64\r\n"});
  return file;
}

}  // namespace ensonify::formats::sample
