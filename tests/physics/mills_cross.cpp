#include "tests/physics/mills_cross.h"

#include <array>
#include <cmath>
#include <vector>

#include "kernels/acoustics/array/line.h"
#include "kernels/acoustics/echo/line_receiver.h"
#include "kernels/acoustics/echo/testing/found.h"
#include "kernels/acoustics/trace/ray_distribution.h"
#include "kernels/seabed/table.h"
#include "tests/physics/area_integral.h"

namespace ensonify::physics {

double MillsCross::two_way_power(double forward, double starboard, double sin_beam) const {
  return array::line_power(length_in_waves(), forward) *
         elements_power(elements, spacing_in_waves, starboard, sin_beam);
}

echo::Image MillsCross::receive(const trace::Scene& seabed, const frames::HeadPose& head,
                                const seabed::Law& backscatter, std::span<const float> sin_beams) const {
  const double resolution_m = 0.5 * kSpeed_mps * pulse_length_s;
  trace::RayDistribution distribution(trace::mills_cross_volume(length_in_waves(), length_in_waves(), half_swath_rad),
                                      {.quality = quality, .range_resolution_m = resolution_m}, {1, "rays"});
  const auto reach_m = static_cast<float>(range_m);
  const trace::Mesh mesh = seabed.adapted();
  const auto trace = [&](const trace::Rays& rays, trace::Hits& hits) {
    mesh.trace(head, rays, reach_m, hits, kSpeed_mps);
  };
  trace::RayDistribution::Plan plan;
  trace::RayDistribution::Batch all;
  distribution.aim(head, {}, mesh.objects(), reach_m, nullptr, trace, plan);
  distribution.trace(plan, 0, plan.rays(), trace, all);
  const trace::Rays& rays = all.rays;
  const trace::Hits& hits = all.hits;

  const seabed::BackscatterTable table(backscatter);
  std::vector<float> source, cross_section;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double pattern = array::line_power(length_in_waves(), rays[i].direction_head.x());
    source.push_back(static_cast<float>(std::pow(10.0, 0.1 * source_level_db) * pattern));
    cross_section.push_back(hits[i].hit() ? table(hits[i].sin_grazing) : 0.0F);
  }
  echo::SpeckleCells cells(0.5 * resolution_m, {1, "seabed"});
  echo::Receivers receivers;
  receivers.set({0.0, 1.0, std::span(&head, 1)});
  echo::Arrivals arrivals;
  echo::add_direct_echoes({300e3, absorption_dbpm, echo::Sum::kMeanSquare}, head.position_enu_m,
                          echo::scatterers_of(cells, {head, rays, hits, source, cross_section}), receivers, arrivals);

  const echo::ElementLine line{elements, spacing_in_waves};
  const std::vector<echo::WantedImage> wanted{echo::WantedImage(
      echo::beam_weights(std::vector<double>(static_cast<std::size_t>(elements), 1.0)), echo::Sum::kMeanSquare)};
  const echo::SampledPulse pulse(echo::rectangular_pulse(pulse_length_s), sample_period_s), squared = pulse.squared();
  const int samples = static_cast<int>((2.0 * range_m / kSpeed_mps + pulse_length_s) / sample_period_s) + 1;
  std::vector<echo::Image> images(1);
  echo::LineReceiver::Memory memory;
  echo::LineReceiver(line, true)
      .form({std::array{echo::EchoSet{arrivals}}, pulse, {0.0, sample_period_s, samples}, {}, &squared}, sin_beams,
            wanted, images, memory);
  for (auto& value : images[0].envelope_upa) value = std::norm(value);
  return images[0];
}

trace::Scene scene_of(double side_m, double spacing_m, const std::function<double(double, double)>& height_m) {
  trace::Scene scene({0.0, 0.0});
  scene.insert({0, 0}, terrain::sample_tile({.origin_enu_m = {-0.5 * side_m, -0.5 * side_m},
                                             .spacing_m = spacing_m,
                                             .cells = static_cast<std::int32_t>(std::lround(side_m / spacing_m))},
                                            {0, 0}, height_m));
  return scene;
}

}  // namespace ensonify::physics
