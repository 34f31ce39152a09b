#include <cmath>
#include <numbers>

#include "components/formats/all/writer.h"
#include "components/formats/testing/sample.h"

namespace ensonify::formats::sample {

namespace {

using namespace all;

constexpr std::uint16_t kModel = 2040;
constexpr std::uint16_t kSerial = 157;
constexpr int kBeams = 9;
constexpr double kSoundSpeed_mps = 1500.0;
constexpr double kDepth_m = 20.0;

double angle_deg(int beam) { return 60.0 - 15.0 * beam; }  // positive to port

Installation installation() {
  return {0,
          "WLZ=-0.40,SMH=157,STC=1,S1X=0.30,S1Y=0.00,S1Z=0.60,S1H=0.00,S1P=0.00,S1R=0.00,S2X=0.31,S2Y=0.00,S2Z=0.60,"
          "S2H=0.00,S2P=0.00,S2R=0.00,P1X=-1.00,P1Y=0.00,P1Z=-3.00,MSX=0.00,MSY=0.00,MSZ=0.00,APS=0,"};
}

SoundSpeedProfile profile() {
  return {.date = 20260310, .time_s = 41'000, .nodes = {{0, {15'000}}, {5'000, {15'000}}, {1'200'000, {15'000}}}};
}

Position position(double seconds) {
  return {.latitude_deg = FixedPoint<std::int32_t, 20'000'000>::of(54.0 + seconds * 1e-5),
          .longitude_deg = FixedPoint<std::int32_t, 10'000'000>::of(8.0),
          .fix_quality_m = {10},
          .speed_mps = {200},
          .course_deg = {0},
          .heading_deg = {0},
          .descriptor = 0x81,
          .sentence = "GPGGA,120000.00,5400.0000,N,00800.0000,E,4,12,0.8,3.00,M,40.00,M,1.0,0001*55"};
}

Attitude attitude() {
  Attitude attitude;
  for (std::uint16_t i = 0; i < 10; ++i) {
    attitude.entries.push_back(
        {static_cast<std::uint16_t>(10 * i), 0x9090, {static_cast<std::int16_t>(i)}, {-3}, {2}, {0}});
  }
  return attitude;
}

NetworkAttitude network_attitude() {
  return {.entries = {{0, {1}, {-3}, {2}, {0}, Bytes(3, std::byte{0xAA})}, {10, {2}, {-3}, {2}, {0}, Bytes{}}},
          .descriptor = 0x10};
}

RawRangeAngle raw_range_angle() {
  RawRangeAngle raw{.sound_speed_mps = {15'000}, .valid_beams = kBeams, .sampling_hz = 20'000};
  raw.sectors.push_back(
      {.pulse_length_s = 1e-4F, .centre_hz = 300e3F, .absorption_dbpkm = {7'000}, .index = 1, .bandwidth_hz = 1e4F});
  for (int i = 0; i < kBeams; ++i) {
    const double slant_m = kDepth_m / std::cos(angle_deg(i) * std::numbers::pi / 180);
    raw.beams.push_back({.angle_deg = FixedPoint<std::int16_t, 100>::of(angle_deg(i)),
                         .window_samples = 20,
                         .quality = 5,
                         .travel_time_s = static_cast<float>(2 * slant_m / kSoundSpeed_mps),
                         .reflectivity_db = {-250}});
  }
  return raw;
}

Soundings soundings() {
  Soundings xyz{.heading_deg = {0},
                .sound_speed_mps = {15'000},
                .transducer_depth_m = 1.0F,
                .valid_beams = kBeams,
                .sampling_hz = 20'000};
  for (int i = 0; i < kBeams; ++i) {
    const double across_m = -kDepth_m * std::tan(angle_deg(i) * std::numbers::pi / 180);
    xyz.beams.push_back({.z_m = kDepth_m,
                         .y_m = static_cast<float>(across_m),
                         .x_m = 1.3F,
                         .window_samples = 20,
                         .quality = 5,
                         .reflectivity_db = {-250}});
  }
  return xyz;
}

SeabedImage image() {
  SeabedImage image{.sampling_hz = 20'000, .normal_incidence_samples = 533, .oblique_strength_db = {-250}};
  for (int i = 0; i < kBeams; ++i) {
    const auto samples = static_cast<std::uint16_t>(1 + i % 3);
    image.beams.push_back(
        {.direction = static_cast<std::int8_t>(i < kBeams / 2 ? -1 : 1), .samples = samples, .centre_sample = 1});
    image.strength_ddb.insert(image.strength_ddb.end(), samples, static_cast<std::int16_t>(-250 - i));
  }
  return image;
}

WaterColumn water_column() {
  WaterColumn column{
      .ping_beams = kBeams, .sound_speed_mps = {15'000}, .sampling_hz = {2'000'000}, .tvg_log_factor = 30};
  column.sectors.push_back({.centre_hz = {30'000}, .index = 1});
  for (int i = 0; i < kBeams; ++i) {
    column.beams.push_back({.angle_deg = FixedPoint<std::int16_t, 100>::of(angle_deg(i)),
                            .detected_sample = 2,
                            .number = static_cast<std::uint8_t>(i),
                            .amplitude_half_db = {-100, -90, -60, -100}});
  }
  return column;
}

}  // namespace

File all_file() {
  File file;
  Writer writer(kModel, kSerial);
  const auto next = [&](std::int64_t after_ms, Body body) {
    file.offsets.push_back(file.bytes.size());
    writer.append_next(file.bytes, kBegin_ns + after_ms * 1'000'000, std::move(body));
  };
  const auto ping = [&](std::int64_t after_ms, std::uint16_t number, Body body) {
    file.offsets.push_back(file.bytes.size());
    writer.append_ping(file.bytes, kBegin_ns + after_ms * 1'000'000, number, kSerial, std::move(body));
  };
  next(0, installation());
  next(0, Runtime{.maximum_depth_m = 100, .pulse_length_us = 100});
  next(0, profile());
  for (int i = 0; i < 3; ++i) next(i * 200, position(0.2 * i));
  next(0, attitude());
  next(0, network_attitude());
  next(0, Height{.height_m = {4'300}});
  next(0, Clock{.date = 20260310, .time_ms = 43'200'000, .pulse_per_second = 1});
  next(0, SurfaceSoundSpeed{{{0, {15'000}}, {1, {15'000}}}});
  for (std::uint16_t number = 7; number < 9; ++number) {
    ping(100 * number, number, raw_range_angle());
    ping(100 * number, number, soundings());
    ping(100 * number, number, image());
    ping(100 * number, number, water_column());
  }
  file.offsets.push_back(file.bytes.size());
  writer.append_close(file.bytes, kBegin_ns + 1'000'000'000, installation());
  return file;
}

}  // namespace ensonify::formats::sample
