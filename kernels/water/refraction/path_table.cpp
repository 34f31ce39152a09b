#include "kernels/water/refraction/path_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "kernels/base/isa/wide.h"
#include "kernels/water/refraction/path.h"

namespace ensonify::refraction {
namespace {

constexpr int kBitsPerOctave = 4;  // 16 intervals
constexpr int kShift = 52 - kBitsPerOctave;
constexpr double kFlattest = 0x1p-6;
const std::uint64_t kFirst = std::bit_cast<std::uint64_t>(kFlattest) >> kShift;
const std::uint64_t kIntervals = (std::bit_cast<std::uint64_t>(1.0) >> kShift) - kFirst;

/// Interval edges are the numbers of kBitsPerOctave significant bits: the interval of a number is in its own bits.
double edge(std::uint64_t interval) { return std::bit_cast<double>((kFirst + interval) << kShift); }

}  // namespace

/// Exact sums over the layers for one w, and their slopes in w; all times w.
struct PathTable::Node {
  double reach = 0.0, reach_slope = 0.0, time = 0.0, time_slope = 0.0, length = 0.0, length_slope = 0.0;

  Node(double w, double fastest_mps, std::span<const Knot> edges) {
    const double cosine2 = (1.0 - w) * (1.0 + w);
    const double p2 = cosine2 / (fastest_mps * fastest_mps), p = std::sqrt(p2);
    double spread = 0.0, bend = 0.0, stretch = 0.0;  // slopes in p over p: of time, reach and length
    double c1 = 0.0, sine1 = 0.0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const double c2 = edges[i].speed_mps, ratio = c2 / fastest_mps;
      const double sine2 = std::sqrt(w * w + cosine2 * (1.0 - ratio) * (1.0 + ratio));
      if (i > 0) {
        const double dz = edges[i].depth_m - edges[i - 1].depth_m;
        const double sines = sine1 + sine2, speeds = c1 + c2, product = sine1 * sine2;
        const double q = dz * speeds / sines;
        const double chord = dz * std::sqrt(sines * sines + p2 * speeds * speeds) / sines;
        const double gradient = (c2 - c1) / dz;
        const double widening = q / product;
        reach += q;
        time += arc_s(gradient, chord, c1, c2);
        const double arc = arc_m(p * gradient, chord);
        length += arc;
        spread += widening;
        bend += widening * (c1 * c1 + c2 * c2 - p2 * c1 * c1 * c2 * c2) / (1.0 + product);
        stretch += cosine2 > 1e-3 ? (dz * speeds / (product * (c1 * sine2 + c2 * sine1)) - arc) / p2
                                  : dz * (c1 * c1 + c1 * c2 + c2 * c2) / 3.0;  // vertical: its limit
      }
      c1 = c2;
      sine1 = sine2;
    }
    const double per_w = -w / (fastest_mps * fastest_mps);  // p dp/dw
    reach_slope = reach + w * per_w * bend;
    time_slope = time + w * per_w * spread;
    length_slope = length + w * per_w * stretch;
    reach *= w;
    time *= w;
    length *= w;
  }
};

void PathTable::build(const SoundSpeedProfile& profile, double source_depth_m, double level_m) {
  if (!std::isfinite(source_depth_m) || !std::isfinite(level_m)) {
    throw std::invalid_argument("the depths of a table of paths must be finite");
  }
  profile_ = profile;
  source_depth_m_ = source_depth_m;
  level_m_ = level_m;
  const double source_speed_mps = profile.speed_mps(source_depth_m);
  source_slowness_spm_ = 1.0 / source_speed_mps;
  intervals_.clear();
  if (!(level_m > source_depth_m)) return;

  edges_.assign(1, {source_depth_m, source_speed_mps});
  for (const Knot& knot : profile.knots()) {
    if (knot.depth_m > source_depth_m && knot.depth_m < level_m) edges_.push_back(knot);
  }
  edges_.push_back({level_m, profile.speed_mps(level_m)});
  fastest_mps_ = std::ranges::max(edges_, {}, &Knot::speed_mps).speed_mps;
  fall_from_source_ = (fastest_mps_ / source_speed_mps) * (fastest_mps_ / source_speed_mps) - 1.0;
  const double level_ratio = edges_.back().speed_mps / fastest_mps_;
  rise_to_level_ = (1.0 - level_ratio) * (1.0 + level_ratio);
  at_level_ = {.depth_m = level_m, .speed_mps = edges_.back().speed_mps, .layer = profile.layer_at(level_m)};
  level_gradient_per_s_ = profile.layer_gradient_per_s(at_level_.layer);

  const auto cubic = [](double from, double slope_from, double to, double slope_to, double width) {
    const double m1 = slope_from * width, m2 = slope_to * width, rise = to - from;
    return Cubic{from, m1, 3.0 * rise - 2.0 * m1 - m2, m1 + m2 - 2.0 * rise};
  };
  Node before(edge(0), fastest_mps_, edges_);
  for (std::uint64_t i = 0; i < kIntervals; ++i) {
    const double low = edge(i), width = edge(i + 1) - low;
    const Node after(edge(i + 1), fastest_mps_, edges_);
    intervals_.push_back({low, 1.0 / width,
                          cubic(before.reach, before.reach_slope, after.reach, after.reach_slope, width),
                          cubic(before.time, before.time_slope, after.time, after.time_slope, width),
                          cubic(before.length, before.length_slope, after.length, after.length_slope, width)});
    before = after;
  }
}

