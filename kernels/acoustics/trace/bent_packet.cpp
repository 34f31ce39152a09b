#include "kernels/acoustics/trace/bent_packet.h"

#include <algorithm>
#include <cmath>

#include "kernels/base/isa/wide.h"
#include "kernels/water/refraction/path.h"

namespace ensonify::trace {
namespace {

/// Of two unit vectors that differ by little (kOffArc_m): 1 over the length of their sum, to all digits.
double mean_scale(double d_sine, double d_cosine) {
  const double e = d_sine * d_sine + d_cosine * d_cosine;  // 1 / sqrt(4 - e)
  return 0.5 + e * (1.0 / 16 + e * (3.0 / 256 + e * (5.0 / 2048)));
}

/// An arc from the top of a layer, by its chord (Path::end_of). Its turn is small (kOffArc_m), so that series have all
/// digits.
struct Arc {
  double length_m, time_s, reach_m2ps;
  Arc(double chord_m, double scale, double curvature_pm, double gradient_per_s, double top_mps, double end_mps)
      : reach_m2ps(chord_m * scale * (top_mps + end_mps)) {
    const double v = 0.5 * curvature_pm * chord_m, v2 = v * v;
    length_m = chord_m * (1.0 + v2 * (1.0 / 6 + v2 * (3.0 / 40)));
    const double mean = 1.0 / (top_mps + end_mps), part = mean * (end_mps - top_mps), e = part * part;
    const double slowness = 2.0 * mean * (1.0 + e * (0.5 + 0.375 * e));
    const double w = 0.5 * gradient_per_s * chord_m * slowness, w2 = w * w;
    time_s = chord_m * slowness * (1.0 - w2 * (1.0 / 6 - w2 * (3.0 / 40)));
  }
};

}  // namespace

Layers::Layers(const refraction::PathTable& paths, const Band& band) {
  if (!(paths.level_m() <= band.top_m)) return;
  const refraction::SoundSpeedProfile& profile = paths.profile();
  for (double top = paths.level_m(); top < band.bottom_m;) {
    const std::size_t layer = profile.layer_at(top);
    const double bottom = std::min(band.bottom_m, profile.layer_bottom_m(layer));
    const double gradient = profile.layer_gradient_per_s(layer);
    if (!layers_.empty()) layers_.back().jump_per_s = gradient - layers_.back().gradient_per_s;
    layers_.push_back({bottom - top, gradient, profile.speed_in_layer_mps(layer, top),
                       profile.speed_in_layer_mps(layer, bottom), 0.0, top});
    top = bottom;
  }
}

ENSONIFY_WIDE bool BentPacket::aim(const Source& source, const Rays& rays, std::size_t first, std::size_t count) {
  first_ = first;
  layer_ = 0;
  const Eigen::Matrix3d& R = source.enu_from_head;
  alignas(64) std::array<float, kPacket> x, y, z;
  for (std::size_t lane = 0; lane < kPacket; ++lane) {  // lanes that are not used go as the first does
    const std::size_t ray = first + (lane < count ? lane : 0);
    on_[lane] = lane < count ? -1 : 0;
    x[lane] = rays.direction_head.x[ray];
    y[lane] = rays.direction_head.y[ray];
    z[lane] = rays.direction_head.z[ray];
  }
  alignas(64) Column sine, cosine;
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    const auto a = static_cast<double>(x[lane]), b = static_cast<double>(y[lane]), c = static_cast<double>(z[lane]);
    const double east = R(0, 0) * a + (R(0, 1) * b + R(0, 2) * c), north = R(1, 0) * a + (R(1, 1) * b + R(1, 2) * c);
    sine[lane] = -(R(2, 0) * a + (R(2, 1) * b + R(2, 2) * c));
    cosine[lane] = std::sqrt(east * east + north * north);
    slowness_east_[lane] = source.slowness_spm * east;
    slowness_north_[lane] = source.slowness_spm * north;
  }
  return source.paths.paths(sine, cosine, at_);
}

