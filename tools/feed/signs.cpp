#include "tools/feed/signs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "kernels/base/frames/attitude.h"
#include "kernels/base/frames/local_projection.h"
#include "kernels/vehicle/motion/gapped_curve.h"

namespace ensonify::feed_doctor {
namespace {

constexpr double kGap_s = 3.0;       // over which motion is not joined
constexpr double kWindow_s = 9.0;    // of the running mean: about a period of a ship's roll
constexpr double kSlowest_s = 2.0;   // between fixes, that still follow a roll
constexpr std::size_t kFewest = 30;  // samples
constexpr std::size_t kLags = 4;
constexpr double kSure = 4.0;           // standard errors
constexpr double kLeastHeight_m = 0.5;  // of an antenna above the roll centre
constexpr double kLeastOfHeave = 0.3;   // of 1
constexpr double kUnderWay_mps = 0.5;
constexpr double kEvery_s = 0.2;

motion::GappedCurve curve_of(const std::vector<Sampled>& samples, bool turns) {
  motion::GappedCurve curve({kGap_s, 0.0});
  double before = 0.0;
  for (const Sampled& sample : samples) {
    const double value = turns ? before + frames::wrap_pi(sample.value - before) : sample.value;
    curve.push(sample.t_s, value);
    before = value;
  }
  return curve;
}

/// Whether a curve has samples on both sides of a time, near it.
bool knows(const std::vector<Sampled>& samples, double t_s) {
  const auto after = std::ranges::lower_bound(samples, t_s, {}, &Sampled::t_s);
  return after != samples.begin() && after != samples.end() && after->t_s - (after - 1)->t_s <= kGap_s;
}

/// Of samples in even steps; where they stop being so, another stretch begins. Each is taken about its running mean.
class Stretches {
 public:
  using Vector = std::vector<double>;
  /// What is proportional to what, of a sample and of all columns about their means.
  using Pair = std::function<std::pair<double, double>(std::size_t sample, const Vector& columns)>;
  explicit Stretches(Pair pair) : pair_(std::move(pair)) {}

  void add(std::size_t sample, double t_s, const Vector& columns) {
    if (times_s_.size() == 1) step_s_ = t_s - times_s_.front();
    if (times_s_.size() > 1 && std::abs(t_s - times_s_.back() - step_s_) > 0.1 * step_s_) finish();
    times_s_.push_back(t_s);
    samples_.push_back(sample);
    columns_.resize(columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i) columns_[i].push_back(columns[i]);
  }

  std::optional<regression::Slope> slope() {
    finish();
    return regression::slope_through_zero(x_, y_, kLags);
  }

 private:
  void finish() {
    const auto half = static_cast<std::size_t>(std::max(2.0, std::round(0.5 * kWindow_s / std::max(step_s_, 1e-3))));
    std::vector<Vector> left;
    for (Vector& column : columns_) left.push_back(regression::about_running_mean(std::exchange(column, {}), half));
    for (std::size_t k = 0; !left.empty() && k < left.front().size(); ++k) {
      Vector columns;
      for (const Vector& column : left) columns.push_back(column[k]);
      const auto [x, y] = pair_(samples_[k + half], columns);
      x_.push_back(x);
      y_.push_back(y);
    }
    times_s_.clear();
    samples_.clear();
  }

