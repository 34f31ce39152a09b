#include "kernels/acoustics/trace/ray_distribution.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace ensonify::trace {
namespace {

using frames::Vec3;

constexpr std::size_t kProbeCells = 1024;  // at least, over the whole volume
constexpr int kFewestMainCells = 2;        // of a span
constexpr std::size_t kCellsPerTask = 16;  // fixed, so the number of threads changes nothing
constexpr double kWidest = 0.5;            // of a cell, in either coordinate: fill_cell() needs it below 0.6 rad

constexpr double kRaysPerFacet = 10.0;  // at normal quality

// Of planes that rays aim at. Where a plane is as far from the seabed as a quarter of the head's height above it,
// places wander on the seabed by a quarter of what the head moves.
constexpr double kPlaneStep_m = 0.25,
                 kPlaneShift = 0.3819660113;  // a seabed at a round depth is not between two planes
// Strata of a part: fewer rays sample a peaked law better if they are strata.
constexpr auto kFewestToPlaces = static_cast<std::size_t>(RaySettings::kToPlaces);

constexpr double kSpare = 1.01;          // of the fewest rays
constexpr double kMostKept = 524'288.0;  // rays of a plan, 8 MB

void check(const Span& span, double lowest, double highest, const char* fault) {
  const bool rises = lowest <= span.low && span.low <= span.main_low && span.main_low < span.main_high &&
                     span.main_high <= span.high && span.high <= highest;
  if (!(rises && span.beam > 0.0)) throw std::invalid_argument(fault);
}

/// Equal cells in the main lobe; beyond, from a quarter of the lobe on, each twice as wide as the one before.
std::vector<double> edges_of(const Span& span, double widest_main) {
  const double main = span.main_high - span.main_low;
  const int main_cells = std::max(kFewestMainCells, static_cast<int>(std::ceil(main / std::min(widest_main, kWidest))));
  std::vector<double> edges;
  double width = std::min(0.25 * main, kWidest);
  for (double at = span.main_low; at > span.low; width = std::min(2.0 * width, kWidest)) {
    edges.insert(edges.begin(), at = std::max(at - width, span.low));
  }
  for (int i = 0; i < main_cells; ++i) edges.push_back(span.main_low + i * main / main_cells);
  edges.push_back(span.main_high);
  width = std::min(0.25 * main, kWidest);
  for (double at = span.main_high; at < span.high; width = std::min(2.0 * width, kWidest)) {
    edges.push_back(at = std::min(at + width, span.high));
  }
  return edges;
}

/// Full density in the main lobe; beyond, 1 / distance^2 from its middle, as side lobes fall, at the far edge.
double importance(const Span& span, double low, double high) {
  const double middle = 0.5 * (span.main_low + span.main_high), half = 0.5 * (span.main_high - span.main_low);
  const double far = std::max(std::abs(low - middle), std::abs(high - middle));
  return std::min(1.0, (half / far) * (half / far) * (1.0 + 1e-9));  // rounding of the main lobe's own edge
}

/// How far below the head the plane of the world lies that is next to a height; 0 where it is no stand-in for it.
double plane_below(double head_z_m, double seen_z_m) {
  const double steps = std::round(seen_z_m / kPlaneStep_m - kPlaneShift);
  const double below_m = head_z_m - seen_z_m, plane_m = head_z_m - kPlaneStep_m * (steps + kPlaneShift);
  return 0.5 * below_m < plane_m && plane_m < 2.0 * below_m ? plane_m : 0.0;
}

Eigen::Vector3f direction_of(TransmitVolume::Axis axis, float along, float side, float zero) {
  return axis == TransmitVolume::Axis::kForward ? Eigen::Vector3f(along, side, zero)
                                                : Eigen::Vector3f(zero, side, along);
}

/// `count` rays from `first` on, their solid angles scaled, into rows `to_first` on.
void copy(const Rays& from, std::size_t first, std::size_t count, float scale, Rays& to, std::size_t to_first) {
  const auto column = [&](const std::vector<float>& a, std::vector<float>& b) {
    std::copy_n(a.data() + first, count, b.data() + to_first);
  };
  column(from.direction_head.x, to.direction_head.x);
  column(from.direction_head.y, to.direction_head.y);
  column(from.direction_head.z, to.direction_head.z);
  for (std::size_t i = 0; i < count; ++i) to.solid_angle_sr[to_first + i] = scale * from.solid_angle_sr[first + i];
}

/// What each part makes is its own, however many of them are a task.
template <class Work>
void for_parts(std::size_t first, std::size_t end, const Work& work, std::size_t per_task = kCellsPerTask) {
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(first, end, per_task),
      [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) work(k);
      },
      tbb::simple_partitioner());
}

}  // namespace

