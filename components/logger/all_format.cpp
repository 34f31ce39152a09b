#include "components/logger/all_format.h"

#include <algorithm>
#include <utility>

#include "components/formats/utc.h"
#include "components/logger/all_column.h"
#include "components/logger/all_image.h"
#include "components/logger/all_ping.h"
#include "components/logger/all_settings.h"

namespace ensonify::logger {

using namespace formats::all;

namespace {

constexpr std::uint16_t kModel = 2040;
constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::uint16_t kSensorOk = 0x9090;

/// Files have milliseconds: the nearest.
std::int64_t to_millisecond(std::int64_t unix_ns) { return unix_ns + kMillisecond_ns / 2; }

Attitude::Entry entry_of(const Moment& moment, std::int64_t begin_ns) {
  Attitude::Entry entry;
  entry.after_ms = static_cast<std::uint16_t>(to_millisecond(moment.unix_ns - begin_ns) / kMillisecond_ns);
  entry.status = kSensorOk;
  entry.roll_deg = entry.roll_deg.of(moment.roll_deg);
  entry.pitch_deg = entry.pitch_deg.of(moment.pitch_deg);
  entry.heave_m = entry.heave_m.of(moment.heave_down_m);
  entry.heading_deg = entry.heading_deg.of(moment.heading_deg);
  return entry;
}

Position position_of(const Moment& moment) {
  constexpr std::uint8_t kActiveSystem1 = 0x81;
  Position position;
  position.latitude_deg = position.latitude_deg.of(moment.water_line.latitude_deg);
  position.longitude_deg = position.longitude_deg.of(moment.water_line.longitude_deg);
  position.fix_quality_m = position.fix_quality_m.of(moment.fix_quality_m);
  position.speed_mps = position.speed_mps.of(moment.speed_mps);
  position.course_deg = position.course_deg.of(moment.course_deg);
  position.heading_deg = position.heading_deg.of(moment.heading_deg);
  position.descriptor = kActiveSystem1;
  position.sentence = moment.gga;
  return position;
}

}  // namespace

AllFormat::AllFormat(const LoggerConfig& config, std::string mark, Part part)
    : config_(config),
      mark_(std::move(mark)),
      part_(part),
      writer_(kModel, static_cast<std::uint16_t>(config.serial)) {}

void AllFormat::append(formats::Bytes& out, std::int64_t unix_ns, Body body) {
  last_ns_ = std::max(last_ns_, unix_ns);
  writer_.append_next(out, to_millisecond(unix_ns), std::move(body));
}

void AllFormat::begin(const FileStart& start, formats::Bytes& out) {
  writer_ = Writer(kModel, serial());
  attitude_ = {};
  file_name_ = start.name;
  last_ns_ = 0;
  runtime_ = runtime(start.settings);
  append(out, start.unix_ns, installation(config_.vessel, serial(), file_name_, mark_));
  append(out, start.unix_ns, *runtime_);
  append(out, start.unix_ns, profile(config_.profile, config_.start_unix_ns));
}

void AllFormat::moment(const Moment& moment, formats::Bytes& out) {
  if (!attitude_.entries.empty() && moment.unix_ns - attitude_begin_ns_ >= kSecond_ns) finish_attitude(out);
  if (attitude_.entries.empty()) attitude_begin_ns_ = moment.unix_ns;
  attitude_.entries.push_back(entry_of(moment, attitude_begin_ns_));
  if (moment.position_due) append(out, moment.unix_ns, position_of(moment));
  if (moment.clock_due) {
    const formats::DayTime time = formats::day_time(to_millisecond(moment.unix_ns));
    append(out, moment.unix_ns, Clock{time.date, time.time_ms, 0});
  }
}

void AllFormat::finish_attitude(formats::Bytes& out) {
  if (attitude_.entries.empty()) return;
  attitude_.descriptor = 1;  // sensor 1; its heading, roll, pitch and heave are active
  append(out, attitude_begin_ns_, std::exchange(attitude_, {}));
}

void AllFormat::ping(const LoggedSoundings& ping, formats::Bytes& out) {
  if (part_ == Part::kWaterColumn && !ping.water_column) return;
  const msg::Soundings& soundings = ping.soundings;
  const std::int64_t time_ns = to_millisecond(ping.unix_ns);
  const auto number = static_cast<std::uint16_t>(soundings.ping);
  if (const Runtime settings = runtime(soundings.applied); settings != runtime_) {
    append(out, ping.unix_ns, settings);
    runtime_ = settings;
  }
  last_ns_ = std::max(last_ns_, ping.unix_ns);
  if (part_ == Part::kWaterColumn) {
    for (WaterColumn& column : water_column(ping, config_.vessel))
      writer_.append_ping(out, time_ns, number, serial(), std::move(column));
    return;
  }
  writer_.append_ping(out, time_ns, number, serial(), raw_range_angle(soundings));
  writer_.append_ping(out, time_ns, number, serial(), xyz(soundings, config_.vessel, ping.world, ping.heave_down_m));
  writer_.append_ping(out, time_ns, number, serial(), seabed_image(soundings, ping.image));
}

void AllFormat::end(formats::Bytes& out) {
  finish_attitude(out);
  writer_.append_close(out, to_millisecond(last_ns_), installation(config_.vessel, serial(), file_name_, mark_));
}

}  // namespace ensonify::logger
