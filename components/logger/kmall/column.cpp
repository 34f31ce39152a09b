#include "components/logger/kmall/column.h"

#include <numbers>

#include "components/logger/beam_fields.h"
#include "components/logger/column_samples.h"
#include "components/logger/head_track.h"

namespace ensonify::logger::kmall {

using formats::kmall::WaterColumn;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

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
  written.phase = WaterColumn::kNoPhase;  // themachinethatgoesping 0.35 loses its place over them
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
    written.beams.push_back(std::move(beam));
  }
  return written;
}

}  // namespace ensonify::logger::kmall