TransmitVolume mills_cross_volume(double transmit_length_in_waves, double receive_length_in_waves,
                                  double half_swath_rad, double reach) {
  constexpr double kWidth = 0.886;  // -3 dB width of a uniform line, in lambda / L [Lurton2010]
  const double null = std::min(1.0, 1.0 / transmit_length_in_waves);
  const double end = std::min(1.0, std::max(reach, 1.0) / transmit_length_in_waves);
  return {TransmitVolume::Axis::kForward,
          {-end, end, -null, null, kWidth / transmit_length_in_waves},
          {-half_swath_rad, half_swath_rad, -half_swath_rad, half_swath_rad, kWidth / receive_length_in_waves}};
}

RayDistribution::RayDistribution(const TransmitVolume& volume, const RaySettings& settings,
                                 const random::Stream& stream)
    : volume_(volume), settings_(settings), stream_(stream) {
  check(volume.sine, -1.0, 1.0, "the sines of a transmit volume must rise within -1..1, and its beams be wider than 0");
  check(volume.angle_rad, -2.0 * std::numbers::pi, 2.0 * std::numbers::pi,
        "the angles of a transmit volume must rise, and its beams be wider than 0");
  if (volume.angle_rad.high - volume.angle_rad.low > 2.0 * std::numbers::pi + 1e-9) {
    throw std::invalid_argument("the angles of a transmit volume must span at most a full circle");
  }
  if (!(settings.range_resolution_m > 0.0)) throw std::invalid_argument("the range resolution must be above 0 m");
  if (!(settings.quality > 0.0)) throw std::invalid_argument("the quality of rays must be above 0");

  const double sine_width = volume.sine.main_high - volume.sine.main_low;
  const double angle_width = volume.angle_rad.main_high - volume.angle_rad.main_low;
  std::size_t cells = 0;
  for (double step = std::max(sine_width, angle_width); cells < kProbeCells; step *= 0.98) {
    sine_edges_ = edges_of(volume.sine, step);
    angle_edges_rad_ = edges_of(volume.angle_rad, step);
    cells = (sine_edges_.size() - 1) * (angle_edges_rad_.size() - 1);
  }
  if (settings.most_rays < 4 * cells) {
    throw std::invalid_argument("the limit of rays must be at least " + std::to_string(4 * cells));
  }
  if (2.0 * settings.quality * static_cast<double>(settings.fewest_rays) > static_cast<double>(settings.most_rays)) {
    throw std::invalid_argument("the fewest rays times the quality must be at most half of the most");
  }
}

TransmitVolume RayDistribution::volume(const Steer& steer) const {
  TransmitVolume steered = volume_;
  for (double* u : {&steered.sine.low, &steered.sine.high, &steered.sine.main_low, &steered.sine.main_high}) {
    *u = std::clamp(*u + steer.sine, -1.0, 1.0);
  }
  for (double* phi :
       {&steered.angle_rad.low, &steered.angle_rad.high, &steered.angle_rad.main_low, &steered.angle_rad.main_high}) {
    *phi += steer.angle_rad;
  }
  return steered;
}

void RayDistribution::probe(const Steer& steer, Probes& probes) const {
  probes.sine_edges = sine_edges_;
  probes.angle_edges_rad = angle_edges_rad_;
  for (double& u : probes.sine_edges) u = std::clamp(u + steer.sine, -1.0, 1.0);
  for (double& phi : probes.angle_edges_rad) phi += steer.angle_rad;
  probes.rays.resize(sine_edges_.size() * angle_edges_rad_.size());
  std::size_t next = 0;
  for (const double u : probes.sine_edges) {
    const double beside = std::sqrt(1.0 - u * u);
    for (const double phi : probes.angle_edges_rad) {
      probes.rays.set(next++,
                      {direction_of(volume_.axis, static_cast<float>(u), static_cast<float>(beside * std::sin(phi)),
                                    static_cast<float>(beside * std::cos(phi))),
                       0.0F});
    }
  }
}

/// What the corners of a cell see: places from the head, and ranges along the path.
struct RayDistribution::Corners {
  std::array<Vec3, 4> place_m;  // (low u, low phi), (high u, low phi), (low u, high phi), (high u, high phi)
  std::array<double, 4> range_m;
  double facet_m;       // of the farthest
  double finer_per_sr;  // facets that face the head, where they are smaller than those: mean over the corners
  double plane_m;       // of Need
};

