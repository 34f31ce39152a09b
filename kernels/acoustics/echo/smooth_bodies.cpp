#include "kernels/acoustics/echo/smooth_bodies.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <vector>

#include "kernels/acoustics/echo/smooth_facet.h"

namespace ensonify::echo {
namespace {

using frames::Vec3;

constexpr std::size_t kFacetsPerTask = 64;

/// As SpeckleCells has a patch of the seabed, but in the middle of the facet and with a phase of its own.
Scatterer scatterer_of(const Insonification& batch, std::size_t ray, const trace::BodyTarget& target,
                       double wavenumber_radpm) {
  const trace::Hit hit = batch.hits[ray];
  const Vec3 towards_head = -hit.arrival_enu.cast<double>();
  const std::complex<double> amplitude_m =
      facet_amplitude_m(target.facet, towards_head, wavenumber_radpm, target.body->two_sided);
  const double cross_section_m2 = std::norm(amplitude_m);
  const Vec3 launch_enu = batch.pose.enu_from_head * batch.rays.direction_head[ray].cast<double>();
  const Vec3 straight_enu = (hit.position_enu_m - batch.pose.position_enu_m) / static_cast<double>(hit.range_m);
  Scatterer one;
  one.position_enu_m = target.place_enu_m;
  one.bend_enu = (launch_enu - straight_enu).cast<float>();
  one.slowness_spm = hit.travel_time_s / hit.range_m;
  one.stretch = hit.path_length_m / hit.range_m;
  one.spreading = hit.tube_m2 / (hit.range_m * hit.range_m);
  one.scattered_upa2m2 = batch.source_upa2m2[ray] / hit.tube_m2 * static_cast<float>(cross_section_m2);
  one.cross_section_m2 = static_cast<float>(cross_section_m2);
  if (cross_section_m2 > 0.0) one.response = std::complex<float>(amplitude_m / std::sqrt(cross_section_m2));
  one.contributor = hit.contributor;
  return one;
}

}  // namespace

void take_smooth_facets(const Insonification& batch, std::span<const trace::BodyTarget> to_bodies,
                        double wavenumber_radpm, trace::Hits& hits, Scatterers& found) {
  const std::size_t first = batch.rays.size() - to_bodies.size();
  std::vector<std::size_t> rays;
  for (std::size_t t = 0; t < to_bodies.size(); ++t) {
    if (to_bodies[t].body->smooth && batch.hits.hit(first + t)) rays.push_back(first + t);
  }
  const std::size_t row = found.size();
  found.resize(row + rays.size());
  if (rays.empty()) return;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, rays.size(), kFacetsPerTask),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
          found.set(row + i, scatterer_of(batch, rays[i], to_bodies[rays[i] - first], wavenumber_radpm));
      },
      tbb::simple_partitioner());
  for (const std::size_t ray : rays) hits.set(ray, trace::Hit{});
}

}  // namespace ensonify::echo
