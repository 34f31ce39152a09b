#include "components/logger/kmall/sounding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/logger/beam_fields.h"
#include "components/logger/image_series.h"

namespace ensonify::logger::kmall {

using formats::kmall::Sounding;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr float kNoStrength_db = -100.0F;          // of rejected soundings, as genuine files have it
constexpr std::size_t kMostImageSamples = 60'000;  // what the format's header file makes room for

float or_zero(double value) { return std::isfinite(value) ? static_cast<float>(value) : 0.0F; }

/// Standard deviations from those of range and angle, at the sounding's place from the head.
void add_uncertainty(const msg::Soundings& from, std::size_t entry, const frames::Vec3& level_m, Sounding& written) {
  const double across_m = std::hypot(level_m.x(), level_m.y()), down_m = level_m.z();
  const double range_m = std::hypot(across_m, down_m);
  const double range_sd_m = or_zero(at_or_nan(from.range_sd_m, entry));
  const double angle_sd_rad = or_zero(at_or_nan(from.angle_sd_rad, entry));
  if (range_m <= 0.0 || down_m <= 0.0) return;
  const double vertical_m = std::hypot(range_sd_m * down_m / range_m, angle_sd_rad * across_m);
  written.vertical_sd_m = static_cast<float>(vertical_m);
  written.horizontal_sd_m = static_cast<float>(std::hypot(range_sd_m * across_m / range_m, angle_sd_rad * down_m));
  written.quality = static_cast<float>(100.0 * vertical_m / down_m);
}

/// BS = EL - SL - M + TVG + correction, with a sensitivity M of 0: the level EL follows again.
void add_strength(const msg::Soundings& from, std::size_t entry, Sounding& written) {
  const double strength_db = at_or_nan(from.backscatter_strength_db, entry);
  const double level_db = at_or_nan(from.backscatter_db, entry);
  const auto sectors = sectors_of(from.applied);
  const double source_db = sectors[std::min<std::size_t>(written.sector, sectors.size() - 1)].source_level_db;
  written.source_level_db = static_cast<float>(source_db);
  if (!std::isfinite(strength_db)) return;
  written.reflectivity_1_db = written.reflectivity_2_db = static_cast<float>(strength_db);
  written.tvg_db = or_zero(strength_db - level_db + source_db);
}

}  // namespace

Sounding sounding(const LoggedSoundings& ping, const PingPlace& place, std::size_t entry) {
  constexpr std::uint8_t kRejected = 2, kAmplitude = 1, kPhase = 2;
  const msg::Soundings& from = ping.soundings;
  Sounding written;
  written.index = static_cast<std::uint16_t>(entry);
  if (entry < from.sector.size()) written.sector = from.sector[entry];
  written.range_factor = 100.0F;
  written.water_column_beam = static_cast<std::uint16_t>(entry < from.beam.size() ? from.beam[entry] : entry);
  const auto angle_rad = static_cast<double>(from.beam_angle_rad[entry]);
  const frames::Vec3 axis = place.level_from_head * frames::Vec3(0.0, std::sin(angle_rad), std::cos(angle_rad));
  written.water_column_angle_deg = static_cast<float>(std::atan2(-axis.y(), axis.z()) / kDegree);
  written.angle_deg = static_cast<float>(-angle_rad / kDegree);
  written.absorption_dbpkm = static_cast<float>(1e3 * from.applied.gain_absorption_dbpm);
  written.reflectivity_1_db = written.reflectivity_2_db = kNoStrength_db;
  if (!is_valid(from, entry)) {
    written.detection = kRejected;
    return written;
  }
  written.method = entry < from.kind.size() && from.kind[entry] == 2 ? kPhase : kAmplitude;
  written.window_s = written.echo_length_s = or_zero(at_or_nan(from.window_s, entry));
  written.travel_time_s = from.travel_time_s[entry];
  written.water_column_range = count_of(static_cast<double>(written.travel_time_s) / from.sample_period_s);

  const frames::Vec3 sounding_enu_m(from.position_enu_m(entry, 0), from.position_enu_m(entry, 1),
                                    from.position_enu_m(entry, 2));
  const frames::Geodetic geodetic = ping.world.geodetic_of(sounding_enu_m.head<2>());
  const frames::Vec3 level_m = place.level_from_enu * (sounding_enu_m - place.body.position_enu_m);
  written.delta_latitude_deg = static_cast<float>(geodetic.latitude_deg - place.reference.latitude_deg);
  written.delta_longitude_deg =
      static_cast<float>(std::remainder(geodetic.longitude_deg - place.reference.longitude_deg, 360.0));
  written.x_m = static_cast<float>(level_m.x());
  written.y_m = static_cast<float>(level_m.y());
  written.z_m = static_cast<float>(level_m.z());
  add_uncertainty(from, entry, place.level_from_enu * (sounding_enu_m - place.head_enu_m), written);
  add_strength(from, entry, written);
  return written;
}

void add_image(const LoggedSoundings& ping, formats::kmall::Soundings& written) {
  const msg::Soundings& from = ping.soundings;
  if (!ping.image) {
    for (Sounding& one : written.soundings) {
      if (!one.valid()) continue;
      one.image_first_sample = one.water_column_range;
      one.image_centre_sample = one.image_samples = 1;
      written.image_ddb.push_back(tenths(static_cast<double>(one.reflectivity_2_db)));
    }
    return;
  }
  const std::size_t most = kMostImageSamples / std::max<std::size_t>(from.beam_angle_rad.size(), 1);
  const auto series = image_series(from, *ping.image, most);
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (!series[i]) continue;
    Sounding& one = written.soundings[i];
    one.image_first_sample = count_of(series[i]->first_s / ping.image->sample_period_s);
    one.image_centre_sample = static_cast<std::uint16_t>(series[i]->centre + 1);
    one.image_samples = static_cast<std::uint16_t>(series[i]->count);
    double power = 0.0;
    for (std::size_t k = 0; k < series[i]->count; ++k) {
      const auto strength_db = static_cast<double>(ping.image->strength_db[series[i]->begin + k]);
      power += std::pow(10.0, 0.1 * strength_db);
      written.image_ddb.push_back(tenths(strength_db));
    }
    if (one.valid() && power > 0.0)
      one.reflectivity_1_db = static_cast<float>(10.0 * std::log10(power / static_cast<double>(series[i]->count)));
  }
}

}  // namespace ensonify::logger::kmall
