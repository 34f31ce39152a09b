#include "kernels/acoustics/label/shadows.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ensonify::label {
namespace {

constexpr float kOwnShadow = 0.25F;  // of the lobe that the seabed covers, at most: -6 dB

/// What a body blocks of a sample.
struct Blocked {
  std::int32_t sample;
  std::uint32_t body;
  float level_upa2;
};

/// A strip by samples.
struct Profile {
  std::vector<float> seabed_upa2;  // without bodies
  std::vector<char> there;         // the seabed is there
  std::vector<Blocked> blocked;
  double sine = 0.0;  // of arrival, mean
};

/// Shares the seabed between two neighbours out to the samples between them.
void add_between(const Strip& strip, const Point& a, const Point& b, const echo::Sampling& sampling,
                 double samples_per_period, Profile& profile) {
  const double sent =
      0.5 * static_cast<double>(a.seabed.level_upa2 + b.seabed.level_upa2) * (b.angle_rad - a.angle_rad) * strip.width;
  const auto at = [&](const RayEcho& echo) { return (echo.time_s - sampling.start_s) / sampling.period_s + 0.5; };
  const auto [from, to] = std::minmax({at(a.seabed), at(b.seabed)});
  const double length = std::max(to - from, 1e-6);
  // A gap that is narrower than the edge in it is half of either side's.
  std::array<std::uint32_t, 2> by{trace::kNoise, trace::kNoise};
  if (trace::is_body(a.first.contributor)) by[0] = a.first.contributor;
  if (trace::is_body(b.first.contributor)) by[1] = b.first.contributor;
  const auto first = std::max(0, static_cast<std::int32_t>(std::floor(from)));
  const auto end = std::min(sampling.count, static_cast<std::int32_t>(std::floor(to)) + 1);
  for (std::int32_t k = first; k < end; ++k) {
    const double part = std::min(to, k + 1.0) - std::max(from, static_cast<double>(k));
    const auto level =
        static_cast<float>(std::max(0.0, to - from > 1e-6 ? part / length : 1.0) * sent * samples_per_period);
    profile.seabed_upa2[static_cast<std::size_t>(k)] += level;
    profile.there[static_cast<std::size_t>(k)] = 1;
    for (const std::uint32_t body : by) {
      if (body != trace::kNoise) profile.blocked.push_back({k, body, 0.5F * level});
    }
  }
}

Profile profile_of(const Strip& strip, std::span<const Point> points, const Fineness& fineness,
                   const echo::Sampling& sampling, double pulse_s) {
  Profile profile;
  profile.seabed_upa2.resize(static_cast<std::size_t>(sampling.count));
  profile.there.resize(profile.seabed_upa2.size());
  profile.sine = strip.sine;
  double sum = 0.0;
  int hits = 0;
  for (const Point& point : points) {
    if (!point.seabed.hit()) continue;
    sum += static_cast<double>(point.seabed.sine);
    ++hits;
  }
  if (hits > 0) profile.sine = sum / hits;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (adjoin(points[i].seabed, points[i + 1].seabed, fineness.seabed_s))
      add_between(strip, points[i], points[i + 1], sampling, pulse_s / sampling.period_s, profile);
  }
  return profile;
}

struct OfRow {
  std::vector<Run> runs;
  std::vector<std::uint8_t> depth_db;

  void add(std::uint32_t whose, std::int32_t row, std::int32_t sample, double db) {
    if (!runs.empty() && runs.back().whose == whose && runs.back().end == sample) {
      ++runs.back().end;
    } else {
      runs.push_back({whose, row, sample, sample + 1});
    }
    depth_db.push_back(static_cast<std::uint8_t>(std::lround(db)));
  }
};

/// What bodies block of a row, by body and sample.
class BlockedRow {
 public:
  explicit BlockedRow(std::size_t samples) : all_upa2(samples) {}