bool RayDistribution::find_corners(std::size_t i, std::size_t j, const View& view, Corners& corners) const {
  const std::array<std::size_t, 4> at{corner(i, j), corner(i + 1, j), corner(i, j + 1), corner(i + 1, j + 1)};
  const Hits& hits = view.hits;
  Hit farthest;
  double sum_of_z_m = 0.0, count = 0.0;
  for (const std::size_t k : at) {
    if (!hits.hit(k)) continue;
    sum_of_z_m += hits.position_enu_m.z[k], count += 1.0;
    if (!farthest.hit() || hits.path_length_m[k] > farthest.path_length_m) farthest = hits[k];
  }
  if (!farthest.hit()) return false;
  corners.facet_m = farthest.facet_m;
  corners.finer_per_sr = 0.0;
  const Vec3 normal = farthest.normal_enu.cast<double>();
  const double off_m = normal.dot(farthest.position_enu_m - view.head.position_enu_m);
  for (std::size_t c = 0; c < 4; ++c) {
    const std::size_t k = at[c];
    if (hits.hit(k)) {
      corners.place_m[c] = hits.position_enu_m[k] - view.head.position_enu_m;
      corners.range_m[c] = hits.path_length_m[k];
      if (hits.facet_m[k] < farthest.facet_m) {
        corners.finer_per_sr += 0.25 * facing_facets_per_sr(hits.path_length_m[k], hits.facet_m[k]);
      }
    } else {
      const Vec3 direction = view.enu_from_head * view.probes.rays.direction_head[k].cast<double>();
      const double to_plane_m = off_m / normal.dot(direction);
      corners.range_m[c] = to_plane_m > 0.0 ? std::min(to_plane_m, view.max_range_m) : view.max_range_m;
      corners.place_m[c] = corners.range_m[c] * direction;
    }
  }
  corners.plane_m = plane_below(view.head.position_enu_m.z(), sum_of_z_m / count);
  return true;
}

RayDistribution::Need RayDistribution::need(std::size_t i, std::size_t j, const View& view) const {
  Corners seen;
  const auto &sines = view.probes.sine_edges, &angles_rad = view.probes.angle_edges_rad;
  const double du = sines[i + 1] - sines[i], dphi = angles_rad[j + 1] - angles_rad[j];
  if (!(du > 0.0) || !find_corners(i, j, view, seen)) return {};

  // In units of what is resolved: beams, and ranges within a beam.
  const auto& r = seen.range_m;
  const double along_u = std::max(std::abs(r[1] - r[0]), std::abs(r[3] - r[2])) / settings_.range_resolution_m;
  const double along_phi = std::max(std::abs(r[2] - r[0]), std::abs(r[3] - r[1])) / settings_.range_resolution_m;
  const double beams_u = du / volume_.sine.beam, beams_phi = dphi / volume_.angle_rad.beam;
  const double ranges_in_beam = along_u / beams_u + along_phi / beams_phi;
  const Need resolution{settings_.quality * kRaysPerCell * beams_u * beams_phi * std::max(1.0, ranges_in_beam),
                        (beams_u + along_u) / (beams_phi + along_phi)};

  // In units of facets: two triangles to a square of the posts' spacing.
  const auto& p = seen.place_m;
  const double area_m2 = 0.5 * (p[3] - p[0]).cross(p[2] - p[1]).norm();
  const double wide_u_m = (p[1] - p[0]).norm() + (p[3] - p[2]).norm();
  const double wide_phi_m = (p[2] - p[0]).norm() + (p[3] - p[1]).norm();
  const double coarse = 2.0 * area_m2 / (seen.facet_m * seen.facet_m), fine = seen.finer_per_sr * du * dphi;
  const Need facets{settings_.quality * kRaysPerFacet * std::max(coarse, fine), wide_u_m / wide_phi_m};

  Need both = facets.rays > resolution.rays ? facets : resolution;
  both.rays = std::max(both.rays, settings_.fewest_in_main_cell) * importance_of(i * columns() + j);
  both.rays = std::min(both.rays, static_cast<double>(settings_.most_rays));
  both.plane_m = seen.plane_m;
  return both;
}

double RayDistribution::importance_of(std::size_t cell) const {
  const std::size_t i = cell / columns(), j = cell % columns();
  return importance(volume_.sine, sine_edges_[i], sine_edges_[i + 1]) *
         importance(volume_.angle_rad, angle_edges_rad_[j], angle_edges_rad_[j + 1]);
}

