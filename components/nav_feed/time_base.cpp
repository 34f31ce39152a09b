#include "components/nav_feed/time_base.h"

#include <cmath>

#include "components/formats/time_of_day.h"

namespace ensonify {

using formats::kDay_s;

void TimeBase::bind(double time_of_day_s, double run_s) {
  *this = {};
  bound_ = true;
  midnight_s_ = run_s - time_of_day_s;
  leap_seen_ = time_of_day_s >= kDay_s;
}

double TimeBase::days_on(double time_of_day_s, double arrival_s) const {
  return std::round((arrival_s - midnight_s_ - time_of_day_s) / kDay_s);
}

double TimeBase::run_s(double time_of_day_s, double arrival_s) const {
  const double days = days_on(time_of_day_s, arrival_s);
  const double plain_s = midnight_s_ + time_of_day_s + kDay_s * days;
  if (days < 0.0) return plain_s - (yesterday_s_ - kDay_s);
  const bool leap = days > 0.0 && leap_seen_ && plain_s + 0.5 < arrival_s + last_ahead_s_;
  return leap ? plain_s + 1.0 : plain_s;
}

double TimeBase::follow(double time_of_day_s, double arrival_s) {
  const double days = days_on(time_of_day_s, arrival_s), found_s = run_s(time_of_day_s, arrival_s);
  if (days > 0.0) {
    const double next_midnight_s = found_s - time_of_day_s;
    yesterday_s_ = next_midnight_s - midnight_s_ - kDay_s * (days - 1.0);
    midnight_s_ = next_midnight_s;
    leap_seen_ = false;
  }
  leap_seen_ = leap_seen_ || (days >= 0.0 && time_of_day_s >= kDay_s);
  last_ahead_s_ = found_s - arrival_s;
  return found_s;
}

}  // namespace ensonify
