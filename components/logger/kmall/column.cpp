#include "components/logger/kmall/column.h"

#include <cmath>
#include <numbers>

#include "components/logger/beam_fields.h"
#include "components/logger/column_samples.h"
#include "components/logger/head_track.h"

namespace ensonify::logger::kmall {

using formats::kmall::WaterColumn;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::vector<std::int16_t> hundredths_of_degrees(const msg::Ping& column, std::size_t beam, std::size_t samples) {
  std::vector<std::int16_t> phase(samples);
  for (std::size_t k = 0; k < samples; ++k)
    phase[k] = static_cast<std::int16_t>(std::lround(100.0 * static_cast<double>(column.phase_rad(beam, k)) / kDegree));
  return phase;
}

}  // namespace

formats::kmall::Heave heave(const LoggedSoundings& ping, const Vessel& vessel) {
  const frames::Pose body = body_pose_of(ping.soundings.track, vessel);
  const double at_rest_m = vessel.head.position_body_m.z() - vessel.water_line_m;
  formats::kmall::Heave written;
  written.ping.ping = static_cast<std::uint16_t>(ping.soundings.ping);
  written.heave_m = static_cast<float>(vessel.transducer_depth_m(body, ping.heave_down_m) - at_rest_m);
  return written;
}

WaterColumn water_column(const LoggedSoundings& ping, const Vessel& vessel) {
  const msg::Ping& column = *ping.water_column;
  ColumnSamples samples = column_samples(ping, place_of(ping, vessel));
  WaterColumn written;
  written.ping.ping = static_cast<std::uint16_t>(ping.soundings.ping);
  written.heave_m = static_cast<float>(ping.heave_down_m);
  written.phase = column.phase_rad.shape() == column.amplitude_upa.shape() && !column.phase_rad.empty()
                      ? WaterColumn::kHighResolution
                      : WaterColumn::kNoPhase;
  written.tvg_log_factor = samples.log_factor;
  written.tvg_offset_db = samples.offset_db;
  written.sampling_hz = sampling_hz(column.sample_period_s);
  written.sound_speed_mps = static_cast<float>(column.applied.sound_speed_mps);
  for (const msg::TransmitSector& sent : sectors_of(column.applied)) {
    WaterColumn::Sector sector;
    sector.tilt_deg = static_cast<float>(sent.tilt_rad / kDegree);
    sector.centre_hz = static_cast<float>(sent.frequency_hz);
    sector.width_along_deg = static_cast<float>(column.applied.transmit_beamwidth_rad / kDegree);
    sector.number = static_cast<std::uint16_t>(written.sectors.size());
    written.sectors.push_back(sector);
  }
  for (std::size_t i = 0; i < samples.beams.size(); ++i) {
    ColumnSamples::Beam& from = samples.beams[i];
    WaterColumn::Beam beam;
    beam.angle_deg = static_cast<float>(from.angle_deg);
    beam.first_sample = samples.first_sample;
    beam.detected_sample = count_of(from.detected_sample);
    beam.detected_sample_fine = static_cast<float>(from.detected_sample);
    beam.sector = from.sector;
    beam.amplitude_half_db = std::move(from.half_db);
    if (written.phase == WaterColumn::kHighResolution)
      beam.phase_high = hundredths_of_degrees(column, i, beam.amplitude_half_db.size());
    written.beams.push_back(std::move(beam));
  }
  return written;
}

}  // namespace ensonify::logger::kmall
