#include "components/multibeam/head.h"

#include <algorithm>
#include <map>
#include <utility>

#include "components/multibeam/ping_message.h"
#include "components/multibeam/snippets.h"
#include "components/sonar/environment.h"
#include "components/sonar/head_motion.h"

namespace ensonify {
namespace {

std::size_t ping_bytes(const MultibeamConfig& config) {
  return static_cast<std::size_t>(config.beams) * static_cast<std::size_t>(config.most_samples() + 1) * 2 *
             sizeof(float) +
         65536;
}

std::size_t most_entries(const MultibeamConfig& config) {
  const Steering steering = steer(config, config.swath_rad, {});
  return steering.sin_soundings.size() * static_cast<std::size_t>(config.detections_per_beam);
}

std::size_t soundings_bytes(const MultibeamConfig& config) {
  const auto poses = static_cast<std::size_t>(config.longest_reception_s() / seconds(kTrackPeriod)) + 3;  // 8 numbers
  return most_entries(config) * 88 + poses * 64 + 8192;
}

/// Every sample of every entry's beam, at worst.
std::size_t snippet_bytes(const MultibeamConfig& config) {
  return most_entries(config) * (static_cast<std::size_t>(config.most_samples()) * sizeof(float) + 32) + 8192;
}

/// Summary of all sectors together.
TraceSummary summary_of(std::span<const Sector::Sent> sent, std::span<const Echoed> echoed, double range_m,
                        const trace::Scene& seabed) {
  TraceSummary summary = echoed.front().summary(sent.front().shot, range_m, seabed);
  for (const Echoed& other : echoed.subspan(1)) {
    summary.rays_that_hit += other.rays_that_hit;
    summary.rays_in_lobe += other.rays_in_lobe;
  }
  return summary;
}

}  // namespace

HeadPlan Multibeam::plan(const Config& config) {
  std::vector<msg::SectorDeclaration> sectors;
  for (const auto& sector : config.all_sectors()) sectors.push_back({sector.frequency_hz, sector.delay_s});
  return {.channels = {{"", config.start(), config.limits(), sectors}},
          .longest_reception_s = config.longest_reception_s(),
          .finest_beam_rad = std::min(config.transmit_beamwidth_rad, config.receive_beamwidth_rad),
          .probe = true,
          .instrument = config.instrument};
}

Multibeam::Multibeam(const Config& config, std::size_t)
    : config_(config),
      arrays_(config),
      applied_(applied_profile(*config.world)),
      detector_(config, arrays_),
      soundings_(config, arrays_),
      state_{.relief = {},
             .range = AutoRange(config.range_m, 0.5 * config.swath_rad, config.beams),
             .swath_of_range_rad = config.swath_rad,
             .attitude = {},
             .heading = HeadingMean(config.heading_mean_s)} {
  std::map<double, std::shared_ptr<const Environment>> environments;  // by frequency
  for (std::size_t i = 0; i < arrays_.sectors.size(); ++i) {
    const double frequency_hz = arrays_.sectors[i].frequency_hz;
    auto& environment = environments[frequency_hz];
    if (!environment) environment = std::make_shared<const Environment>(*config.world, frequency_hz);
    sectors_.emplace_back(config, config.effects, arrays_, i, environment);
    if (config.labels == LabelKind::kEnergies)
      expectations_.emplace_back(config, without_speckle(config.effects), arrays_, i, environment);
  }
}

HeadOutputs<msg::Ping, msg::Soundings, msg::Snippets, msg::SeabedImage, msg::Energies> Multibeam::outputs() const {
  const std::size_t image_bytes = snippet_bytes(config_);
  return {{"ping", ping_bytes(config_)},
          {"soundings", soundings_bytes(config_)},
          {"snippets", image_bytes, config_.snippets},
          {"seabed_image", image_bytes, config_.image.published},
          {"energies", kEnergySources * ping_bytes(config_), config_.labels == LabelKind::kEnergies}};
}

void Multibeam::connect(Ports& ports) {
  ports.in<msg::Attitude>("attitude",
                          [this](const msg::Attitude& sensor) {
                            state_.attitude = {sensor.heading_grid_rad, sensor.pitch_rad, sensor.roll_rad};
                            state_.heading.update(1e-9 * static_cast<double>(sensor.stamp_ns), sensor.heading_grid_rad);
                          },
                          {.delay = from_seconds(config_.attitude_latency_s), .optional = true});
}

Multibeam::Sent Multibeam::transmit(SimTime now, HeadSettings settings, const Surroundings& around) {
  follow_range(settings);
  if (settings.auto_range) settings.range_m = state_.range.range_m();
  const SimTime reception = from_seconds(config_.reception_s(settings.range_m, settings.pulse_length_s));
  Sent sent;
  for (const auto& sector : config_.all_sectors()) {
    sent.sectors.push_back({.frequency_hz = sector.frequency_hz,
                            .pulse_length_s = settings.pulse_length_s,
                            .reception = reception,
                            .settings = settings,
                            .bandwidth_hz = config_.bandwidth_hz,
                            .delay = from_seconds(sector.delay_s)});
  }
  sent.steering = steer(config_, settings.swath_rad, steering_inputs(now, around));
  return sent;
}

/// A swath of another width searches for its edges anew.
void Multibeam::follow_range(const HeadSettings& settings) {
  if (settings.swath_rad == state_.swath_of_range_rad) return;
  state_.swath_of_range_rad = settings.swath_rad;
  state_.range = AutoRange(config_.range_m, 0.5 * settings.swath_rad, config_.beams);
}

/// Until the probe reports, the head takes the applied profile's speed at the depth where it estimates to be.
SteeringInputs Multibeam::steering_inputs(SimTime now, const Surroundings& around) const {
  SteeringInputs steering_inputs;
  steering_inputs.vehicle = state_.attitude;
  steering_inputs.mean_heading_rad = state_.heading.mean_rad();
  if (around.probe_mps) {
    steering_inputs.sound_speed_mps = *around.probe_mps;
    return steering_inputs;
  }
  const auto body = around.estimate.at(now.count(), frames::PoseHistory::Outside::kNearest);
  steering_inputs.sound_speed_mps = applied_.speed_mps(
      body ? -frames::head_pose(*body, config_.mounting.measured).position_enu_m.z() : config_.world->mission.depth_m);
  return steering_inputs;
}

Multibeam::Design Multibeam::prepare(const HeadSettings& settings) const {
  Design design{settings.pulse_length_s, settings.swath_rad, {}};
  for (const Sector& sector : sectors_) design.sectors.push_back(sector.prepare(settings));
  return design;
}

Multibeam::Report Multibeam::ping(const PingEvent& event, const Sent& sent, const Surroundings& around) {
  const HeadSettings& settings = sent.sectors.front().settings;
  const Steering& steering = sent.steering;
  const Design& design = design_of(*this, settings, memory_.design);
  const uncertainty::Navigation navigation = around.navigation_errors.value_or(config_.uncertainty.unstated());
  const InstrumentPing known{event, settings, steering, around.estimate, navigation};

  const auto transmissions = insonify(event, settings, design, steering, around, memory_);
  const auto echoed = echoes(transmissions, memory_);
  const auto beams = beamform(event, settings, steering, transmissions, echoed, memory_);
  Detected detected = detector_.detect(known, beams, memory_.detection);
  Placed placed = soundings_.place(known, std::move(detected), state_.relief, memory_.soundings);
  state_.range.update(placed.bottoms, event.range_m);

  Report report;
  placed.soundings.applied = applied_settings(config_, event, settings, steering);
  const auto every = [&](int n) { return n > 0 && event.ping % n == 0; };
  const bool phase = settings.mode == "water_column" || every(config_.phase_every);
  report.for_viewers = !phase && !every(config_.amplitude_every);
  if (!report.for_viewers || event.picture) {
    std::get<0>(report.messages) = ping_message(config_, event, settings, steering, placed.soundings.applied,
                                                {memory_.amplitude_upa, beams, phase});
  }
  add_images(sent, placed, beams, report);
  report.trouble = no_echo_reason(summary_of(transmissions, echoed, event.range_m, around.seabed));
  if (report.trouble.empty() && !around.estimate.empty() && placed.bottoms.empty())
    report.trouble = "no beam detects the seabed";
  std::get<1>(report.messages) = std::move(placed.soundings);
  if (!expectations_.empty()) std::get<4>(report.messages) = energies_of(event, settings, steering, transmissions);
  return report;
}

msg::Energies Multibeam::energies_of(const PingEvent& event, const HeadSettings& settings, const Steering& steering,
                                     std::span<const Sector::Sent> sent) {
  memory_.expected.resize(sectors_.size());
  memory_.expected_echoed.clear();
  for (std::size_t i = 0; i < sectors_.size(); ++i)
    memory_.expected_echoed.push_back(expectations_[i].echoes(sent[i], memory_.expected[i]));
  std::vector<EnergyRows> parts;
  for (std::size_t i = 0; i < sectors_.size(); ++i) {
    const SteeredSector& sector = steering.sectors[i];
    parts.push_back({sector.first_beam, sector.beams, sent[i].mesh,
                     expectations_[i].energies(event, settings, sent, memory_.expected_echoed,
                                               memory_.sectors[i].sin_beams, memory_.expected[i])});
  }
  const auto beams = static_cast<std::int64_t>(steering.sin_beams.size());
  const echo::Sampling sampling{0.0, sent.front().sampling.period_s, sent.front().sampling.count};
  return energies_message({event, beams, sampling}, parts);
}

std::span<const Sector::Sent> Multibeam::insonify(const PingEvent& event, const HeadSettings& settings,
                                                  const Design& design, const Steering& steering,
                                                  const Surroundings& around, Memory& memory) const {
  memory.sectors.resize(sectors_.size());
  memory.sent.clear();
  for (std::size_t i = 0; i < sectors_.size(); ++i) {
    memory.sent.push_back(
        sectors_[i].insonify(event, settings, design.sectors[i], steering, around, memory.sectors[i]));
  }
  return memory.sent;
}

std::span<const Echoed> Multibeam::echoes(std::span<const Sector::Sent> sent, Memory& memory) const {
  memory.echoed.clear();
  for (std::size_t i = 0; i < sectors_.size(); ++i)
    memory.echoed.push_back(sectors_[i].echoes(sent[i], memory.sectors[i]));
  return memory.echoed;
}

std::span<const SectorBeams> Multibeam::beamform(const PingEvent& event, const HeadSettings& settings,
                                                 const Steering& steering, std::span<const Sector::Sent> sent,
                                                 std::span<const Echoed> echoed, Memory& memory) const {
  auto& amplitude_upa = memory.amplitude_upa;
  if (!amplitude_upa || amplitude_upa.use_count() > 1) amplitude_upa = std::make_shared<std::vector<float>>();
  const auto samples = static_cast<std::size_t>(config_.samples(event.range_m, settings.pulse_length_s));
  amplitude_upa->resize(samples * steering.sin_beams.size());
  memory.beams.clear();
  for (std::size_t i = 0; i < sectors_.size(); ++i) {
    const auto rows = std::span(*amplitude_upa)
                          .subspan(samples * static_cast<std::size_t>(steering.sectors[i].first_beam),
                                   samples * static_cast<std::size_t>(steering.sectors[i].beams));
    memory.beams.push_back(sectors_[i].beamform(event, settings, sent, echoed, rows, memory.sectors[i]));
  }
  return memory.beams;
}

void Multibeam::add_images(const Sent& sent, const Placed& placed, std::span<const SectorBeams> beams,
                           Report& report) const {
  if (!config_.snippets && !config_.image.published) return;
  auto& snippets = std::get<2>(report.messages);
  auto& image = std::get<3>(report.messages);
  snippets = snippets_of(beams, sent.steering, placed.echoes, placed.soundings);
  snippets->applied = placed.soundings.applied;
  if (!config_.image.published) return;
  image = seabed_image_of(config_, sent.sectors.front().settings, sent.steering, beams.front(), arrays_.area, *snippets,
                          placed.soundings);
  image->applied = placed.soundings.applied;
}

}  // namespace ensonify
