#include "tools/feed/examine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <variant>

#include "components/errors/overloaded.h"

namespace ensonify::feed_doctor {
namespace {

constexpr double kDay_s = 86400.0;
constexpr std::size_t kLongestLine = 1024;

/// "INGGA"; of proprietary sentences with a number behind the name "PSXN,23".
std::string name_of(const nmea::Fields& fields) {
  std::string name(fields.front());
  if ((name == "PSXN" || name == "PSAT") && fields.size() > 1) name += "," + std::string(fields[1]);
  return name;
}

std::string text_of(const formats::Motion& motion) {
  const auto text = [](const std::optional<double>& value) { return value ? fmt::format("{:.6f}", *value) : "-"; };
  return text(motion.true_heading_rad) + text(motion.roll_rad) + text(motion.pitch_rad) + text(motion.heave_m);
}

std::optional<double> time_of(const nmea::Navigation& said) {
  return std::visit(Overloaded{[](const nmea::Fix& fix) { return std::optional(fix.time_s); },
                               [](const nmea::MinimumFix& fix) { return std::optional(fix.fix.time_s); },
                               [](const nmea::DateAndTime& clock) { return std::optional(clock.time_s); },
                               [](const nmea::FixAccuracy& accuracy) { return std::optional(accuracy.time_s); },
                               [](const formats::Motion& motion) { return motion.time_s; },
                               [](const auto&) { return std::optional<double>(); }},
                    said);
}

void push(std::vector<Sampled>& to, double t_s, const std::optional<double>& value) {
  if (value && (to.empty() || t_s > to.back().t_s)) to.push_back({t_s, *value});
}

}  // namespace

std::size_t Findings::sentences() const {
  std::size_t count = 0;
  for (const auto& [name, kind] : kinds) count += kind.count;
  return count;
}

const char* word_of(Findings::Format format) {
  switch (format) {
    case Findings::Format::kNmea: return "nmea";
    case Findings::Format::kTss1: return "tss1";
    case Findings::Format::kEmAttitude: return "em_attitude";
    case Findings::Format::kKmBinary: return "km_binary";
    case Findings::Format::kNone: break;
  }
  return "";
}

void Examiner::take(std::string_view bytes, std::optional<double> unix_s, bool whole) {
  unix_s_ = unix_s;
  found_.bytes += bytes.size();
  if (unix_s) {
    if (!first_s_) first_s_ = unix_s;
    last_s_ = unix_s;
  }
  const auto raw = std::as_bytes(std::span(bytes.data(), bytes.size()));
  using formats::ByteView;
  tss1_.take(raw, [&](ByteView bytes_of) {
    ++tss1_frames_;
    const auto sample = formats::tss1::read(bytes_of);
    frame("tss1", sample ? std::optional(sample->motion) : std::nullopt);
    if (sample) push(found_.acceleration_mps2, time_s(std::nullopt), sample->vertical_acceleration_mps2);
  });
  em_attitude_.take(raw, [&](ByteView bytes_of) {
    ++em_frames_;
    const auto sample = formats::em_attitude::read(bytes_of);
    frame("em_attitude", sample ? std::optional(sample->motion) : std::nullopt);
  });
  km_binary_.take(raw, [&](ByteView bytes_of) {
    ++km_frames_;
    const auto sample = formats::km_binary::read(bytes_of);
    const auto motion = sample ? std::optional(formats::km_binary::motion_of(*sample)) : std::nullopt;
    const auto place = sample ? formats::km_binary::place_of(*sample) : std::nullopt;
    if (place) {
      ++found_.qualities[1];
      const double t_s = time_s(motion->time_s);
      if (found_.fixes.empty() || t_s > found_.fixes.back().t_s)
        found_.fixes.push_back({t_s, {place->latitude_deg, place->longitude_deg}, place->ellipsoid_height_m, 1});
    }
    frame("km_binary", motion);
  });
  for (const char c : bytes) {
    if (c == '\n') {
      take_line(line_);
      line_.clear();
    } else if (line_.size() < kLongestLine) {
      line_ += c;
    }
  }
  if (whole && !line_.empty()) {
    take_line(line_);
    line_.clear();
  }
}

/// Times go on across midnight. What has none is as much after the newest that had one as it arrived after that.
double Examiner::time_s(std::optional<double> own_s) {
  if (own_s) {
    const double step_s = has_own_ ? std::remainder(*own_s - own_s_, kDay_s) : 0.0;
    if (!has_own_) own_s_ = *own_s;
    has_own_ = true;
    const double t_s = own_s_ + step_s;
    if (step_s > 0.0 || !own_at_unix_s_) {
      own_s_ = t_s;
      own_at_unix_s_ = unix_s_;
    }
    return t_s;
  }
  if (!has_own_) return unix_s_.value_or(0.0);
  return own_s_ + (unix_s_ && own_at_unix_s_ ? *unix_s_ - *own_at_unix_s_ : 0.0);
}

Kind& Examiner::note(const std::string& name, std::optional<double> own_s) {
  Kind& kind = found_.kinds[name];
  ++kind.count;
  if (unix_s_) kind.arrivals_s.push_back(*unix_s_);
  if (own_s) kind.own_s.push_back(*own_s);
  if (own_s && unix_s_) kind.ahead_s.push_back(std::remainder(*own_s - *unix_s_, kDay_s));
  return kind;
}

void Examiner::take_line(const std::string& line) {
  const std::size_t begin = line.find('$');
  if (begin == std::string::npos) {
    if (line.find_first_not_of("\r ") != std::string::npos && line.find_first_not_of("\r ") < line.size() &&
        std::ranges::all_of(line, [](char c) { return c >= ' ' || c == '\r'; }) && line.front() != ':')
      ++found_.malformed;
    return;
  }
  const std::string_view sentence = std::string_view(line).substr(begin);
  const auto fields = nmea::fields_of(sentence);
  if (std::holds_alternative<nmea::BadChecksum>(fields)) {
    ++found_.bad_checksums;
    return;
  }
  const auto said = nmea::read_navigation(sentence);
  if (std::holds_alternative<nmea::Malformed>(said)) {
    ++found_.malformed;
    return;
  }
  ++sentences_;
  const std::string name = name_of(std::get<nmea::Fields>(fields));
  if (name.front() != 'P' && name.size() == 5) found_.talkers.insert(name.substr(0, 2));
  Kind& kind = note(name, time_of(said));
  std::visit(Overloaded{[&](const nmea::Fix& fix) { use(fix, kind); },
                        [&](const nmea::DateAndTime& clock) { use_date(clock.date, clock.time_s); },
                        [&](const nmea::MinimumFix& minimum) {
                          if (minimum.fix.quality > 0 && minimum.date) use_date(*minimum.date, minimum.fix.time_s);
                          const bool gga = std::ranges::any_of(
                              found_.kinds, [](const auto& one) { return one.first.ends_with("GGA"); });
                          if (!gga) use(minimum.fix, kind);
                        },
                        [&](const nmea::Datum& datum) { found_.datums.insert(datum.code); },
                        [&](const nmea::Heading& heading) {
                          formats::Motion motion;
                          motion.true_heading_rad = heading.true_heading_rad;
                          use(motion, kind);
                        },
                        [&](const formats::Motion& motion) { use(motion, kind); }, [](const auto&) {}},
             said);
}

void Examiner::use_date(std::chrono::sys_days date, double time_s) {
  if (!unix_s_) return;
  const double ahead_s = kDay_s * static_cast<double>(date.time_since_epoch().count()) + time_s - *unix_s_;
  ++found_.dates_ahead_days[std::lround(ahead_s / kDay_s)];
}

void Examiner::use(const nmea::Fix& fix, Kind&) {
  ++found_.qualities[fix.quality];
  if (fix.quality == 0) return;
  const double t_s = time_s(fix.time_s);
  if (found_.fixes.empty() || t_s > found_.fixes.back().t_s)
    found_.fixes.push_back({t_s, {fix.latitude_deg, fix.longitude_deg}, fix.height_above_geoid_m, fix.quality});
}

void Examiner::use(const formats::Motion& motion, Kind& kind) {
  std::string now = text_of(motion);
  kind.repeats += kind.newest == now;
  kind.newest = std::move(now);
  const double t_s = time_s(motion.time_s);
  push(found_.heading_rad, t_s, motion.true_heading_rad);
  push(found_.roll_rad, t_s, motion.roll_rad);
  push(found_.pitch_rad, t_s, motion.pitch_rad);
  push(found_.heave_m, t_s, motion.heave_m);
}

void Examiner::frame(const char* name, const std::optional<formats::Motion>& motion) {
  if (!motion) {
    ++found_.malformed;
    return;
  }
  Kind& kind = note(name, motion->time_s);
  found_.unusable += !motion->usable;
  if (motion->usable) use(*motion, kind);
}

Findings Examiner::findings() {
  using Format = Findings::Format;
  const std::pair<std::size_t, Format> explained[] = {{60 * sentences_, Format::kNmea},
                                                      {27 * tss1_frames_, Format::kTss1},
                                                      {10 * em_frames_, Format::kEmAttitude},
                                                      {120 * km_frames_, Format::kKmBinary}};
  const auto most = *std::ranges::max_element(explained, {}, [](const auto& one) { return one.first; });
  found_.format = most.first > 0 ? most.second : Format::kNone;
  if (found_.format == Format::kTss1) found_.skipped_bytes = tss1_.skipped_bytes();
  if (found_.format == Format::kEmAttitude) found_.skipped_bytes = em_attitude_.skipped_bytes();
  if (found_.format == Format::kKmBinary) found_.skipped_bytes = km_binary_.skipped_bytes();
  if (first_s_) found_.seconds = *last_s_ - *first_s_;
  return found_;
}

}  // namespace ensonify::feed_doctor