ENSONIFY_WIDE bool BentPacket::cross(const Source& source, Packet& packet) {
  const Layers::Layer layer = source.layers[layer_];
  double least_squared = 1.0, most_sagitta = 0.0, least_left_m = source.max_length_m;
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    const double bend = at_.invariant_spm[lane] * layer.gradient_per_s, rise = bend * layer.height_m;
    const double squared = at_.sine[lane] * at_.sine[lane] - rise * (2.0 * at_.cosine[lane] + rise);
    const double end_sine = std::sqrt(squared > 0.0 ? squared : 0.0);
    const double end_cosine = at_.invariant_spm[lane] * layer.bottom_mps;
    const double scale = mean_scale(at_.sine[lane] - end_sine, at_.cosine[lane] - end_cosine);
    const double chord_sine = scale * (at_.sine[lane] + end_sine), chord_m = layer.height_m / chord_sine;
    const double speed = scale * (layer.top_mps + layer.bottom_mps);
    chord_east_[lane] = speed * slowness_east_[lane];
    chord_north_[lane] = speed * slowness_north_[lane];
    chord_up_[lane] = -chord_sine;
    length_m_[lane] = chord_m;
    end_sine_[lane] = end_sine;
    const double sagitta = chord_m * chord_m * std::abs(bend);
    const double left_m = source.max_length_m - at_.length_m[lane] - chord_m;
    least_squared = squared < least_squared ? squared : least_squared;
    most_sagitta = sagitta > most_sagitta ? sagitta : most_sagitta;
    least_left_m = left_m < least_left_m ? left_m : least_left_m;
  }
  if (!(least_squared > 0.0) || !(most_sagitta <= 8.0 * kOffArc_m) || !(least_left_m > kOverlap_m)) return false;

  RTCRay16& ray = packet.rays.ray;
  const auto up_m = static_cast<float>(source.start_m.z() + source.paths.source_depth_m() - layer.top_depth_m);
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    packet.on[lane] = on_[lane];
    packet.part_hit[lane] = nullptr;
    ray.org_x[lane] = static_cast<float>(source.start_m.x() + at_.reach_m2ps[lane] * slowness_east_[lane]);
    ray.org_y[lane] = static_cast<float>(source.start_m.y() + at_.reach_m2ps[lane] * slowness_north_[lane]);
    ray.org_z[lane] = up_m;
    ray.dir_x[lane] = static_cast<float>(chord_east_[lane]);
    ray.dir_y[lane] = static_cast<float>(chord_north_[lane]);
    ray.dir_z[lane] = static_cast<float>(chord_up_[lane]);
    ray.tnear[lane] = ray.time[lane] = 0.0F;
    ray.tfar[lane] = on_[lane] != 0 ? static_cast<float>(length_m_[lane] + kOverlap_m) : 0.0F;
    ray.mask[lane] = ~0U;
    ray.id[lane] = ray.flags[lane] = 0;
    packet.rays.hit.Ng_x[lane] = packet.rays.hit.Ng_y[lane] = packet.rays.hit.Ng_z[lane] = 0.0F;
    packet.rays.hit.geomID[lane] = packet.rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
  return true;
}

