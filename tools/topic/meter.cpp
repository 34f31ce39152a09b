#include "tools/topic/meter.h"

#include <algorithm>
#include <cmath>

namespace ensonify::topic_tool {

namespace {

/// Sums for a mean and a standard deviation.
struct Moments {
  double count = 0.0;
  double mean = 0.0;
  double squares = 0.0;  // sum of squared distances from the mean, by Welford's method

  void add(double x) {
    count += 1.0;
    const double before = x - mean;
    mean += before / count;
    squares += before * (x - mean);
  }
  Interval interval() const { return {mean, count > 0.0 ? std::sqrt(squares / count) : 0.0}; }
};

double per(double amount, double span_s) { return span_s > 0.0 ? amount / span_s : 0.0; }

}  // namespace

void Meter::add(WallTime arrived, SimTime t_sim, std::uint64_t seq, std::size_t bytes) {
  if (!last_.empty() && seq <= last_.back().seq) last_.clear();  // another epoch
  if (!last_.empty()) dropped_ += seq - last_.back().seq - 1;
  ++received_;
  last_.push_back({arrived, t_sim, seq, bytes});
  if (last_.size() > window_) last_.pop_front();
}

Traffic Meter::traffic() const {
  Traffic t;
  t.received = received_;
  t.dropped = dropped_;
  if (last_.empty()) return t;
  Moments wall;
  Moments sim;
  Moments bytes;
  t.min_bytes = last_.front().bytes;
  for (std::size_t i = 0; i < last_.size(); ++i) {
    bytes.add(static_cast<double>(last_[i].bytes));
    t.min_bytes = std::min(t.min_bytes, last_[i].bytes);
    t.max_bytes = std::max(t.max_bytes, last_[i].bytes);
    if (i == 0 || last_[i].seq != last_[i - 1].seq + 1) continue;
    wall.add(std::chrono::duration<double>(last_[i].wall - last_[i - 1].wall).count());
    sim.add(seconds(last_[i].sim - last_[i - 1].sim));
  }
  t.wall = wall.interval();
  t.sim = sim.interval();
  t.mean_bytes = bytes.mean;
  const auto published = static_cast<double>(last_.back().seq - last_.front().seq);
  t.wall_hz = per(published, std::chrono::duration<double>(last_.back().wall - last_.front().wall).count());
  t.sim_hz = per(published, seconds(last_.back().sim - last_.front().sim));
  t.wall_bytes_per_s = t.wall_hz * t.mean_bytes;
  t.sim_bytes_per_s = t.sim_hz * t.mean_bytes;
  return t;
}

}  // namespace ensonify::topic_tool
