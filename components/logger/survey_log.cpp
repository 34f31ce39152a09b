#include "components/logger/survey_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "components/formats/utc.h"
#include "components/logger/head_track.h"

namespace ensonify::logger {

namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kLeastLead_ns = kSecond_ns;
constexpr int kLeastPositions = 3;
constexpr std::size_t kKept = 16;  // images and water columns: each comes with its soundings

/// The next multiple of a period, at `stamp_ns` or later.
std::int64_t next_multiple(std::int64_t stamp_ns, std::int64_t period_ns) {
  return (stamp_ns + period_ns - 1) / period_ns * period_ns;
}

/// Whether this is due, at the multiples of a period from the first time on.
bool is_due(std::optional<std::int64_t>& next_ns, std::int64_t stamp_ns, std::int64_t period_ns) {
  if (next_ns && stamp_ns < *next_ns) return false;
  next_ns = next_multiple(stamp_ns + 1, period_ns);
  return true;
}

std::int64_t stamp_of(const msg::Soundings& soundings) { return soundings.stamp_ns; }
std::int64_t stamp_of(const SidescanPing& ping) { return ping.transmissions.front().stamp_ns; }
bool has_pose(const msg::Soundings& soundings) { return has_track(soundings.track); }
bool has_pose(const SidescanPing& ping) { return has_track(ping.transmissions.front().track); }
std::int64_t sent_ns(const std::variant<msg::Soundings, SidescanPing>& ping) {
  return std::visit([](const auto& one) { return stamp_of(one); }, ping);
}
const msg::AppliedSettings& settings_of(const msg::Soundings& soundings) { return soundings.applied; }
const msg::AppliedSettings& settings_of(const SidescanPing& ping) { return ping.transmissions.front().applied; }

/// The one of a ping, of those that came by rising number; they and what is older are forgotten.
template <class Message>
std::optional<Message> taken_of(std::int64_t ping, std::deque<Message>& kept) {
  std::optional<Message> found;
  while (!kept.empty() && kept.front().ping <= ping) {
    if (kept.front().ping == ping) found = std::move(kept.front());
    kept.pop_front();
  }
  while (kept.size() > kKept) kept.pop_front();
  return found;
}

}  // namespace

SurveyLog::SurveyLog(const LoggerConfig& config, std::vector<std::unique_ptr<Format>> formats, Files& files)
    : config_(config), formats_(std::move(formats)), files_(files) {}

void SurveyLog::take(const msg::MissionState& state) {
  line_changed_ = line_changed_ || (state.line >= 0 && line_ >= 0 && state.line != line_);
  if (state.line >= 0) line_ = state.line;
}

/// So much navigation stands before a file's first ping.
std::int64_t SurveyLog::lead_ns() const {
  return std::max(kLeastLead_ns, kLeastPositions * kSecond_ns / config_.position_rate_hz);
}

void SurveyLog::close(const frames::LocalProjection& world) {
  write(world, true);
  end_files();
}

void SurveyLog::write(const frames::LocalProjection& world, bool all) {
  for (const msg::Estimate& estimate : estimates_) add(estimate, world);
  estimates_.clear();
  std::stable_sort(pings_.begin(), pings_.end(), [](const Ping& a, const Ping& b) { return sent_ns(a) < sent_ns(b); });
  for (; !pings_.empty(); pings_.pop_front()) {
    const Ping& ping = pings_.front();
    const std::int64_t ping_ns = sent_ns(ping);
    // Its heave lies between two that are known.
    if (!all && heave_.newest_ns().value_or(0) < ping_ns) break;
    const bool posed = std::visit([](const auto& one) { return has_pose(one); }, ping);
    if (!posed || !(files_begun_ > 0 || begins(ping_ns))) {
      ++left_out_;
      continue;
    }
    if (files_begun_ == 0 || next_file_due(ping_ns)) start_files(ping);
    write(ping, world);
  }
}

void SurveyLog::add(const msg::Estimate& estimate, const frames::LocalProjection& world) {
  const msg::Position fix = fix_.value_or(msg::Position{});
  Moment moment = moment_of(estimate, fix, heave_.down_m(estimate.stamp_ns), config_, world);
  moment.position_due = is_due(next_position_ns_, moment.stamp_ns, kSecond_ns / config_.position_rate_hz);
  moment.clock_due = is_due(next_clock_ns_, moment.stamp_ns, kSecond_ns);
  if (moment.position_due) moment.gga = gga_of(moment, fix, config_.mark_simulated);
  if (files_begun_ > 0) each_format([&](Format& format, formats::Bytes& out) { format.moment(moment, out); });
  lead_.push_back(std::move(moment));
  while (lead_.front().stamp_ns < estimate.stamp_ns - kept_ns()) lead_.pop_front();
}

