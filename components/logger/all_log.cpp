#include "components/logger/all_log.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "components/formats/utc.h"
#include "components/logger/all_image.h"
#include "components/logger/all_ping.h"
#include "components/logger/all_settings.h"
#include "components/logger/gga.h"

namespace ensonify::logger {

using namespace formats::all;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::uint16_t kModel = 2040;
constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kHeaveKept_ns = 30 * kSecond_ns;  // longer than any reception
constexpr std::size_t kImagesKept = 16;                  // each comes with its soundings
constexpr std::uint16_t kSensorOk = 0x9090;

/// The next multiple of a period, at `stamp_ns` or later.
std::int64_t next_multiple(std::int64_t stamp_ns, std::int64_t period_ns) {
  return (stamp_ns + period_ns - 1) / period_ns * period_ns;
}

/// GGA's quality; of a system that does not state it, what has such a standard deviation.
std::int64_t quality_of(const msg::Position& fix) {
  if (fix.quality > 0) return fix.quality;
  if (fix.sigma_horizontal_m <= 0.1) return 4;
  return fix.sigma_horizontal_m <= 1.5 ? 2 : 1;
}
double hdop_of(const msg::Position& fix) { return fix.hdop > 0.0 ? fix.hdop : 1.0; }

/// As such systems make it: the dilution of precision times a length by GGA's quality.
double fix_quality_m(const msg::Position& fix) {
  constexpr std::array<double, 6> kUnit_m{10.0, 10.0, 1.0, 2.0, 0.1, 0.5};
  const auto quality = static_cast<std::size_t>(quality_of(fix));
  return hdop_of(fix) * (quality < kUnit_m.size() ? kUnit_m[quality] : kUnit_m[0]);
}

frames::Pose pose_of(const msg::Estimate& estimate) {
  const auto& [east_m, north_m, up_m] = estimate.position_enu_m;
  return {frames::Vec3(east_m, north_m, up_m), frames::quaternion_of(estimate.enu_from_body)};
}

}  // namespace

void Heave::push(std::int64_t stamp_ns, double heave_up_m) {
  if (!samples_.empty() && stamp_ns <= samples_.back().stamp_ns) return;
  samples_.push_back({stamp_ns, -heave_up_m});
  while (samples_.front().stamp_ns < stamp_ns - kHeaveKept_ns) samples_.pop_front();
}

double Heave::down_m(std::int64_t stamp_ns) const {
  if (samples_.empty()) return 0.0;
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), stamp_ns,
                                      [](const Sample& sample, std::int64_t t_ns) { return sample.stamp_ns < t_ns; });
  if (after == samples_.end()) return samples_.back().down_m;
  if (after == samples_.begin()) return after->down_m;
  const auto before = std::prev(after);
  const double fraction =
      static_cast<double>(stamp_ns - before->stamp_ns) / static_cast<double>(after->stamp_ns - before->stamp_ns);
  return before->down_m + fraction * (after->down_m - before->down_m);
}

std::optional<std::int64_t> Heave::newest_ns() const {
  return samples_.empty() ? std::nullopt : std::optional(samples_.back().stamp_ns);
}

AllLog::AllLog(const LoggerConfig& config, std::string file_name)
    : config_(config), file_name_(std::move(file_name)), writer_(kModel, static_cast<std::uint16_t>(config.serial)) {}

/// Files have milliseconds: the nearest.
std::int64_t AllLog::unix_ns(std::int64_t stamp_ns) const {
  return config_.start_unix_ns + stamp_ns + kMillisecond_ns / 2;
}

formats::Bytes AllLog::write(const frames::LocalProjection& world, bool all) {
  for (const msg::Estimate& estimate : estimates_) add(estimate, world);
  estimates_.clear();
  if (all) finish_attitude();

  formats::Bytes out;
  const auto flush = [&] {
    for (; begun_ && !navigation_.empty(); navigation_.pop_front()) {
      last_ns_ = std::max(last_ns_, navigation_.front().stamp_ns);
      writer_.append_next(out, unix_ns(navigation_.front().stamp_ns), std::move(navigation_.front().body));
    }
  };
  flush();
  while (!pings_.empty()) {
    const msg::Soundings& ping = pings_.front();
    // Its heave lies between two that are known.
    if (!all && heave_.newest_ns().value_or(0) < ping.stamp_ns) break;
    if (!has_track(ping) || !(begun_ || begins(ping))) {
      ++left_out_;
    } else {
      if (!begun_) begin(ping, out);
      flush();
      write(ping, world, out);
    }
    pings_.pop_front();
  }
  if (all && begun_)
    writer_.append_close(out, unix_ns(last_ns_),
                         installation(config_.vessel, static_cast<std::uint16_t>(config_.serial), file_name_));
  return out;
}

