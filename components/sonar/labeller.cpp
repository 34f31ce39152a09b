#include "components/sonar/labeller.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "kernels/acoustics/label/masks.h"
#include "kernels/acoustics/label/shadows.h"
#include "kernels/base/profile/profile.h"
#include "kernels/water/refraction/eigenray.h"

namespace ensonify {
namespace {

constexpr int kSilhouette = 32;  // rays each way over a body's extent
constexpr std::size_t kAcross = kSilhouette;
constexpr double kPerRay = 1.0 / (kAcross * kAcross);
constexpr int kStripsPerCell = 10;       // where a body is
constexpr int kFewestStrips = 8;         // of all cells of a sector
constexpr int kStepsOfSector = 48;       // of a strip's first rays
constexpr int kStepsOfBody = 24;         // where a body is
constexpr double kSeabedSamples = 16.0;  // between a strip's neighbours on the seabed, at most

std::array<std::int64_t, 4> with(std::array<std::int64_t, 4> box, const label::Run& run) {
  const std::array<std::int64_t, 4> one{run.row, run.first, run.row + 1, run.end};
  if (box[2] == 0) return one;
  return {std::min(box[0], one[0]), std::min(box[1], one[1]), std::max(box[2], one[2]), std::max(box[3], one[3])};
}

/// Rows of four numbers: whose, row, first, end.
template <class Place>
msg::Array<std::int32_t> rows_of(std::span<const label::Run> runs, const Place& place) {
  msg::Array<std::int32_t> rows({runs.size(), 4});
  for (std::size_t i = 0; i < runs.size(); ++i) {
    rows(i, 0) = place(runs[i].whose);
    rows(i, 1) = runs[i].row;
    rows(i, 2) = runs[i].first;
    rows(i, 3) = runs[i].end;
  }
  return rows;
}

/// Direction in which a path leaves for a place, in the head's frame: as straight, turned down or up by the bending of
/// the path to it.
Eigen::Vector3d direction_to(const SeaAcoustics& sea, const frames::HeadPose& pose, const frames::Vec3& place_enu_m) {
  frames::Vec3 off = place_enu_m - pose.position_enu_m;
  const double across_m = off.head<2>().norm(), depth_m = -pose.position_enu_m.z();
  if (const auto path = sea.refracts() && across_m > 0.0
                            ? refraction::eigenray(sea.environment().profile(), depth_m, across_m, depth_m - off.z())
                            : std::nullopt) {
    const double down = path->launch_depression_rad, away_m = off.norm();
    const frames::Vec2 outwards = off.head<2>() / across_m;
    off << away_m * std::cos(down) * outwards, -away_m * std::sin(down);
  }
  return pose.enu_from_head.conjugate() * off;
}

}  // namespace

label::Row aperture_row(const LineDesign& line, int sector) {
  const auto two_way = [&](double sine) {
    const double one_way = array::power(line.line, line.wavelength_m, sine);
    return one_way * one_way;
  };
  const array::BeamEdges edges = array::half_power_edges(two_way, 0.0, 0.01 * line.first_null);
  return {0.0, edges.lower_sine, edges.upper_sine, sector};
}

msg::Labels Labeller::labels(const SeaAcoustics& sea, const Shot& shot, const trace::Mesh& mesh, const Echoed& echoed,
                             const ShotDesign& design, const LabelledImage& image, const ShotMemory& shot_memory,
                             Memory& memory) const {
  const profile::Span span(profile::Stage::kLabels);
  const Ping ping{sea, shot, mesh, echoed, image, shot_memory, memory};
  memory.forget_gone(mesh);
  std::vector<Candidate> bodies = find_bodies(ping);
  const std::vector<label::Strip> strips = strips_of(ping, bodies);
  const double period_s = image.sampling.period_s;
  const label::Fineness fineness{.body_s = period_s, .seabed_s = kSeabedSamples * period_s, .halvings = 9};
  const label::TraceEchoes tracer = [&](const trace::Rays& rays, bool through, std::vector<label::RayEcho>& echoes) {
    trace(ping, rays, through, echoes);
  };
  label::trace_strips(view_.axes, strips, fineness, tracer, memory.points);
  const label::Masks masks = label::find_masks(strips, memory.points, fineness, image.rows, image.sampling);
  const label::Shadows shadows =
      label::find_shadows(strips, memory.points, fineness, image.rows, view_.lobe, image.sampling,
                          image.background_upa2, masks.own, {.pulse_s = design.pulse.equivalent_length_s()});

  msg::Labels labels;
  labels.stamp_ns = image.event.transmit.count();
  labels.ping = image.event.ping;
  labels.beams = static_cast<std::int64_t>(image.rows.size());
  labels.samples = image.sampling.count;
  std::map<std::uint32_t, std::int32_t> places;  // in the list of objects; of those in no run yet -1
  const auto place = [&](std::uint32_t whose) { return whose == trace::kNoise ? -1 : places.at(whose); };
  for (const auto* runs : {&masks.own, &shadows.runs}) {
    for (const label::Run& run : *runs) places.emplace(run.whose, -1);
  }
  std::erase_if(bodies, [&](const Candidate& one) { return !one.seen && !places.contains(one.body->contributor); });
  // One beside the image at transmission may come into it as the head turns, or darken its edge.
  for (const trace::ShownBody& body : mesh.bodies()) {
    if (places.contains(body.contributor) && std::ranges::find(bodies, &body, &Candidate::body) == bodies.end())
      bodies.push_back(Candidate{&body});
  }
  std::ranges::sort(bodies, {}, [](const Candidate& one) { return one.body->body->instance; });
  for (const Candidate& one : bodies) {
    places[one.body->contributor] = static_cast<std::int32_t>(labels.objects.size());
    labels.objects.push_back(object_of(ping, one));
  }
  for (const label::Run& run : masks.own) {
    auto& box = labels.objects[static_cast<std::size_t>(place(run.whose))].box;
    box = with(box, run);
  }
  for (const label::Run& run : shadows.runs) {
    if (run.whose == trace::kNoise) continue;
    auto& box = labels.objects[static_cast<std::size_t>(place(run.whose))].shadow_box;
    box = with(box, run);
  }
  labels.mask_run = rows_of(masks.own, place);
  labels.layer_run = rows_of(masks.layer, place);
  labels.shadow_run = rows_of(shadows.runs, place);
  labels.shadow_db = msg::Array<std::uint8_t>::of(shadows.depth_db);
  return labels;
}

void Labeller::Memory::forget_gone(const trace::Mesh& mesh) {
  const auto bodies = mesh.bodies();
  std::erase_if(alone, [&](const auto& kept) {
    const auto there = std::ranges::find(bodies, kept.first, &trace::ShownBody::contributor);
    return there == bodies.end() || there->body != kept.second.body;
  });
}

const trace::Mesh& Labeller::Memory::of(const trace::ShownBody& body) {
  const auto [at, is_new] = alone.try_emplace(body.contributor);
  if (is_new) {
    trace::Scene scene(body.box_enu_m.center().head<2>());
    scene.insert_body(0, *body.body);
    at->second = {body.body, scene.adapted()};
  }
  return at->second.mesh;
}

/// Bodies whose extent meets the image.
std::vector<Labeller::Candidate> Labeller::find_bodies(const Ping& ping) const {
  const frames::HeadPose& pose = ping.shot.pose();
  std::vector<Candidate> bodies;
  for (const trace::ShownBody& body : ping.mesh.bodies()) {
    const frames::Vec3 middle = body.box_enu_m.center();
    const double radius_m = 0.5 * body.box_enu_m.diagonal().norm(), away_m = (middle - pose.position_enu_m).norm();
    if (away_m - radius_m > ping.image.range_m) continue;
    const double half = away_m > 1.1 * radius_m ? 1.02 * std::asin(radius_m / away_m) + 1e-3 : 2.0;
    const Eigen::Vector3f to = direction_to(ping.sea, pose, middle).normalized().cast<float>();
    const auto sine = static_cast<double>(to.dot(view_.axes.axis));
    const double angle_rad =
        std::atan2(static_cast<double>(to.dot(view_.axes.quarter)), static_cast<double>(to.dot(view_.axes.zero)));
    const double across = std::sqrt(std::max(0.0, 1.0 - sine * sine));
    const double half_rad =
        std::min(across > half ? half / (across - half * half) : std::numbers::pi, std::numbers::pi);
    Candidate one{
        &body, {std::max(-1.0, sine - half), std::min(1.0, sine + half), angle_rad - half_rad, angle_rad + half_rad}};
    const std::vector<Patch> within = within_image(ping, one.extent);
    if (within.empty()) continue;
    examine(ping, within, one);
    bodies.push_back(std::move(one));
  }
  return bodies;
}

/// Parts of a patch that rows receive from.
std::vector<Labeller::Patch> Labeller::within_image(const Ping& ping, const Patch& patch) const {
  std::vector<Patch> within;
  for (std::size_t number = 0; number < view_.sectors.size(); ++number) {
    double lower = 1.0, upper = -1.0;
    for (const label::Row& row : ping.image.rows) {
      if (row.sector == static_cast<int>(number))
        lower = std::min(lower, row.lower), upper = std::max(upper, row.upper);
    }
    const LabelSector& sector = view_.sectors[number];
    for (const double turn : {-2.0 * std::numbers::pi, 0.0, 2.0 * std::numbers::pi}) {
      const Patch part{std::max(patch.lower, lower), std::min(patch.upper, upper),
                       std::max(patch.first_rad + turn, sector.first_rad),
                       std::min(patch.last_rad + turn, sector.last_rad)};
      if (!part.empty()) within.push_back(part);
    }
  }
  return within;
}

double Labeller::Patch::sine(int i) const { return std::lerp(lower, upper, (i + 0.5) / kSilhouette); }
double Labeller::Patch::angle_rad(int j) const { return std::lerp(first_rad, last_rad, (j + 0.5) / kSilhouette); }

/// What rays evenly over a patch hit of a mesh: that of number i, j is i * kSilhouette + j.
const trace::Hits& Labeller::hits_over(const Ping& ping, const trace::Mesh& mesh, const Patch& patch) const {
  trace::Rays rays;
  for (int i = 0; i < kSilhouette; ++i) {
    for (int j = 0; j < kSilhouette; ++j)
      rays.push_back({view_.axes.direction(patch.sine(i), patch.angle_rad(j)), 1.0F});
  }
  ProbeMemory& probed = ping.memory.probed;
  ping.sea.probe(ping.shot, ping.echoed, mesh, rays, ping.image.range_m, trace::kNoise, ping.shot_memory, probed);
  return probed.hits;
}

/// Narrows a body's extent to its silhouette, of which it returns the solid angle.
double Labeller::narrow(const Ping& ping, const trace::Mesh& alone, Patch& extent) const {
  const trace::Hits& hits = hits_over(ping, alone, extent);
  Patch hit{1.0, -1.0, std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  double whole_sr = 0.0;
  for (int i = 0; i < kSilhouette; ++i) {
    for (int j = 0; j < kSilhouette; ++j) {
      if (!hits.hit(static_cast<std::size_t>(i) * kAcross + static_cast<std::size_t>(j))) continue;
      whole_sr += kPerRay * extent.solid_angle_sr();
      hit.lower = std::min(hit.lower, extent.sine(i)), hit.upper = std::max(hit.upper, extent.sine(i));
      hit.first_rad = std::min(hit.first_rad, extent.angle_rad(j));
      hit.last_rad = std::max(hit.last_rad, extent.angle_rad(j));
    }
  }
  if (whole_sr == 0.0) return 0.0;
  // It may reach a step further than the rays that hit it.
  const double step = (extent.upper - extent.lower) / kSilhouette;
  const double step_rad = (extent.last_rad - extent.first_rad) / kSilhouette;
  extent = {hit.lower - step, hit.upper + step, hit.first_rad - step_rad, hit.last_rad + step_rad};
  return whole_sr;
}

/// Rays over a body's extent with it alone; then within the image, with it alone and with all that is there.
void Labeller::examine(const Ping& ping, std::span<const Patch> within, Candidate& candidate) const {
  const trace::Mesh& alone = ping.memory.of(*candidate.body);
  const double whole_sr = narrow(ping, alone, candidate.extent);
  double inside_sr = 0.0, visible_sr = 0.0, visible = 0.0, grazing_rad = 0.0;
  frames::Vec3 middle = frames::Vec3::Zero();
  for (const Patch& patch : within) {
    std::vector<bool> silhouette(kAcross * kAcross);
    const trace::Hits& of_alone = hits_over(ping, alone, patch);
    for (std::size_t ray = 0; ray < silhouette.size(); ++ray) silhouette[ray] = of_alone.hit(ray);
    const trace::Hits& hits = hits_over(ping, ping.mesh, patch);
    for (std::size_t ray = 0; ray < silhouette.size(); ++ray) {
      if (!silhouette[ray]) continue;
      inside_sr += kPerRay * patch.solid_angle_sr();
      if (hits.contributor[ray] != candidate.body->contributor) continue;
      visible_sr += kPerRay * patch.solid_angle_sr();
      ++visible;
      middle += hits.position_enu_m[ray];
      grazing_rad += std::asin(std::min(1.0, static_cast<double>(hits.sin_grazing[ray])));
    }
  }
  candidate.seen = inside_sr > 0.0;
  if (whole_sr > 0.0) candidate.inside = std::min(1.0, inside_sr / whole_sr);
  if (candidate.seen) candidate.visible = visible_sr / inside_sr;
  if (visible == 0.0) return;
  candidate.hit_enu_m = middle / visible;
  candidate.grazing_rad = grazing_rad / visible;
}

msg::LabelledObject Labeller::object_of(const Ping& ping, const Candidate& candidate) {
  const trace::Body& body = *candidate.body->body;
  const frames::Vec3& head = ping.shot.pose().position_enu_m;
  const frames::Vec3 hit = candidate.hit_enu_m.value_or(candidate.body->box_enu_m.center());
  const frames::Vec3 towards = body.enu_from_body.conjugate() * (head - hit);
  msg::LabelledObject object;
  object.instance = body.instance;
  object.name = body.name;
  object.class_name = body.class_name;
  object.class_id = body.label_class;
  object.inside = candidate.inside;
  object.visible = candidate.visible;
  object.occluded = candidate.seen ? 1.0 - candidate.visible : 0.0;
  object.buried = body.buried;
  object.hit_enu_m = {hit.x(), hit.y(), hit.z()};
  object.range_m = (hit - head).norm();
  object.grazing_rad = candidate.grazing_rad;
  object.aspect_rad = std::atan2(towards.x(), towards.y());
  object.sediment = body.sediment;
  object.smooth = body.smooth;
  return object;
}

/// Angles of a sector that the bodies about these sines take, one after the other.
std::vector<std::pair<double, double>> Labeller::angles_of_bodies(std::span<const Candidate> bodies,
                                                                  const LabelSector& sector, double lower,
                                                                  double upper) {
  std::vector<std::pair<double, double>> taken;
  for (const Candidate& one : bodies) {
    if (one.extent.upper < lower || one.extent.lower > upper) continue;
    for (const double turn : {-2.0 * std::numbers::pi, 0.0, 2.0 * std::numbers::pi}) {
      const double first = std::max(one.extent.first_rad + turn, sector.first_rad);
      const double last = std::min(one.extent.last_rad + turn, sector.last_rad);
      if (last > first) taken.emplace_back(first, last);
    }
  }
  std::ranges::sort(taken);
  std::vector<std::pair<double, double>> apart;
  for (const auto& [first, last] : taken) {
    if (apart.empty() || first > apart.back().second) {
      apart.emplace_back(first, last);
    } else {
      apart.back().second = std::max(apart.back().second, last);
    }
  }
  return apart;
}

/// Of all rows, narrow ones where bodies are; beside the outermost cells as far as their main lobes reach.
std::vector<label::Strip> Labeller::strips_of(const Ping& ping, std::span<const Candidate> bodies) const {
  std::vector<label::Strip> strips;
  for (int number = 0; number < static_cast<int>(view_.sectors.size()); ++number) {
    const LabelSector& sector = view_.sectors[static_cast<std::size_t>(number)];
    std::vector<std::pair<double, double>> cells;
    for (const label::Row& row : ping.image.rows) {
      if (row.sector == number) cells.emplace_back(row.lower, row.upper);
    }
    const int fewest = std::max(1, kFewestStrips / static_cast<int>(cells.size()));
    const auto [lowest, highest] = std::pair(cells.front().first, cells.back().second);
    for (int beside = 0; beside < 2; ++beside) {
      const double near = 0.5 * view_.lobe.null * beside, far = near + 0.5 * view_.lobe.null;
      cells.emplace_back(lowest - far, lowest - near);
      cells.emplace_back(highest + near, highest + far);
    }
    const auto add = [&](double lower, double upper, int count, double first_rad, double last_rad, int steps,
                         bool counts) {
      const double width = (upper - lower) / count;
      for (int i = 0; i < count; ++i)
        strips.push_back({lower + (i + 0.5) * width, width, counts ? width : 0.0, first_rad, last_rad, number, steps});
    };
    for (const auto& [from, to] : cells) {
      const double lower = std::max(-1.0, from), upper = std::min(1.0, to);
      if (!(upper > lower)) continue;
      const auto taken = angles_of_bodies(bodies, sector, 1.5 * lower - 0.5 * upper, 1.5 * upper - 0.5 * lower);
      double done = sector.first_rad;
      bool counted = false;
      const auto add_seabed = [&](double last_rad) {
        if (!(last_rad > done)) return;
        const double part = (last_rad - done) / (sector.last_rad - sector.first_rad);
        add(lower, upper, fewest, done, last_rad, 1 + static_cast<int>(part * kStepsOfSector), !counted);
        counted = true;
      };
      for (const auto& [first_rad, last_rad] : taken) {
        add_seabed(first_rad);
        done = last_rad;
      }
      add_seabed(sector.last_rad);
      for (const auto& [first_rad, last_rad] : taken) {
        add(lower, upper, kStripsPerCell, first_rad, last_rad, kStepsOfBody, !counted);
        counted = true;
      }
    }
  }
  return strips;
}

void Labeller::trace(const Ping& ping, const trace::Rays& rays, bool through_bodies,
                     std::vector<label::RayEcho>& echoes) const {
  ProbeMemory& probed = ping.memory.probed;
  ping.sea.probe(ping.shot, ping.echoed, ping.mesh, rays, ping.image.range_m,
                 through_bodies ? trace::kAllBodies : trace::kNoise, ping.shot_memory, probed);
  // What a sector's receiver makes of each; a ray belongs to the sector that its echo comes from.
  const echo::Arrivals& arrivals = probed.arrivals;
  auto& [x, y, z] = arrivals.direction_head;
  auto &path_m = ping.memory.path_m, &amplitude = ping.memory.amplitude;
  path_m.resize(arrivals.size());
  amplitude.resize(arrivals.size());
  for (std::size_t k = 0; k < path_m.size(); ++k) path_m[k] = probed.hits.path_length_m[probed.rays[k]];
  echoes.assign(rays.size(), {});
  for (const LabelSector& sector : view_.sectors) {
    sector.receive->amplitudes({x, y, z}, path_m, amplitude);
    for (std::size_t k = 0; k < arrivals.size(); ++k) {
      const Eigen::Vector3f direction = arrivals.direction_head[k];
      if (view_.sectors.size() > 1 && !sector.holds(view_.axes.angle_rad(direction))) continue;
      echoes[probed.rays[k]] = {probed.hits.contributor[probed.rays[k]], static_cast<float>(arrivals.time_s[k]),
                                direction.dot(view_.axes.axis),
                                amplitude[k] * amplitude[k] * arrivals.pressure_re_upa[k]};
    }
  }
}

}  // namespace ensonify