bool SurveyLog::begins(std::int64_t ping_ns) const {
  if (lead_.empty()) return false;
  const std::int64_t first_ns = lead_.front().stamp_ns;  // a second of attitude, which some formats gather, is over
  return first_ns <= ping_ns - lead_ns() && lead_.back().stamp_ns >= first_ns + kSecond_ns;
}

bool SurveyLog::next_file_due(std::int64_t ping_ns) const {
  if (ping_ns - begun_ns_ < kept_ns()) return false;  // else navigation would be said a third time
  if (config_.rotate_lines && line_changed_) return true;
  if (config_.rotate_s > 0.0 && static_cast<double>(ping_ns - begun_ns_) >= config_.rotate_s * 1e9) return true;
  if (config_.rotate_mb <= 0.0) return false;
  for (std::size_t i = 0; i < formats_.size(); ++i) {
    if (static_cast<double>(files_.bytes(i)) >= config_.rotate_mb * 1e6) return true;
  }
  return false;
}

template <class Append>
void SurveyLog::each_format(const Append& append) {
  for (std::size_t i = 0; i < formats_.size(); ++i) {
    formats::Bytes out;
    append(*formats_[i], out);
    if (!out.empty()) files_.put(i, out);
  }
}

/// As instruments name their files: 0000_20250601_120000_boat.all.
std::string SurveyLog::file_name(const Format& format, std::int64_t unix_ns) const {
  const formats::DayTime time = formats::day_time(unix_ns);
  std::string ship = config_.ship;
  std::replace_if(
      ship.begin(), ship.end(), [](char c) { return c == '/' || c == ' ' || c == ','; }, '-');
  return fmt::format("{:04}_{:08}_{:02}{:02}{:02}_{}{}", (config_.line + files_begun_) % 10'000, time.date,
                     time.time_ms / 3'600'000, time.time_ms / 60'000 % 60, time.time_ms / 1'000 % 60, ship,
                     format.ending());
}

std::vector<Moment> SurveyLog::lead_of_files() const {
  if (files_begun_ == 0) return {lead_.begin(), lead_.end()};
  std::vector<Moment> lead;
  for (std::size_t i = 1; i < lead_.size(); ++i) {
    lead.push_back(between(lead_[i - 1], lead_[i]));
    if (lead.back().position_due)
      lead.back().gga = gga_of(lead.back(), fix_.value_or(msg::Position{}), config_.mark_simulated);
  }
  return lead;
}

void SurveyLog::start_files(const Ping& first) {
  end_files();
  const std::vector<Moment> lead = lead_of_files();
  const std::int64_t begin_ns = lead.front().unix_ns;
  for (std::size_t i = 0; i < formats_.size(); ++i) {
    const std::string name = file_name(*formats_[i], begin_ns);
    files_.open(i, name);
    formats::Bytes out;
    formats_[i]->begin(
        {begin_ns, name, lead.front().reference,
         std::visit([](const auto& one) -> const msg::AppliedSettings& { return settings_of(one); }, first)},
        out);
    for (const Moment& moment : lead) formats_[i]->moment(moment, out);
    files_.put(i, out);
  }
  begun_ns_ = sent_ns(first);
  line_changed_ = false;
  ++files_begun_;
}

void SurveyLog::end_files() {
  if (files_begun_ == 0) return;
  each_format([](Format& format, formats::Bytes& out) { format.end(out); });
  for (std::size_t i = 0; i < formats_.size(); ++i) files_.close(i);
}

void SurveyLog::write(const Ping& ping, const frames::LocalProjection& world) {
  const std::int64_t ping_ns = sent_ns(ping);
  const std::int64_t unix_ns = config_.start_unix_ns + ping_ns;
  const double heave_down_m = heave_.down_m(ping_ns);
  if (const auto* soundings = std::get_if<msg::Soundings>(&ping)) {
    const auto image = taken_of(soundings->ping, images_);
    const auto column = taken_of(soundings->ping, columns_);
    const LoggedSoundings logged{*soundings, image, column, unix_ns, heave_down_m, world};
    each_format([&](Format& format, formats::Bytes& out) { format.ping(logged, out); });
  } else {
    const LoggedSidescan logged{std::get<SidescanPing>(ping), unix_ns, heave_down_m, world};
    each_format([&](Format& format, formats::Bytes& out) { format.ping(logged, out); });
  }
}

}  // namespace ensonify::logger
