#include "components/nav_feed/source_decoder.h"

#include <cmath>
#include <span>

namespace ensonify {
namespace {

constexpr double kDay_s = 86400.0;

}  // namespace

SourceDecoder::SourceDecoder(const FeedSource& source, Count count) : source_(source), count_(std::move(count)) {}

void SourceDecoder::take(std::string_view bytes, bool begins, bool whole, const Each& each) {
  if (begins) {
    tss1_ = {};
    em_attitude_ = {};
    km_binary_ = {};
  }
  const auto raw = std::as_bytes(std::span(bytes.data(), bytes.size()));
  using Format = FeedSource::Format;
  using namespace formats;
  switch (source_.format) {
    case Format::kNmea:
      return lines_.take(
          bytes, begins, whole, [&](std::string_view line) { give(nmea::read_navigation(line), each); },
          [this] { count_("lines_too_long"); });
    case Format::kTss1:
      return tss1_.take(raw, [&](ByteView frame) {
        const auto sample = tss1::read(frame);
        give(sample ? std::optional(sample->motion) : std::nullopt, each);
      });
    case Format::kEmAttitude:
      return em_attitude_.take(raw, [&](ByteView frame) {
        const auto sample = em_attitude::read(frame);
        give(sample ? std::optional(sample->motion) : std::nullopt, each);
      });
    case Format::kKmBinary:
      return km_binary_.take(raw, [&](ByteView frame) {
        const auto sample = km_binary::read(frame);
        const auto place = sample ? km_binary::place_of(*sample) : std::nullopt;
        if (place) {
          nmea::Fix fix{
              *km_binary::motion_of(*sample).time_s, 1, place->latitude_deg, place->longitude_deg, 0.0, {}, {}};
          fix.height_above_geoid_m = place->ellipsoid_height_m;  // FeedSource::heights_are_of_ellipsoid
          give(nmea::Navigation(fix), each);
        }
        give(sample ? std::optional(km_binary::motion_of(*sample)) : std::nullopt, each);
      });
  }
}

bool SourceDecoder::is_of_the_day_before(double time_s) const {
  return source_.time_scale == FeedSource::TimeScale::kGps && time_s < kGpsAhead_s;
}

double SourceDecoder::utc_s(double time_s) const {
  if (source_.time_scale != FeedSource::TimeScale::kGps) return time_s;
  return time_s - kGpsAhead_s + (is_of_the_day_before(time_s) ? kDay_s : 0.0);
}

void SourceDecoder::give(nmea::Navigation found, const Each& each) {
  if (auto* motion = std::get_if<formats::Motion>(&found)) return give(std::optional(*motion), each);
  const auto asked_for = [&](bool asked) {
    if (!asked) count_("sentences_not_asked_for");
    return asked;
  };
  if (auto* fix = std::get_if<nmea::Fix>(&found)) {
    if (!asked_for(source_.place)) return;
    fix->time_s = utc_s(fix->time_s);
  } else if (auto* minimum = std::get_if<nmea::MinimumFix>(&found)) {
    if (!asked_for(source_.place)) return;
    if (minimum->date && is_of_the_day_before(minimum->fix.time_s)) *minimum->date -= std::chrono::days(1);
    minimum->fix.time_s = utc_s(minimum->fix.time_s);
  } else if (auto* accuracy = std::get_if<nmea::FixAccuracy>(&found)) {
    if (!asked_for(source_.place)) return;
    accuracy->time_s = utc_s(accuracy->time_s);
  } else if (auto* date = std::get_if<nmea::DateAndTime>(&found)) {
    if (is_of_the_day_before(date->time_s)) date->date -= std::chrono::days(1);
    date->time_s = utc_s(date->time_s);
  } else if (std::holds_alternative<nmea::Datum>(found)) {
    if (!asked_for(source_.place)) return;
  } else if (std::holds_alternative<nmea::Heading>(found)) {
    if (!asked_for(source_.heading)) return;
  }
  each(found);
}

void SourceDecoder::give(const std::optional<formats::Motion>& motion, const Each& each) {
  if (!motion) return count_("motions_malformed");
  if (!motion->usable) return count_("motions_invalid");
  formats::Motion corrected = *motion;
  correct(corrected);
  if (!corrected.roll_rad && !corrected.pitch_rad && !corrected.heave_m && !corrected.true_heading_rad) {
    return count_("sentences_not_asked_for");
  }
  each(corrected);
}

void SourceDecoder::correct(formats::Motion& motion) {
  if (motion.time_s) motion.time_s = utc_s(*motion.time_s);
  if (source_.time_scale == FeedSource::TimeScale::kNone) motion.time_s.reset();
  if (!source_.heading) motion.true_heading_rad.reset();
  if (!source_.motion) {
    motion.roll_rad.reset();
    motion.pitch_rad.reset();
    motion.heave_m.reset();
  }
  if (motion.roll_rad && source_.roll_reversed) motion.roll_rad = -*motion.roll_rad;
  if (motion.pitch_rad && source_.pitch_reversed) motion.pitch_rad = -*motion.pitch_rad;
  if (motion.heave_m && source_.heave_reversed) motion.heave_m = -*motion.heave_m;
  roll_rad_ = motion.roll_rad.value_or(roll_rad_);
  pitch_rad_ = motion.pitch_rad.value_or(pitch_rad_);
  if (motion.heave_m) {  // what the sensor rises by as the body turns about its reference point is none of that point's
    const frames::Vec3& lever = source_.heave_body_m;
    const double above_m = (frames::enu_from_body(frames::Attitude{0.0, pitch_rad_, roll_rad_}) * lever).z();
    *motion.heave_m -= above_m + lever.z();
  }
}

}  // namespace ensonify
