#include "components/navigation/water_instruments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace ensonify {
namespace {

template <class T>
SimTime next_of(const std::optional<T>& carried) {
  return carried ? carried->due.next() : kNever;
}

constexpr double kHalfWidth_rad = 1e-3;

/// What a ray along a direction examines.
lod::View view_along(const frames::HeadPose& from, const frames::Vec3& direction, double longest_m) {
  lod::View view;
  lod::Frustum& cone = view.frustum;
  cone.apex_enu_m = from.position_enu_m;
  cone.axis_enu = (from.enu_from_head * direction).normalized();
  cone.zero_enu = cone.axis_enu.unitOrthogonal();
  cone.side_enu = cone.axis_enu.cross(cone.zero_enu);
  cone.low_sine = std::cos(kHalfWidth_rad);
  cone.low_angle_rad = -std::numbers::pi;
  cone.high_angle_rad = std::numbers::pi;
  cone.max_range_m = longest_m;
  return view;
}

}  // namespace

WaterInstruments::WaterInstruments(const Instruments& carried, const TrueWater& water, const Heights& heights,
                                   SeabedBelow& seabed, std::uint64_t seed, const std::string& process, Ports& ports,
                                   std::function<void(const msg::SoundSpeed&)> sound_speeds)
    : water_(water), heights_(heights), seabed_(seabed), sound_speeds_(std::move(sound_speeds)) {
  const auto stream = [&](const char* name) { return random::Stream(seed, process + "/" + name); };
  const auto rate = [](const Instrument& instrument) { return OutOptions{.rate = rate_of(instrument.rate_hz)}; };
  if (const auto& c = carried.sound_speed) {
    probe_.emplace(*c, sensors::ScalarSensor(c->errors, stream("sound_speed/probe")));
  }
  if (const auto& c = carried.ctd) {
    ctd_.emplace(*c, CtdSensors{{c->depth, stream("ctd/depth")},
                                {c->temperature, stream("ctd/temperature")},
                                {c->salinity, stream("ctd/salinity")}});
    ctds_out_ = ports.out<msg::Ctd>("ctd", rate(c->instrument));
  }
  if (const auto& c = carried.current_profiler) {
    profiler_.emplace(*c, stream("current_profiler"));
    profiles_out_ = ports.out<msg::CurrentProfile>("current_profile", rate(c->instrument));
  }
}

SimTime WaterInstruments::next() const { return std::min({next_of(probe_), next_of(ctd_), next_of(profiler_)}); }

void WaterInstruments::step(SimTime now, const Moment* moment, Outbox& outbox) {
  const auto n = static_cast<std::uint64_t>(profiler_ ? profiler_->due.count() : 0);
  const bool sound_speed = probe_ && probe_->due.due(now), water = ctd_ && ctd_->due.due(now);
  const bool profile = profiler_ && profiler_->due.due(now);
  if (moment == nullptr) return;
  if (sound_speed) measure_sound_speed(*moment, outbox);
  if (water) measure_water(*moment, outbox);
  if (profile) profile_current(*moment, n, outbox);
}

void WaterInstruments::measure_sound_speed(const Moment& moment, Outbox& outbox) {
  const Instrument& instrument = probe_->config.instrument;
  const double depth_m = -frames::enu_from_body(moment.truth.pose, instrument.actual.position_body_m).z();
  msg::SoundSpeed reading;
  reading.sound_speed_mps =
      probe_->sensor.measure(water_.sound_speed.speed_mps(std::max(0.0, depth_m)), probe_->since(moment.t_s));
  if (instrument.out_at(moment.t_s)) return;
  reading.stamp_ns = from_seconds(moment.stamp_s(instrument)).count();
  outbox.at(moment.now + from_seconds(instrument.latency_s), [this, reading] { sound_speeds_(reading); });
}

