#include "components/nav_feed/fix_trial.h"

#include <cmath>

#include "components/formats/time_of_day.h"

namespace ensonify {
namespace {

using formats::time_of_day_step_s;

constexpr std::size_t kFewest = 3;
constexpr double kShortest_s = 1.0;
constexpr std::size_t kMost = 256;  // more are not needed, whatever their rate: the one before the newest gives way

}  // namespace

bool FixTrial::agree(const ArrivedFix& before, const ArrivedFix& after) const {
  const double step_s = time_of_day_step_s(before.fix.time_s, after.fix.time_s);
  const double passed_s = seconds(after.arrival - before.arrival);
  const double way_m = (after.position_enu_m - before.position_enu_m).norm();
  return step_s > 0.0 && std::abs(step_s - passed_s) <= limits_.time_jump_s && way_m <= limits_.fastest_mps * step_s;
}

std::size_t FixTrial::add(const ArrivedFix& fix) {
  if (is_on() && fix.fix.time_s == fixes_.back().fix.time_s) return 0;
  const std::size_t given_up = is_on() && !agree(fixes_.back(), fix) ? fixes_.size() : 0;
  if (given_up > 0) clear();
  if (fixes_.size() == kMost) fixes_.pop_back();
  fixes_.push_back(fix);
  return given_up;
}

bool FixTrial::is_accepted() const {
  return fixes_.size() >= kFewest &&
         time_of_day_step_s(fixes_.front().fix.time_s, fixes_.back().fix.time_s) >= kShortest_s;
}

}  // namespace ensonify
