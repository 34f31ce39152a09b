#include "components/logger/kmall/kmall_format.h"

#include <utility>

#include "components/logger/kmall/column.h"
#include "components/logger/kmall/installation.h"
#include "components/logger/kmall/navigation.h"
#include "components/logger/kmall/ping.h"

namespace ensonify::logger {

namespace {

constexpr std::uint16_t kSounder = 2040;
constexpr std::uint8_t kSimulator = 100;  // added to the detection mode
constexpr std::int64_t kSecond_ns = 1'000'000'000;

}  // namespace

KmallFormat::KmallFormat(const LoggerConfig& config, std::string mark, Part part)
    : config_(config), mark_(std::move(mark)), part_(part), writer_(kSounder) {}

void KmallFormat::begin(const FileStart& start, formats::Bytes& out) {
  motion_.clear();
  before_.reset();
  sound_speed_mps_ = start.settings.sound_speed_mps;
  runtime_ = kmall::runtime(start.settings, simulator());
  writer_.append_body(out, start.unix_ns,
                      kmall::installation(config_.vessel, static_cast<std::uint16_t>(config_.serial), mark_));
  writer_.append_body(out, start.unix_ns, *runtime_);
  writer_.append_body(out, start.unix_ns, kmall::profile(config_.profile, config_.start_unix_ns, start.place));
}

void KmallFormat::moment(const Moment& moment, formats::Bytes& out) {
  if (part_ == Part::kWaterColumn) {
    if (moment.position_due) writer_.append_body(out, moment.unix_ns, kmall::position(moment));
    return;
  }
  const bool full = motion_.size() == kmall::kMostMotionSamples;
  if (!motion_.empty() && (full || moment.unix_ns - motion_.front().unix_ns >= kSecond_ns)) finish_motion(out);
  motion_.push_back(moment);
  height_m_ = moment.height_m;
  if (moment.position_due) {
    writer_.append_body(out, moment.unix_ns, kmall::position(moment));
    writer_.append_body(out, moment.unix_ns, kmall::compatible_position(moment));
  }
  if (moment.clock_due) {
    writer_.append_body(out, moment.unix_ns, kmall::clock(moment.unix_ns));
    writer_.append_body(out, moment.unix_ns, kmall::surface_sound_speed(moment.unix_ns, sound_speed_mps_));
  }
}

void KmallFormat::finish_motion(formats::Bytes& out) {
  if (motion_.empty()) return;
  writer_.append_body(out, motion_.front().unix_ns, kmall::motion(motion_, before_));
  before_ = motion_.back();
  motion_.clear();
}

void KmallFormat::ping(const LoggedSoundings& ping, formats::Bytes& out) {
  if (part_ == Part::kWaterColumn && !ping.water_column) return;
  const msg::AppliedSettings& settings = ping.soundings.applied;
  sound_speed_mps_ = settings.sound_speed_mps;
  if (const formats::kmall::Runtime now = kmall::runtime(settings, simulator()); now != runtime_) {
    writer_.append_body(out, ping.unix_ns, now);
    runtime_ = now;
  }
  if (part_ == Part::kWaterColumn) {
    writer_.append_body(out, ping.unix_ns, kmall::heave(ping, config_.vessel));
    writer_.append_body(out, ping.unix_ns, kmall::water_column(ping, config_.vessel));
    return;
  }
  auto written = kmall::soundings(ping, config_.vessel, height_m_);
  if (simulator()) written.info.detection_mode = static_cast<std::uint8_t>(written.info.detection_mode + kSimulator);
  writer_.append_body(out, ping.unix_ns, std::move(written));
}

}  // namespace ensonify::logger