ENSONIFY_WIDE void BentPacket::note(const Source& source, const Packet& packet, Hits& hits) const {
  std::size_t hit = 0;
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    hit += packet.part_hit[lane] != nullptr ? 1U : 0U;
    if (on_[lane] != 0 && packet.part_hit[lane] == nullptr && layer_ == 0) hits.set(first_ + lane, Hit{});
  }
  if (hit == 0) return;
  const Layers::Layer layer = source.layers[layer_];
  const RTCRay16& ray = packet.rays.ray;
  const RTCHit16& facet = packet.rays.hit;
  const double top_m = source.paths.source_depth_m() - layer.top_depth_m;
  alignas(64) Column x_m, y_m, z_m;
  alignas(64) std::array<float, kPacket> range_m, time_s, length_m, tube_m2, grazing, nx, ny, nz, ax, ay, az;
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    const auto along_m = static_cast<double>(ray.tfar[lane]);
    const double east_m = at_.reach_m2ps[lane] * slowness_east_[lane] + along_m * chord_east_[lane];
    const double north_m = at_.reach_m2ps[lane] * slowness_north_[lane] + along_m * chord_north_[lane];
    const double up_m = top_m + along_m * chord_up_[lane];
    x_m[lane] = source.head_enu_m.x() + east_m;
    y_m[lane] = source.head_enu_m.y() + north_m;
    z_m[lane] = source.head_enu_m.z() + up_m;
    range_m[lane] = std::sqrt(static_cast<float>(east_m * east_m + north_m * north_m + up_m * up_m));

    const double curvature = at_.invariant_spm[lane] * layer.gradient_per_s, turn = curvature * along_m,
                 t2 = turn * turn;
    const double c = 1.0 - t2 * (0.5 - t2 * (1.0 / 24)), s = turn * (1.0 - t2 * (1.0 / 6 - t2 * (1.0 / 120)));
    const double end_sine = at_.sine[lane] * c - at_.cosine[lane] * s;
    const double end_cosine = at_.cosine[lane] * c + at_.sine[lane] * s;
    const double scale = mean_scale(at_.sine[lane] - end_sine, at_.cosine[lane] - end_cosine);
    const double chord_m = along_m * (1.0 - t2 * (1.0 / 24));
    const double end_mps = layer.top_mps + layer.gradient_per_s * chord_m * scale * (at_.sine[lane] + end_sine);
    const Arc arc(chord_m, scale, curvature, layer.gradient_per_s, layer.top_mps, end_mps);
    const double whole_m = at_.length_m[lane] + arc.length_m;
    const double width_m = at_.width_m[lane] + at_.width_slowness[lane] * arc.reach_m2ps;
    const double area = (at_.reach_m2ps[lane] + arc.reach_m2ps) * source.slowness_spm * std::abs(width_m);
    const double least = refraction::Path::kTubeFloor * whole_m * whole_m;
    time_s[lane] = static_cast<float>(at_.time_s[lane] + arc.time_s);
    length_m[lane] = static_cast<float>(whole_m);
    tube_m2[lane] = static_cast<float>(area > least ? area : least);

    // Of what is a float anyway, in floats: roots and divisions of doubles take most of the time here.
    const auto arrival_east = static_cast<float>(end_mps * slowness_east_[lane]),
               arrival_north = static_cast<float>(end_mps * slowness_north_[lane]);
    const auto arrival_up = static_cast<float>(-end_sine);
    const float x = facet.Ng_x[lane], y = facet.Ng_y[lane], z = facet.Ng_z[lane];
    const float per_length = 1.0F / std::sqrt(x * x + y * y + z * z);
    const float with_ray = x * ray.dir_x[lane] + y * ray.dir_y[lane] + z * ray.dir_z[lane];
    const float towards = with_ray > 0.0F ? -per_length : per_length;
    const float sine = std::abs(x * arrival_east + y * arrival_north + z * arrival_up) * per_length;
    nx[lane] = towards * x;
    ny[lane] = towards * y;
    nz[lane] = towards * z;
    ax[lane] = arrival_east;
    ay[lane] = arrival_north;
    az[lane] = arrival_up;
    grazing[lane] = sine < 1.0F ? sine : 1.0F;
  }
  const auto put = [&](const auto& from, auto& column) {
    if (hit == kPacket) {
      std::copy_n(from.data(), kPacket, column.data() + first_);
      return;
    }
    for (std::size_t lane = 0; lane < kPacket; ++lane)
      if (packet.part_hit[lane] != nullptr) column[first_ + lane] = from[lane];
  };
  put(x_m, hits.position_enu_m.x), put(y_m, hits.position_enu_m.y), put(z_m, hits.position_enu_m.z);
  put(nx, hits.normal_enu.x), put(ny, hits.normal_enu.y), put(nz, hits.normal_enu.z);
  put(ax, hits.arrival_enu.x), put(ay, hits.arrival_enu.y), put(az, hits.arrival_enu.z);
  put(range_m, hits.range_m), put(time_s, hits.travel_time_s), put(length_m, hits.path_length_m);
  put(tube_m2, hits.tube_m2), put(grazing, hits.sin_grazing);
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    const Part* const part = packet.part_hit[lane];
    if (part == nullptr) continue;
    hits.facet_m[first_ + lane] = part->facet_m();
    hits.tile[first_ + lane] = part->number();
    hits.contributor[first_ + lane] = part->contributor_at({x_m[lane], y_m[lane]});
  }
}

ENSONIFY_WIDE bool BentPacket::go_on(const Source& source, const Packet& packet) {
  const Layers::Layer layer = source.layers[layer_];
  if (++layer_ == source.layers.size()) return false;
  bool any = false;
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    if (packet.part_hit[lane] != nullptr) on_[lane] = 0;
    any = any || on_[lane] != 0;
  }
  if (!any) return false;
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    const double end_cosine = at_.invariant_spm[lane] * layer.bottom_mps;
    const double scale = mean_scale(at_.sine[lane] - end_sine_[lane], at_.cosine[lane] - end_cosine);
    const Arc arc(length_m_[lane], scale, at_.invariant_spm[lane] * layer.gradient_per_s, layer.gradient_per_s,
                  layer.top_mps, layer.bottom_mps);
    at_.sine[lane] = end_sine_[lane];
    at_.cosine[lane] = end_cosine;
    at_.time_s[lane] += arc.time_s;
    at_.length_m[lane] += arc.length_m;
    at_.reach_m2ps[lane] += arc.reach_m2ps;
    at_.width_m[lane] += at_.width_slowness[lane] * arc.reach_m2ps;
    // The width's slope jumps with the gradient (Path).
    at_.width_slowness[lane] -=
        at_.width_m[lane] * at_.invariant_spm[lane] * at_.invariant_spm[lane] * layer.jump_per_s / at_.sine[lane];
  }
  return true;
}

}  // namespace ensonify::trace
