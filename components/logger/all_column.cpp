#include "components/logger/all_column.h"

#include <numbers>

#include "components/logger/beam_fields.h"
#include "components/logger/column_samples.h"
#include "components/logger/em2040.h"

namespace ensonify::logger {

using formats::all::WaterColumn;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::size_t kMostBytes = 65'000;  // of beams, so that a datagram is within the 65,507 of a network's
constexpr std::size_t kBeamBytes = 10;      // beside its samples

WaterColumn header(const LoggedSoundings& ping, const ColumnSamples& samples) {
  constexpr std::uint8_t kCentreArray = 1;
  const msg::Ping& column = *ping.water_column;
  WaterColumn written;
  written.ping_beams = static_cast<std::uint16_t>(samples.beams.size());
  written.sound_speed_mps = written.sound_speed_mps.of(column.applied.sound_speed_mps);
  written.sampling_hz = written.sampling_hz.of(1.0 / column.sample_period_s);
  written.heave_m = written.heave_m.of(ping.heave_down_m);
  written.tvg_log_factor = samples.log_factor;
  written.tvg_offset_db = samples.offset_db;
  for (const msg::TransmitSector& sent : sectors_of(column.applied)) {
    WaterColumn::Sector sector;
    sector.tilt_deg = sector.tilt_deg.of(sent.tilt_rad / kDegree);
    sector.centre_hz = sector.centre_hz.of(sent.frequency_hz);
    sector.index = kCentreArray;
    written.sectors.push_back(sector);
  }
  return written;
}

}  // namespace

std::vector<WaterColumn> water_column(const LoggedSoundings& ping, const Vessel& vessel) {
  ColumnSamples samples = column_samples(ping, place_of(ping, vessel));
  const WaterColumn empty = header(ping, samples);
  std::vector<WaterColumn> written;
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < samples.beams.size(); ++i) {
    ColumnSamples::Beam& from = samples.beams[i];
    WaterColumn::Beam beam;
    beam.angle_deg = beam.angle_deg.of(from.angle_deg);
    beam.first_sample = samples.first_sample;
    beam.detected_sample = count_of(from.detected_sample);
    beam.sector = from.sector;
    beam.number = static_cast<std::uint8_t>(i);  // modulo 256
    beam.amplitude_half_db = std::move(from.half_db);
    const std::size_t size = kBeamBytes + beam.amplitude_half_db.size();
    if (written.empty() || bytes + size > kMostBytes) {
      written.push_back(empty);
      bytes = 0;
    }
    bytes += size;
    written.back().beams.push_back(std::move(beam));
  }
  for (std::size_t i = 0; i < written.size(); ++i) {
    written[i].datagrams = static_cast<std::uint16_t>(written.size());
    written[i].datagram = static_cast<std::uint16_t>(i + 1);
  }
  return written;
}

}  // namespace ensonify::logger