/// Cuts the parts into strata, for this share of what they need; the number of rays.
std::size_t RayDistribution::cut(double share, std::span<Part> parts) {
  std::size_t rays = 0;
  for (Part& part : parts) {
    const double wanted = std::max(1.0, share * part.need.rays);
    const double along_u = std::clamp(std::ceil(std::sqrt(wanted * part.need.sine_to_angle)), 1.0, std::ceil(wanted));
    part.along_sine = static_cast<std::uint32_t>(along_u);
    part.along_angle = static_cast<std::uint32_t>(std::ceil(wanted / along_u));
    rays += std::size_t{part.along_sine} * part.along_angle;
  }
  return rays;
}

void RayDistribution::aim_beyond_probes(const Targets& targets, float max_range_m,
                                        const refraction::PathTable* refracted, Plan& plan) const {
  const frames::HeadPose& head = plan.head_;
  const Probes& probes = plan.probes_;
  const Hits& probe_hits = plan.probe_hits_;
  if (probe_hits.size() != probes.rays.size()) throw std::invalid_argument("there must be one hit per probe");
  const View view{{head, head.enu_from_head.toRotationMatrix()}, probes, probe_hits, max_range_m};
  std::vector<Part>& parts = plan.parts_;
  const auto &sines = probes.sine_edges, &angles_rad = probes.angle_edges_rad;
  parts.resize((sines.size() - 1) * columns());
  plan.kept_.resize(parts.size());
  for_parts(0, parts.size(), [&](std::size_t k) {
    const std::size_t i = k / columns(), j = k % columns();
    parts[k] = {sines[i], sines[i + 1], angles_rad[j], angles_rad[j + 1], need(i, j, view)};
  });
  aim_at_facets(probes, targets.objects, {head, max_range_m, refracted}, plan.facets_, plan.to_facets_);
  const std::size_t to_facets = plan.facets_.rays.size();
  aim_at_bodies(probes, targets, {head, max_range_m, refracted}, plan.facets_, plan.to_facets_);

  const bool any = std::ranges::any_of(probe_hits.range_m, [](float range_m) { return range_m > 0.0F; });
  // Those to facets come whole: half of all is left to the others, however many they are. Those to bodies come besides,
  // so that none of the others depends on what stands there.
  const auto most = static_cast<double>(std::max(settings_.most_rays, 2 * to_facets) - to_facets);
  const double fewest = any ? settings_.quality * static_cast<double>(settings_.fewest_rays) : 0.0;
  double share = 1.0;
  const auto draw = [&] {  // what falls within the cells varies by a per cent
    auto count = static_cast<double>(cut(share, parts));
    for (; count > most; count = static_cast<double>(cut(share, parts))) share *= 0.999 * most / count;
    for (; count < kSpare * fewest; count = static_cast<double>(cut(share, parts)))
      share *= 1.001 * kSpare * fewest / count;
    plan.keeps_ = count <= kMostKept;
    for_parts(0, parts.size(),
              [&](std::size_t k) { count_part(view, parts[k], plan.keeps_ ? &plan.kept_[k] : nullptr); });
    plan.spread_ = 0;
    for (Part& part : parts) part.first_ray = std::exchange(plan.spread_, plan.spread_ + part.rays);
    return static_cast<double>(plan.spread_);
  };
  for (double count = draw(); count > most || count < fewest; count = draw()) {
    share *= count > most ? 0.99 * most / count : 1.01 * fewest / count;
  }
  plan.share_ = share;
  // As the lattices' edges leave a little more or less.
  double places_sr = 0.0, parts_sr = 0.0;
  for (const Part& part : parts) {
    places_sr += part.to_places_sr;
    if (part.to_places_sr > 0.0) parts_sr += part.solid_angle_sr();
  }
  plan.places_scale_ = static_cast<float>(parts_sr / places_sr);
}

void RayDistribution::count_part(const Place& head, Part& part, Aimed* kept) const {
  const bool to_places = part.need.plane_m > 0.0 && part.strata() >= kFewestToPlaces;
  if (kept != nullptr) kept->count = 0;
  ToPlaces found;
  if (to_places) aim_at_places(part, head, kept, &found);
  part.to_places_sr = found.solid_angle_sr;
  part.rays = found.rays > 0 ? found.rays : part.strata();
}

