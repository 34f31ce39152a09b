#include "kernels/acoustics/echo/body_echoes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/acoustics/echo/smooth_facet.h"

namespace ensonify::echo {
namespace {

using frames::Vec3;

constexpr std::size_t kFacetsPerTask = 64;

/// As SpeckleCells has a patch of the seabed, but in the middle of the piece; yet without energy and response.
Scatterer scatterer_of(const Insonification& batch, std::size_t ray, const trace::BodyTarget& target) {
  const trace::Hit hit = batch.hits[ray];
  const Vec3 launch_enu = batch.pose.enu_from_head * batch.rays.direction_head[ray].cast<double>();
  const Vec3 straight_enu = (hit.position_enu_m - batch.pose.position_enu_m) / static_cast<double>(hit.range_m);
  Scatterer one;
  one.position_enu_m = middle_of(target.facet);
  one.bend_enu = (launch_enu - straight_enu).cast<float>();
  one.slowness_spm = hit.travel_time_s / hit.range_m;
  one.stretch = hit.path_length_m / hit.range_m;
  one.spreading = hit.tube_m2 / (hit.range_m * hit.range_m);
  one.contributor = hit.contributor;
  return one;
}

Scatterer smooth_scatterer(const Insonification& batch, std::size_t ray, const trace::BodyTarget& target,
                           double wavenumber_radpm) {
  Scatterer one = scatterer_of(batch, ray, target);
  const Vec3 towards_head = -batch.hits.arrival_enu[ray].cast<double>();
  const std::complex<double> amplitude_m =
      facet_amplitude_m(target.facet, towards_head, wavenumber_radpm, target.body->two_sided);
  const double cross_section_m2 = std::norm(amplitude_m);
  one.scattered_upa2m2 = batch.source_upa2m2[ray] / batch.hits.tube_m2[ray] * static_cast<float>(cross_section_m2);
  one.cross_section_m2 = static_cast<float>(cross_section_m2);
  if (cross_section_m2 > 0.0) one.response = std::complex<float>(amplitude_m / std::sqrt(cross_section_m2));
  return one;
}

void add_rough(const Insonification& batch, std::size_t ray, const trace::BodyTarget& target,
               const random::Stream& stream, BodyScatterers& found) {
  const std::uint32_t contributor = batch.hits.contributor[ray];
  const float sigma_solid =
      batch.backscatter[ray] * batch.rays.solid_angle_sr[ray] / std::max(batch.hits.sin_grazing[ray], 1e-3F);
  if (found.rough.empty() || found.contributor != contributor || found.piece != target.piece) {
    Scatterer one = scatterer_of(batch, ray, target);
    const auto [re, im] = stream.normal_pair(contributor, target.piece);
    one.response = std::complex<float>(std::numbers::sqrt2 / 2.0 * std::complex<double>(re, im));
    found.rough.push_back(one);
    found.contributor = contributor, found.piece = target.piece;
  }
  found.rough.scattered_upa2m2.back() += batch.source_upa2m2[ray] * sigma_solid;
  found.rough.cross_section_m2.back() += batch.hits.tube_m2[ray] * sigma_solid;
}

}  // namespace

void BodyScatterers::clear() {
  smooth.clear();
  rough.clear();
}

void take_bodies(const Insonification& batch, std::span<const trace::BodyTarget> to_bodies, double wavenumber_radpm,
                 const random::Stream& stream, trace::Hits& hits, BodyScatterers& found) {
  const std::size_t first = batch.rays.size() - to_bodies.size();
  std::vector<std::size_t> smooth;
  for (std::size_t ray = first; ray < batch.rays.size(); ++ray) {
    if (!batch.hits.hit(ray)) continue;
    const trace::BodyTarget& target = to_bodies[ray - first];
    if (target.body->smooth) smooth.push_back(ray);
    else add_rough(batch, ray, target, stream, found);
  }
  const std::size_t row = found.smooth.size();
  found.smooth.resize(row + smooth.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, smooth.size(), kFacetsPerTask),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
          found.smooth.set(row + i, smooth_scatterer(batch, smooth[i], to_bodies[smooth[i] - first], wavenumber_radpm));
      },
      tbb::simple_partitioner());
  for (std::size_t ray = first; ray < batch.rays.size(); ++ray) hits.set(ray, trace::Hit{});
}

}  // namespace ensonify::echo
