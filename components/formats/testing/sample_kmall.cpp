#include <cmath>
#include <numbers>

#include "components/formats/kmall/writer.h"
#include "components/formats/testing/sample.h"

namespace ensonify::formats::sample {

namespace {

using namespace kmall;

constexpr std::uint16_t kSounder = 2040;
constexpr int kBeams = 9;
constexpr double kSoundSpeed_mps = 1500.0;
constexpr double kDepth_m = 20.0;
constexpr float kTransducer_m = 0.6F;

double angle_deg(int beam) { return 60.0 - 15.0 * beam; }  // positive to port

Installation installation() {
  Installation installation;
  installation.text =
      "OSCV:Empty,EMXV:EM2040,\nSN=157,\nKMALL:Rev I 2021-06-04,\nSYSTEM:EM 2040,"
      "TRAI_TX1:N=157;X=0.300;Y=0.000;Z=0.600;R=0.000;P=0.000;H=0.000,"
      "TRAI_RX1:N=157;X=0.310;Y=0.000;Z=0.600;R=0.000;P=0.000;H=0.000,"
      "POSI_1:X=-1.000;Y=0.000;Z=-3.000;U=ACTIVE,POSI_2:U=NOT_SET,ATTI_1:X=0.000;Y=0.000;Z=0.000;U=ACTIVE,"
      "CLCK:F=ZDA,EMXI:SWLZ=-0.400,\n";
  return installation;
}

Runtime runtime() {
  Runtime runtime;
  runtime.text = "\nSector coverage\nMax angle Port:      65.0\n";
  return runtime;
}

template <class Kind>
Kind position(int second) {
  Kind position;
  position.sensor = {0, 1, 0};
  position.sensor_time_s = static_cast<std::uint32_t>(kBegin_ns / 1'000'000'000 + second);
  position.fix_quality_m = 0.1F;
  position.latitude_deg = 54.0 + 1e-5 * second;
  position.longitude_deg = 8.0;
  position.speed_mps = 2.0F;
  position.height_m = 41.0F;
  position.sentence = "$GPGGA,120000.00,5400.0000,N,00800.0000,E,4,12,0.8,3.00,M,40.00,M,1.0,0001*55\r\n";
  return position;
}

Motion motion() {
  Motion motion{.status = 1, .input_format = 1, .contents = 0x7F};
  for (std::uint32_t i = 0; i < 5; ++i) {
    motion.samples.push_back({.time_s = static_cast<std::uint32_t>(kBegin_ns / 1'000'000'000),
                              .time_ns = i * 10'000'000,
                              .latitude_deg = 54.0,
                              .longitude_deg = 8.0,
                              .roll_deg = 0.5F,
                              .heave_m = 0.02F,
                              .velocity_mps = {2.0F, 0.0F, 0.0F}});
  }
  return motion;
}

Soundings soundings(std::uint16_t number) {
  Soundings ping{.main_soundings = kBeams, .valid_main_soundings = kBeams, .image_hz = 20'000};
  ping.ping.ping = number;
  ping.info.ping_rate_hz = 10;
  ping.pose.sound_speed_mps = kSoundSpeed_mps;
  ping.pose.transducer_depth_m = 1.0F;
  ping.pose.water_line_m = -0.4F;
  ping.pose.latitude_deg = 54.0;
  ping.pose.longitude_deg = 8.0;
  ping.sectors.push_back({.centre_hz = 300e3F, .bandwidth_hz = 1e4F, .pulse_length_s = 1e-4F});
  ping.extra_soundings = 1;
  ping.classes.push_back({.detections = 1});
  for (std::uint16_t i = 0; i <= kBeams; ++i) {
    const double angle_rad = angle_deg(i) * std::numbers::pi / 180;
    const auto samples = static_cast<std::uint16_t>(1 + i % 3);
    ping.soundings.push_back({.index = i,
                              .detection = static_cast<std::uint8_t>(i == kBeams ? 1 : 0),
                              .method = 1,
                              .quality = 0.2F,
                              .angle_deg = static_cast<float>(angle_deg(i)),
                              .travel_time_s = static_cast<float>(2 * kDepth_m / std::cos(angle_rad) / kSoundSpeed_mps),
                              .z_m = static_cast<float>(kDepth_m) + kTransducer_m,
                              .y_m = static_cast<float>(-kDepth_m * std::tan(angle_rad)),
                              .x_m = 0.3F,
                              .image_samples = samples});
    ping.image_ddb.insert(ping.image_ddb.end(), samples, static_cast<std::int16_t>(-250 - i));
  }
  return ping;
}

WaterColumn water_column(std::uint16_t number, std::uint8_t phase) {
  WaterColumn column{.phase = phase, .tvg_log_factor = 30, .sampling_hz = 20'000, .sound_speed_mps = kSoundSpeed_mps};
  column.ping.ping = number;
  column.sectors.push_back({.centre_hz = 300e3F});
  for (int i = 0; i < kBeams; ++i) {
    column.beams.push_back(
        {.angle_deg = static_cast<float>(angle_deg(i)), .detected_sample = 2, .amplitude_half_db = {-100, -90, -60}});
    if (phase == WaterColumn::kLowResolution) column.beams.back().phase_low = {1, -2, 3};
    if (phase == WaterColumn::kHighResolution) column.beams.back().phase_high = {100, -200, 300};
  }
  return column;
}

}  // namespace

File kmall_file() {
  File file;
  const Writer writer(kSounder);
  const auto next = [&](std::int64_t after_ms, Body body) {
    file.offsets.push_back(file.bytes.size());
    writer.append_body(file.bytes, kBegin_ns + after_ms * 1'000'000, std::move(body));
  };
  next(0, installation());
  next(0, runtime());
  next(0, SoundSpeedProfile{.time_s = static_cast<std::uint32_t>(kBegin_ns / 1'000'000'000 - 3600),
                            .latitude_deg = 54.0,
                            .longitude_deg = 8.0,
                            .nodes = {{0, 1500, 0, 10, 34}, {12'000, 1500, 0, -99, -99}}});
  for (int second = 0; second < 3; ++second) next(1'000 * second, position<Position>(second));
  next(0, position<CompatiblePosition>(0));
  next(0, motion());
  next(0, SurfaceSoundSpeed{.status = 1, .contents = 1, .samples = {{.sound_speed_mps = 1500}}});
  Clock clock;
  clock.sentence = "$GPZDA,120000.00,10,03,2026,,*64\r\n";
  next(0, clock);
  for (std::uint16_t number = 7; number < 9; ++number) {
    next(100 * number, soundings(number));
    next(100 * number, water_column(number, static_cast<std::uint8_t>(number - 7)));
    Heave heave;
    heave.ping.ping = number;
    next(100 * number, heave);
  }
  next(900, water_column(9, WaterColumn::kHighResolution));
  return file;
}

}  // namespace ensonify::formats::sample