  void add(const Blocked& of, float power) {
    if (bodies_.empty() || bodies_[last_].body != of.body) find(of.body);
    const auto k = static_cast<std::size_t>(of.sample);
    bodies_[last_].level_upa2[k] += power * of.level_upa2;
    all_upa2[k] += power * of.level_upa2;
  }
  /// The body that blocks most of a sample, of those alike the lower number.
  std::uint32_t most_of(std::size_t k) const {
    const Body* most = nullptr;
    for (const Body& body : bodies_) {
      const float more = body.level_upa2[k] - (most != nullptr ? most->level_upa2[k] : 0.0F);
      if (more > 0.0F || (most != nullptr && more == 0.0F && body.body < most->body)) most = &body;
    }
    return most != nullptr ? most->body : trace::kNoise;
  }

  std::vector<float> all_upa2;

 private:
  struct Body {
    std::uint32_t body;
    std::vector<float> level_upa2;
  };
  void find(std::uint32_t body) {
    const auto there = std::ranges::find(bodies_, body, &Body::body);
    last_ = static_cast<std::size_t>(there - bodies_.begin());
    if (there == bodies_.end()) bodies_.push_back({body, std::vector<float>(all_upa2.size())});
  }

  std::vector<Body> bodies_;
  std::size_t last_ = 0;  // that was asked for
};

}  // namespace

Shadows find_shadows(std::span<const Strip> strips, std::span<const std::vector<Point>> points,
                     const Fineness& fineness, std::span<const Row> rows, const MainLobe& lobe,
                     const echo::Sampling& sampling, std::span<const float> background_upa2, std::span<const Run> own,
                     const ShadowRule& rule) {
  const auto count = static_cast<std::size_t>(sampling.count);
  std::vector<Profile> profiles(strips.size());
  tbb::parallel_for(std::size_t{0}, strips.size(), [&](std::size_t s) {
    profiles[s] = profile_of(strips[s], points[s], fineness, sampling, rule.pulse_s);
  });
  std::vector<std::vector<Run>> masks(rows.size());
  for (const Run& run : own) masks[static_cast<std::size_t>(run.row)].push_back(run);

  const double least = std::pow(10.0, 0.1 * rule.least_db), most = std::pow(10.0, 0.1 * rule.most_db);
  std::vector<OfRow> found(rows.size());
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t r) {
    std::vector<float> without(count), covered(count);
    BlockedRow blocked(count);
    float all = 0.0F;
    for (std::size_t s = 0; s < strips.size(); ++s) {
      if (strips[s].sector != rows[r].sector) continue;
      const Profile& profile = profiles[s];
      const float power = lobe.at(profile.sine - rows[r].axis);
      if (power <= 0.0F) continue;
      const float weight = power * static_cast<float>(strips[s].width);
      all += power * static_cast<float>(strips[s].counted);
      for (std::size_t k = 0; k < count; ++k) {
        without[k] += power * profile.seabed_upa2[k];
        covered[k] += profile.there[k] != 0 ? weight : 0.0F;
      }
      for (const Blocked& of : profile.blocked) blocked.add(of, power);
    }
    if (all <= 0.0F) return;
    std::vector<bool> masked(count);
    for (const Run& run : masks[r]) std::fill(masked.begin() + run.first, masked.begin() + run.end, true);

    const std::span<const float> background = background_upa2.subspan(r * count, count);
    const auto answers = [&](std::size_t k) { return covered[k] > kOwnShadow * all; };
    std::size_t last = count;
    while (last > 0 && !answers(last - 1)) --last;
    bool answered = false;  // the last that did, over the background
    for (std::size_t k = 0; k < last; ++k) {
      const auto row = static_cast<std::int32_t>(r), sample = static_cast<std::int32_t>(k);
      if (answers(k)) answered = without[k] > background[k];
      if (masked[k] || !answered) continue;
      if (!answers(k)) {
        found[r].add(trace::kNoise, row, sample, 0.0);
        continue;
      }
      const auto whole = static_cast<double>(without[k]), missing = static_cast<double>(blocked.all_upa2[k]);
      const double left = std::max(whole - missing, whole / most);
      if (missing <= 0.0 || whole < least * left) continue;
      found[r].add(blocked.most_of(k), row, sample, 10.0 * std::log10(whole / left));
    }
  });

  Shadows shadows;
  for (OfRow& of : found) {
    std::ranges::copy(of.runs, std::back_inserter(shadows.runs));
    std::ranges::copy(of.depth_db, std::back_inserter(shadows.depth_db));
  }
  return shadows;
}

}  // namespace ensonify::label