ENSONIFY_WIDE bool PathTable::paths(const LevelPaths::Column& sine, const LevelPaths::Column& cosine,
                                    LevelPaths& found) const {
  constexpr std::size_t kLanes = LevelPaths::kLanes;
  LevelPaths::Column w2;
  double flattest = 1.0, upmost = 1.0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    w2[lane] = sine[lane] * sine[lane] - cosine[lane] * cosine[lane] * fall_from_source_;
    flattest = w2[lane] < flattest ? w2[lane] : flattest;
    upmost = sine[lane] < upmost ? sine[lane] : upmost;
  }
  if (intervals_.empty() || !(upmost > 0.0) || !(flattest >= kFlattest * kFlattest)) return false;

  LevelPaths::Column w, per_w, reach_slope;
  std::array<std::uint64_t, kLanes> index;
  std::uint64_t first = kIntervals, last = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    w[lane] = std::sqrt(w2[lane]);
    per_w[lane] = 1.0 / w[lane];
    index[lane] = std::min((std::bit_cast<std::uint64_t>(w[lane]) >> kShift) - kFirst, kIntervals - 1);
    first = std::min(first, index[lane]);
    last = std::max(last, index[lane]);
  }
  const auto look_up = [&](const auto& interval_of) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Interval& in = interval_of(lane);
      const double u = (w[lane] - in.low) * in.per_width;
      found.time_s[lane] = in.time.value(u);
      found.length_m[lane] = in.length.value(u);
      found.reach_m2ps[lane] = in.reach.value(u);
      reach_slope[lane] = in.per_width * in.reach.slope(u);
    }
  };
  if (first == last) {  // as of rays that lie close together: nothing to gather
    const Interval same = intervals_[first];
    look_up([&same](std::size_t) -> const Interval& { return same; });
  } else {
    look_up([&](std::size_t lane) -> const Interval& { return intervals_[index[lane]]; });
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const double p = cosine[lane] * source_slowness_spm_, p2 = p * p;
    const double cosine2_fastest = p2 * fastest_mps_ * fastest_mps_;
    const double reach = per_w[lane] * found.reach_m2ps[lane];
    const double at_level = std::sqrt(w2[lane] + cosine2_fastest * rise_to_level_);
    const double reach_per_w = per_w[lane] * (reach_slope[lane] - reach);
    const double spread = reach - cosine2_fastest * per_w[lane] * reach_per_w;
    found.invariant_spm[lane] = p;
    found.sine[lane] = at_level;
    found.cosine[lane] = p * at_level_.speed_mps;
    found.time_s[lane] *= per_w[lane];
    found.length_m[lane] *= per_w[lane];
    found.reach_m2ps[lane] = reach;
    found.width_m[lane] = spread * at_level * sine[lane] * source_slowness_spm_;
    found.width_slowness[lane] =
        (sine[lane] * source_slowness_spm_ - found.width_m[lane] * p2 * level_gradient_per_s_) / at_level;
  }
  return true;
}

Path PathTable::path(double sine, double cosine) const {
  const double w2 = sine * sine - cosine * cosine * fall_from_source_;
  if (intervals_.empty() || !(sine > 0.0) || !(w2 >= kFlattest * kFlattest)) {
    return Path(profile_, source_depth_m_, sine, cosine);
  }
  const double w = std::sqrt(w2), per_w = 1.0 / w;
  const std::uint64_t index = std::min((std::bit_cast<std::uint64_t>(w) >> kShift) - kFirst, kIntervals - 1);
  const Interval& in = intervals_[index];
  const double u = (w - in.low) * in.per_width;

  PathPoint point = at_level_;
  const double p = cosine * source_slowness_spm_, p2 = p * p;
  const double cosine2_fastest = p2 * fastest_mps_ * fastest_mps_;
  point.sine = std::sqrt(w2 + cosine2_fastest * rise_to_level_);
  point.cosine = p * point.speed_mps;
  point.time_s = per_w * in.time.value(u);
  point.length_m = per_w * in.length.value(u);
  point.reach_m2ps = per_w * in.reach.value(u);
  // dx/dp = reach + p d(reach)/dp, and the width from it and its slope beyond the level (see path.cpp)
  const double reach_per_w = per_w * (in.per_width * in.reach.slope(u) - point.reach_m2ps);
  const double spread = point.reach_m2ps - cosine2_fastest * per_w * reach_per_w;
  point.width_m = spread * point.sine * sine * source_slowness_spm_;
  point.width_slowness = (sine * source_slowness_spm_ - point.width_m * p2 * level_gradient_per_s_) / point.sine;
  return Path(profile_, p, source_slowness_spm_, point);
}

std::optional<PathEnd> PathTable::at(double depression_rad, double depth_m) const {
  const Path from = path(std::sin(depression_rad), std::cos(depression_rad));
  if (depth_m < from.at().depth_m) return path_to_depth(profile_, source_depth_m_, depression_rad, depth_m, 1);
  return path_to_depth(from, depth_m, 1);
}

}  // namespace ensonify::refraction