void RayDistribution::fill(const Plan& plan, std::size_t first, std::size_t count, Batch& batch) const {
  const std::vector<Part>& parts = plan.parts_;
  const std::size_t end = std::min(plan.rays(), first + std::min(count, plan.rays())),
                    spread_end = std::min(end, plan.spread_);
  batch.first_ = first;
  batch.rays.make_elements(end - std::min(first, end));
  const auto after = [&](std::size_t ray) {  // the part that holds a ray
    return static_cast<std::size_t>(std::ranges::upper_bound(parts, ray, {}, &Part::first_ray) - parts.begin());
  };
  if (first < spread_end) {
    const std::size_t low = after(first) - 1, high = after(spread_end - 1);
    if (batch.parts_.size() < high - low) batch.parts_.resize(high - low);
    const Place head{plan.head_, plan.head_.enu_from_head.toRotationMatrix()};
    for_parts(
        low, high,
        [&](std::size_t k) {
          const Part& part = parts[k];
          const bool kept = plan.keeps_ && part.to_places_sr > 0.0;
          const Aimed& aimed = kept ? plan.kept_[k] : batch.parts_[k - low];
          if (!kept) fill_part(plan, k, head, batch.parts_[k - low]);
          const std::size_t from = std::max(first, part.first_ray),
                            to = std::min(spread_end, part.first_ray + part.rays);
          copy(aimed.rays, from - part.first_ray, to - from, part.to_places_sr > 0.0 ? plan.places_scale_ : 1.0F,
               batch.rays, from - first);
        },
        1);  // a batch has few parts where they have many rays
  }
  for (std::size_t i = std::max(first, plan.spread_); i < end; ++i)
    batch.rays.set(i - first, plan.facets_.rays[i - plan.spread_]);
}

void RayDistribution::fill_part(const Plan& plan, std::size_t index, const Place& head, Aimed& aimed) const {
  const Part& part = plan.parts_[index];
  aimed.count = 0;
  if (part.to_places_sr > 0.0) {
    aim_at_places(part, head, &aimed, nullptr);
  } else {
    fill_strata(part, index, aimed);
  }
}

void RayDistribution::fill_strata(const Part& part, std::size_t index, Aimed& aimed) const {
  const double half_u = 0.5 * (part.high_sine - part.low_sine), middle_u = part.low_sine + half_u;
  const double half_rad = 0.5 * (part.high_rad - part.low_rad), middle_rad = part.low_rad + half_rad;
  const double du = 2.0 * half_u / part.along_sine, dphi = 2.0 * half_rad / part.along_angle;
  const auto sine = static_cast<float>(std::sin(middle_rad)), cosine = static_cast<float>(std::cos(middle_rad));
  const auto u0 = static_cast<float>(middle_u), u_step = static_cast<float>(du), u_first = static_cast<float>(-half_u);
  const auto e_step = static_cast<float>(dphi), e_first = static_cast<float>(-half_rad);
  const auto solid_angle = static_cast<float>(du * dphi);
  const std::size_t count = aimed.count = part.strata();
  if (aimed.rays.size() < count) aimed.rays.make_elements(count);

  constexpr std::size_t kRun = random::Stream::Run::kSize;
  random::Stream::Run bits;
  std::array<float, kRun> a{}, c{};  // stratum along u and phi
  std::array<float, kRun> along, side, zero;
  std::uint32_t next_a = 0, next_c = 0;
  const auto uniform = [](std::uint32_t word) { return 0x1p-24F * static_cast<float>(static_cast<int>(word >> 8)); };
  for (std::size_t first = 0; first < count; first += kRun) {
    const std::size_t lanes = std::min(kRun, count - first);
    stream_.run(index, first, bits);
    for (std::size_t k = 0; k < lanes; ++k) {
      a[k] = static_cast<float>(static_cast<int>(next_a));
      c[k] = static_cast<float>(static_cast<int>(next_c));
      if (++next_a == part.along_sine) next_a = 0, ++next_c;
    }
    for (std::size_t k = 0; k < kRun; ++k) {
      const float u = u0 + (u_first + u_step * (a[k] + uniform(bits.word[0][k])));
      const float e = e_first + e_step * (c[k] + uniform(bits.word[1][k]));
      const float e2 = e * e;  // |e| < 0.3 rad: the series end below 1e-7
      const float sin_e = e * (1.0F - e2 * (1.0F / 6.0F - e2 * (1.0F / 120.0F)));
      const float cos_e = 1.0F - e2 * (0.5F - e2 * (1.0F / 24.0F - e2 * (1.0F / 720.0F)));
      const float inside = 1.0F - u * u;
      const float beside = std::sqrt(inside > 0.0F ? inside : 0.0F);
      along[k] = u;
      side[k] = beside * (sine * cos_e + cosine * sin_e);
      zero[k] = beside * (cosine * cos_e - sine * sin_e);
    }
    for (std::size_t k = 0; k < lanes; ++k) {
      aimed.rays.set(first + k, {direction_of(volume_.axis, along[k], side[k], zero[k]), solid_angle});
    }
  }
}

}  // namespace ensonify::trace
