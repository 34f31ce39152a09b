#include "components/feeds/log_player.h"

#include <utility>

#include "components/errors/exit_error.h"
#include "components/formats/nmea/navigation.h"
#include "components/formats/time_of_day.h"

namespace ensonify {
namespace {

constexpr double kLongestPause_s = 3600.0;
constexpr double kSmallStepBack_s = 1.0;  // sentences of one second in another order

std::optional<double> time_of(const nmea::Navigation& sentence) {
  if (const auto* fix = std::get_if<nmea::Fix>(&sentence); fix != nullptr && fix->quality > 0) return fix->time_s;
  if (const auto* fix = std::get_if<nmea::MinimumFix>(&sentence); fix != nullptr && fix->fix.quality > 0) {
    return fix->fix.time_s;
  }
  if (const auto* motion = std::get_if<formats::Motion>(&sentence)) return motion->time_s;
  if (const auto* clock = std::get_if<nmea::DateAndTime>(&sentence)) return clock->time_s;
  return std::nullopt;
}

/// What a logger puts before a sentence is left out.
std::string without_stamp(const std::string& line) {
  const std::size_t begin = line.find('$');
  return begin == std::string::npos ? line : line.substr(begin);
}

}  // namespace

LogPlayer::LogPlayer(const std::string& path) : file_(path) {
  if (!file_) throw UserError(path + ": cannot be read");
  std::string line;
  while (std::getline(file_, line)) {
    if (time_of(nmea::read_navigation(without_stamp(line)))) {
      file_.clear();
      file_.seekg(0);
      return;
    }
  }
  throw UserError(path + ": no sentence of it has a time; needs some that do, such as ZDA, RMC or GGA");
}

void LogPlayer::read_next() {
  std::string line;
  if (!std::getline(file_, line)) return;
  line = without_stamp(line);
  if (const auto time_s = time_of(nmea::read_navigation(line))) {
    const double step_s = time_of_day_s_ ? formats::time_of_day_step_s(*time_of_day_s_, *time_s) : 0.0;
    if (step_s > 0.0 && step_s <= kLongestPause_s) time_ += from_seconds(step_s);
    if (step_s > 0.0 || step_s < -kSmallStepBack_s || !time_of_day_s_) time_of_day_s_ = time_s;
  }
  next_ = Line{line + '\n', time_};
}

std::optional<LogPlayer::Line> LogPlayer::take(SimTime now) {
  if (!next_) {
    if (!time_of_day_s_) time_ = now;
    read_next();
  }
  if (!next_ || next_->arrival > now) return std::nullopt;
  return std::exchange(next_, std::nullopt);
}

}  // namespace ensonify