  Pair pair_;
  double step_s_ = 0.0;
  Vector times_s_, x_, y_;
  std::vector<std::size_t> samples_;
  std::vector<Vector> columns_;
};

std::pair<double, double> first_two(std::size_t, const std::vector<double>& columns) {
  return {columns[0], columns[1]};
}

void judge(Sign& sign, double least) {
  if (!sign.slope || sign.slope->count < kFewest) {
    sign.why = "too few samples with both";
  } else if (std::abs(sign.slope->value) <= std::max(kSure * sign.slope->standard_error, least)) {
    sign.why = "the two do not go together clearly";
  } else {
    sign.is = sign.slope->value > 0.0 ? Sign::Is::kRight : Sign::Is::kReversed;
  }
}

/// Of roll, by the way of the antenna across the heading.
Sign roll_by_antenna(const Findings& found) {
  Sign sign{.of = "roll", .by = "the antenna's way across"};
  const std::vector<Sampled>& angles = found.roll_rad;
  if (angles.empty() || found.fixes.size() < kFewest) {
    sign.why = angles.empty() ? "there is none" : "too few fixes";
    return sign;
  }
  const double mean_step_s =
      (found.fixes.back().t_s - found.fixes.front().t_s) / static_cast<double>(found.fixes.size() - 1);
  if (mean_step_s > kSlowest_s) {
    sign.why = "fixes come too seldom";
    return sign;
  }
  const motion::GappedCurve angle = curve_of(angles, false), heading = curve_of(found.heading_rad, true);
  const frames::LocalProjection map(found.fixes.front().place);
  std::vector<frames::Vec2> places;
  for (const Placed& fix : found.fixes) places.push_back(map.enu_of(fix.place));
  std::vector<double> heading_rad(places.size());
  Stretches pairs([&](std::size_t i, const std::vector<double>& columns) {
    const frames::Vec2 starboard(std::cos(heading_rad[i]), -std::sin(heading_rad[i])), off(columns[1], columns[2]);
    return std::pair(columns[0], off.dot(starboard));
  });
  const auto half = static_cast<std::size_t>(std::max(1.0, std::round(0.5 * kWindow_s / mean_step_s)));
  for (std::size_t i = half; i + half < places.size(); ++i) {
    const double t_s = found.fixes[i].t_s;
    if (!knows(angles, t_s)) continue;
    const frames::Vec2 way = places[i + half] - places[i - half];
    if (knows(found.heading_rad, t_s)) heading_rad[i] = heading.at(t_s).value;
    else if (way.norm() > kUnderWay_mps * 2.0 * static_cast<double>(half) * mean_step_s)
      heading_rad[i] = std::atan2(way.x(), way.y());
    else continue;
    pairs.add(i, t_s, {std::sin(angle.at(t_s).value), places[i].x(), places[i].y()});
  }
  sign.slope = pairs.slope();
  judge(sign, kLeastHeight_m);
  return sign;
}

Sign heave_by_fixes(const Findings& found) {
  Sign sign{.of = "heave", .by = "the height of the fixes"};
  if (found.heave_m.empty()) {
    sign.why = "there is none";
    return sign;
  }
  const motion::GappedCurve heave = curve_of(found.heave_m, false);
  Stretches pairs(first_two);
  for (const Placed& fix : found.fixes) {
    if (fix.height_m && knows(found.heave_m, fix.t_s)) pairs.add(0, fix.t_s, {heave.at(fix.t_s).value, *fix.height_m});
  }
  sign.slope = pairs.slope();
  judge(sign, kLeastOfHeave);
  return sign;
}

Sign heave_by_acceleration(const Findings& found) {
  Sign sign{.of = "heave", .by = "the sensor's own vertical acceleration"};
  const motion::GappedCurve heave = curve_of(found.heave_m, false);
  const motion::GappedCurve acceleration = curve_of(found.acceleration_mps2, false);
  Stretches pairs(first_two);
  const double from_s = found.heave_m.empty() ? 0.0 : found.heave_m.front().t_s,
               to_s = found.heave_m.empty() ? 0.0 : found.heave_m.back().t_s;
  for (int i = 0; from_s + kEvery_s * i < to_s; ++i) {  // arrivals are not even
    const double t_s = from_s + kEvery_s * i;
    if (knows(found.heave_m, t_s) && knows(found.acceleration_mps2, t_s))
      pairs.add(0, t_s, {heave.at(t_s).value, -acceleration.at(t_s).value});
  }
  sign.slope = pairs.slope();
  judge(sign, 0.0);
  return sign;
}

}  // namespace

std::vector<Sign> signs_of(const Findings& found) {
  // Sensors that measure none send zeros.
  const bool accelerates =
      std::ranges::any_of(found.acceleration_mps2, [](const Sampled& sample) { return sample.value != 0.0; });
  return {roll_by_antenna(found), accelerates ? heave_by_acceleration(found) : heave_by_fixes(found)};
}

}  // namespace ensonify::feed_doctor