void WaterInstruments::measure_water(const Moment& moment, Outbox& outbox) {
  const Instrument& instrument = ctd_->config.instrument;
  const frames::Vec3 place = frames::enu_from_body(moment.truth.pose, instrument.actual.position_body_m);
  const double dt_s = ctd_->since(moment.t_s);
  const water::SeaWater truth = water_.column.at(std::max(0.0, -place.z()));
  msg::Ctd reading;
  reading.depth_m =
      ctd_->sensor.depth.measure(vertical::depth_below_water_m(place, heights_.water_level_m(moment.t_s)), dt_s);
  reading.temperature_degc = ctd_->sensor.temperature.measure(truth.temperature_degc, dt_s);
  reading.salinity_psu = ctd_->sensor.salinity.measure(truth.salinity_psu, dt_s);
  reading.sound_speed_mps = water::sound_speed_mps(water_.law, reading.temperature_degc, reading.salinity_psu,
                                                   std::max(0.0, reading.depth_m));
  if (!instrument.out_at(moment.t_s)) outbox.publish(*ctds_out_, reading, instrument, moment);
}

void WaterInstruments::profile_current(const Moment& moment, std::uint64_t n, Outbox& outbox) {
  const CurrentProfilerConfig& config = profiler_->config;
  const Instrument& instrument = config.instrument;
  if (instrument.out_at(moment.t_s)) return;
  const frames::HeadPose head = frames::head_pose(moment.truth.pose, instrument.actual);
  const frames::Vec3 own_enu_mps = moment.velocity_enu_mps(instrument.actual.position_body_m);
  const frames::Vec3 axis_enu = head.enu_from_head * frames::Vec3::UnitZ();
  std::vector<frames::Vec3> relative_mps;
  for (int bin = 0; bin < config.layout.count; ++bin) {
    const double z_m = head.position_enu_m.z() + config.layout.middle_m(bin) * axis_enu.z();
    relative_mps.push_back(head.enu_from_head.conjugate() *
                           (heights_.water_velocity_enu_mps(z_m, moment.t_s) - own_enu_mps));
  }
  const std::vector<sensors::BinReading> bins = sensors::profile_current(
      config.geometry, config.errors, config.layout, relative_mps,
      seabed_.distance_m(head, frames::Vec3::UnitZ(), config.errors.longest_m), profiler_->sensor, n);

  msg::CurrentProfile profile;
  profile.below_transducer_m = msg::Array<double>({bins.size()});
  profile.velocity_body_mps = msg::Array<double>({bins.size(), 3});
  profile.sigma_mps = msg::Array<double>({bins.size()});
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const frames::Vec3 velocity = instrument.measured.body_from_head * bins[i].velocity_mps;
    profile.below_transducer_m[i] = bins[i].depth_below_m;
    for (std::size_t k = 0; k < 3; ++k) profile.velocity_body_mps(i, k) = velocity[static_cast<Eigen::Index>(k)];
    profile.sigma_mps[i] = bins[i].sigma_mps;
  }
  outbox.publish(*profiles_out_, profile, instrument, moment);
}

void SeabedBelow::connect(Ports& ports, bool optional) {
  ports.in<msg::Tile>("tile", [this](const msg::Tile& tile) { tiles_.insert(tile); }, {.optional = optional});
  ports.in<msg::TileRelease>("release", [this](const msg::TileRelease& tile) { tiles_.release(tile); },
                             {.optional = optional});
  ports.in<msg::Mesh>("mesh", [this](const msg::Mesh& mesh) { tiles_.insert(mesh); }, {.optional = true});
  ports.in<msg::MeshRelease>("mesh_release", [this](const msg::MeshRelease& mesh) { tiles_.release(mesh); },
                             {.optional = true});
  ports.in<msg::ObjectMesh>("object_mesh", [this](const msg::ObjectMesh& mesh) { tiles_.insert(mesh); },
                            {.optional = true});
  ports.in<msg::Object>("object", [this](const msg::Object& object) { tiles_.insert(object); }, {.optional = true});
  ports.in<msg::ObjectRelease>("object_release", [this](const msg::ObjectRelease& object) { tiles_.release(object); },
                               {.optional = true});
}

std::optional<double> SeabedBelow::distance_m(const frames::HeadPose& from, const frames::Vec3& direction,
                                              double longest_m) {
  if (tiles_.scene().empty()) return std::nullopt;
  const trace::Mesh mesh = tiles_.scene().adapted(std::array{view_along(from, direction, longest_m)});
  const trace::Rays ray{{direction.cast<float>(), 0.0F}};
  trace::Hits hit;
  mesh.trace(from, ray, static_cast<float>(longest_m), hit);
  if (!hit.hit(0)) return std::nullopt;
  return hit.range_m[0];
}

}  // namespace ensonify
