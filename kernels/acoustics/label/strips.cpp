#include "kernels/acoustics/label/strips.h"

#include <algorithm>
#include <cmath>

namespace ensonify::label {
namespace {

/// A place in a strip where a ray is missing.
struct Gap {
  std::size_t strip, after;  // the point before it
};

bool ends_between(const RayEcho& a, const RayEcho& b) {
  return a.contributor != b.contributor && (trace::is_body(a.contributor) || trace::is_body(b.contributor));
}

bool wants_more(const Point& a, const Point& b, const Fineness& fineness) {
  if (ends_between(a.first, b.first)) return true;
  if (a.seabed.hit() != b.seabed.hit()) return true;
  if (a.seabed.hit() && std::abs(a.seabed.time_s - b.seabed.time_s) > static_cast<float>(fineness.seabed_s))
    return true;
  return trace::is_body(a.first.contributor) &&
         std::abs(a.first.time_s - b.first.time_s) > static_cast<float>(fineness.body_s);
}

/// Rays at these angles of these strips, and their echoes.
class Tracer {
 public:
  Tracer(const Axes& axes, const TraceEchoes& trace) : axes_(axes), trace_(trace) {}

  void clear() { points_.clear(), rays_.clear(); }
  void add(double sine, double angle_rad) {
    points_.push_back({angle_rad, {}, {}});
    rays_.push_back({axes_.direction(sine, angle_rad), 1.0F});
  }
  std::span<const Point> traced() {
    trace_(rays_, false, echoes_);
    trace::Rays behind;
    std::vector<std::size_t> whose;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      points_[i].first = echoes_[i];
      if (trace::is_body(echoes_[i].contributor)) {
        behind.push_back(rays_[i]);
        whose.push_back(i);
      } else {
        points_[i].seabed = echoes_[i];
      }
    }
    if (whose.empty()) return points_;
    trace_(behind, true, echoes_);
    for (std::size_t i = 0; i < whose.size(); ++i) points_[whose[i]].seabed = echoes_[i];
    return points_;
  }

 private:
  const Axes& axes_;
  const TraceEchoes& trace_;
  trace::Rays rays_;
  std::vector<Point> points_;
  std::vector<RayEcho> echoes_;
};

}  // namespace

Eigen::Vector3f Axes::direction(double sine, double angle_rad) const {
  const double across = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  return static_cast<float>(sine) * axis + static_cast<float>(across * std::cos(angle_rad)) * zero +
         static_cast<float>(across * std::sin(angle_rad)) * quarter;
}

void trace_strips(const Axes& axes, std::span<const Strip> strips, const Fineness& fineness, const TraceEchoes& trace,
                  std::vector<std::vector<Point>>& points) {
  points.assign(strips.size(), {});
  Tracer tracer(axes, trace);
  for (const Strip& strip : strips) {
    for (int i = 0; i <= strip.steps; ++i)
      tracer.add(strip.sine, std::lerp(strip.first_rad, strip.last_rad, static_cast<double>(i) / strip.steps));
  }
  std::span<const Point> traced = tracer.traced();
  for (std::size_t s = 0; s < strips.size(); ++s) {
    const auto count = static_cast<std::size_t>(strips[s].steps) + 1;
    points[s].assign(traced.begin(), traced.begin() + static_cast<std::ptrdiff_t>(count));
    traced = traced.subspan(count);
  }

  std::vector<Gap> gaps;
  std::vector<Point> merged;
  for (int halving = 0; halving < fineness.halvings; ++halving) {
    gaps.clear();
    tracer.clear();
    for (std::size_t s = 0; s < strips.size(); ++s) {
      for (std::size_t i = 0; i + 1 < points[s].size(); ++i) {
        const Point &a = points[s][i], &b = points[s][i + 1];
        if (!wants_more(a, b, fineness)) continue;
        gaps.push_back({s, i});
        tracer.add(strips[s].sine, 0.5 * (a.angle_rad + b.angle_rad));
      }
    }
    if (gaps.empty()) return;
    traced = tracer.traced();
    for (std::size_t g = 0; g < gaps.size();) {
      const std::size_t s = gaps[g].strip;
      merged.clear();
      for (std::size_t i = 0; i < points[s].size(); ++i) {
        merged.push_back(points[s][i]);
        if (g < gaps.size() && gaps[g].strip == s && gaps[g].after == i) merged.push_back(traced[g++]);
      }
      points[s].swap(merged);
    }
  }
}

}  // namespace ensonify::label