void AllLog::add(const msg::Estimate& estimate, const frames::LocalProjection& world) {
  const std::int64_t stamp_ns = estimate.stamp_ns;
  if (!attitude_.entries.empty() && stamp_ns - attitude_begin_ns_ >= kSecond_ns) finish_attitude();
  if (attitude_.entries.empty()) attitude_begin_ns_ = stamp_ns;
  const frames::Attitude attitude = frames::attitude_of(frames::quaternion_of(estimate.enu_from_body));
  const frames::Vec2 east_north_m(estimate.position_enu_m[0], estimate.position_enu_m[1]);
  const double heading_rad = frames::wrap_two_pi(attitude.heading_rad + world.convergence_rad(east_north_m));
  Attitude::Entry& entry = attitude_.entries.emplace_back();
  entry.after_ms = static_cast<std::uint16_t>((stamp_ns - attitude_begin_ns_ + kMillisecond_ns / 2) / kMillisecond_ns);
  entry.status = kSensorOk;
  entry.roll_deg = entry.roll_deg.of(attitude.roll_rad / kDegree);
  entry.pitch_deg = entry.pitch_deg.of(attitude.pitch_rad / kDegree);
  entry.heave_m = entry.heave_m.of(heave_.down_m(stamp_ns));
  entry.heading_deg = entry.heading_deg.of(heading_rad / kDegree);

  if (!next_position_ns_ || stamp_ns >= *next_position_ns_) {
    navigation_.push_back({stamp_ns, position_of(estimate, world)});
    next_position_ns_ = next_multiple(stamp_ns + 1, kSecond_ns / config_.position_rate_hz);
  }
  if (!next_clock_ns_ || stamp_ns >= *next_clock_ns_) {
    const formats::DayTime time = formats::day_time(unix_ns(stamp_ns));
    navigation_.push_back({stamp_ns, Clock{time.date, time.time_ms, 0}});
    next_clock_ns_ = next_multiple(stamp_ns + 1, kSecond_ns);
  }
  while (!begun_ && !navigation_.empty() && navigation_.front().stamp_ns < stamp_ns - kKeptLead_ns)
    navigation_.pop_front();
}

void AllLog::finish_attitude() {
  if (attitude_.entries.empty()) return;
  attitude_.descriptor = 1;  // sensor 1; its heading, roll, pitch and heave are active
  navigation_.push_back({attitude_begin_ns_, std::exchange(attitude_, {})});
}

Position AllLog::position_of(const msg::Estimate& estimate, const frames::LocalProjection& world) const {
  constexpr std::uint8_t kActiveSystem1 = 0x81;
  const frames::Pose body = pose_of(estimate);
  const frames::Vec3 origin_enu_m = config_.vessel.horizontal_origin_enu_m(body);
  const frames::Geodetic logged = world.geodetic_of(origin_enu_m.head<2>());
  const frames::Geodetic antenna = world.geodetic_of(body.position_enu_m.head<2>());
  const double convergence_rad = world.convergence_rad(body.position_enu_m.head<2>());
  const auto& velocity = estimate.velocity_enu_mps;
  const msg::Position fix = fix_.value_or(msg::Position{});

  Position position;
  position.latitude_deg = position.latitude_deg.of(logged.latitude_deg);
  position.longitude_deg = position.longitude_deg.of(logged.longitude_deg);
  position.fix_quality_m = position.fix_quality_m.of(fix_quality_m(fix));
  position.speed_mps = position.speed_mps.of(std::hypot(velocity[0], velocity[1]));
  const double course_rad = std::atan2(velocity[0], velocity[1]) + convergence_rad;
  position.course_deg = position.course_deg.of(frames::wrap_two_pi(course_rad) / kDegree);
  const double heading_rad = frames::attitude_of(body.enu_from_body).heading_rad + convergence_rad;
  position.heading_deg = position.heading_deg.of(frames::wrap_two_pi(heading_rad) / kDegree);
  position.descriptor = kActiveSystem1;
  position.sentence = gga_text({unix_ns(estimate.stamp_ns), antenna.latitude_deg, antenna.longitude_deg,
                                quality_of(fix), hdop_of(fix), fix.height_above_geoid_m, fix.geoid_above_ellipsoid_m});
  return position;
}

bool AllLog::begins(const msg::Soundings& first) const {
  std::size_t positions = 0;
  bool lead = false;
  for (const Navigation& entry : navigation_) {
    if (!std::holds_alternative<Position>(entry.body) || entry.stamp_ns > first.stamp_ns) continue;
    ++positions;
    lead = lead || entry.stamp_ns <= first.stamp_ns - kLeastLead_ns;
  }
  const bool attitude = std::any_of(navigation_.begin(), navigation_.end(), [](const Navigation& entry) {
    return std::holds_alternative<Attitude>(entry.body);
  });
  return lead && attitude && positions >= kLeastPositions;
}

void AllLog::begin(const msg::Soundings& first, formats::Bytes& out) {
  const std::int64_t begin_ns = unix_ns(navigation_.front().stamp_ns);
  runtime_ = runtime(first.applied);
  writer_.append_next(out, begin_ns,
                      installation(config_.vessel, static_cast<std::uint16_t>(config_.serial), file_name_));
  writer_.append_next(out, begin_ns, *runtime_);
  writer_.append_next(out, begin_ns, profile(config_.profile, config_.start_unix_ns));
  begun_ = true;
}

void AllLog::write(const msg::Soundings& ping, const frames::LocalProjection& world, formats::Bytes& out) {
  const std::int64_t time_ns = unix_ns(ping.stamp_ns);
  const auto number = static_cast<std::uint16_t>(ping.ping);
  const auto serial = static_cast<std::uint16_t>(config_.serial);
  if (const Runtime settings = runtime(ping.applied); settings != runtime_) {
    writer_.append_next(out, time_ns, settings);
    runtime_ = settings;
  }
  writer_.append_ping(out, time_ns, number, serial, raw_range_angle(ping));
  writer_.append_ping(out, time_ns, number, serial, xyz(ping, config_.vessel, world, heave_.down_m(ping.stamp_ns)));
  writer_.append_ping(out, time_ns, number, serial, seabed_image(ping, image_of(ping.ping)));
  last_ns_ = std::max(last_ns_, ping.stamp_ns);
  ++logged_pings_;
}

std::optional<msg::SeabedImage> AllLog::image_of(std::int64_t ping) {
  std::optional<msg::SeabedImage> found;
  while (!images_.empty() && images_.front().ping <= ping) {
    if (images_.front().ping == ping) found = std::move(images_.front());
    images_.pop_front();
  }
  while (images_.size() > kImagesKept) images_.pop_front();
  return found;
}

}  // namespace ensonify::logger
