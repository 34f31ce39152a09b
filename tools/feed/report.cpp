#include "tools/feed/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "components/formats/time_of_day.h"
#include "tools/feed/rhythm.h"

namespace ensonify::feed_doctor {
namespace {

constexpr double kGpsAhead_s = 18.0;   // of UTC, since 2017
constexpr double kClose_s = 5.0;       // a clock is right within this
constexpr long kRollover_days = 7168;  // 1,024 weeks, which is what ten bits count

std::string text_of(const std::optional<Rhythm>& rhythm) {
  if (!rhythm) return "-";
  if (!rhythm->rate_hz) return fmt::format("several at once, +-{:.0f} ms", rhythm->jitter_ms);
  return fmt::format("{:.4g} Hz +-{:.0f} ms", *rhythm->rate_hz, rhythm->jitter_ms);
}

struct Scale {
  const char* word = "utc";
  std::string text;
  bool fault = false;
};

/// By the machine's clock, or the stamps of a log.
Scale scale_of(const Findings& found) {
  std::vector<double> fixes_s, motion_s, dated_s;
  bool timed = false;
  for (const auto& [name, kind] : found.kinds) {
    auto& to = name.ends_with("ZDA") ? dated_s : name.ends_with("GGA") || name.ends_with("RMC") ? fixes_s : motion_s;
    to.insert(to.end(), kind.ahead_s.begin(), kind.ahead_s.end());
    timed = timed || !kind.own_s.empty();
  }
  if (!timed) return {"utc", "no times of their own: arrivals count, less latency_s"};
  const auto median = [](const std::vector<double>& of) {
    return of.empty() ? std::optional<double>() : quantile(of, 0.5);
  };
  const auto fixes = median(fixes_s), motion = median(motion_s), dated = median(dated_s);
  if (fixes && dated && std::abs(*fixes - *dated - kGpsAhead_s) < 2.0)
    return {"gps", "GPS: fixes are 18 s ahead of ZDA", true};
  if (fixes && motion && std::abs(*motion - *fixes) > kClose_s) {
    return {"utc",
            fmt::format("two scales on one way: motion is {:+.1f} s ahead of the fixes; make them two sources",
                        *motion - *fixes),
            true};
  }
  const auto any = fixes ? fixes : motion ? motion : dated;
  if (!any) return {"utc", "not known: neither arrivals nor stamps to compare with; taken for UTC"};
  if (std::abs(*any - kGpsAhead_s) < 2.0)
    return {"gps", fmt::format("GPS: {:+.2f} s ahead of the clock at arrival", *any), true};
  if (std::abs(*any) < kClose_s) return {"utc", fmt::format("UTC: {:+.2f} s ahead of the clock at arrival", *any)};
  return {"utc",
          fmt::format("not known: {:+.1f} s ahead of the clock at arrival, which may be wrong; taken for UTC", *any),
          true};
}

}  // namespace

Report report_of(const Findings& found, const std::string& way) {
  Report report;
  const auto say = [&](const std::string& line) { report.text += line + "\n"; };
  const auto fault = [&](const std::string& line) {
    say(line);
    report.faults.push_back(line);
  };
  if (found.format == Findings::Format::kNone) {
    fault(found.bytes == 0 ? "nothing has come: is the sender alive, are port, speed of the line and --sender right?"
                           : fmt::format("{} bytes, none of a known format (nmea, tss1, em_attitude, km_binary); wrong "
                                         "speed of the line?",
                                         found.bytes));
    if (found.bad_checksums > 0) say(fmt::format("{} sentences with a bad checksum", found.bad_checksums));
    return report;
  }
  const std::string seconds = found.seconds > 0.0 ? fmt::format(" in {:.1f} s", found.seconds) : "";
  say(fmt::format("format: {}, {} of them{}, {} bytes", word_of(found.format), found.sentences(), seconds,
                  found.bytes));
  say(fmt::format("{:<12} {:>7}  {:<22} {:<22} {}", "kind", "count", "arrivals", "own times", "repeats"));
  for (const auto& [name, kind] : found.kinds) {
    say(fmt::format("{:<12} {:>7}  {:<22} {:<22} {}", name, kind.count, text_of(rhythm_of(kind.arrivals_s, 0.0)),
                    text_of(rhythm_of(kind.own_s, formats::kDay_s)),
                    kind.repeats > 0 ? fmt::format("{:.0f} %", 100.0 * static_cast<double>(kind.repeats) /
                                                                   static_cast<double>(kind.count))
                                     : ""));
  }
  if (!found.talkers.empty()) say(fmt::format("talkers: {}", fmt::join(found.talkers, ", ")));
  const std::size_t all = found.sentences() + found.bad_checksums + found.malformed;
  if (found.bad_checksums > 0) fault(fmt::format("checksums: {} of {} sentences are bad", found.bad_checksums, all));
  if (found.malformed > 0)
    fault(fmt::format("malformed: {} of {} lines or frames are cut, or hold what cannot be", found.malformed, all));
  if (found.skipped_bytes > 0) fault(fmt::format("garbage: {} bytes between frames", found.skipped_bytes));
  if (found.unusable > 0) fault(fmt::format("not usable, by the sensor's own word: {} frames", found.unusable));
  for (const auto& [quality, count] : found.qualities)
    say(fmt::format("fixes of quality {}: {}{}", quality, count, quality == 0 ? " (no fix)" : ""));
  for (const std::string& datum : found.datums) {
    if (datum == "W84") say("datum: W84");
    else fault(fmt::format("datum: {}; set the receiver to WGS 84", datum));
  }
  for (const auto& [days, count] : found.dates_ahead_days) {
    if (days == 0) continue;
    const std::string line = fmt::format("dates: {} are {} days {} the clock at arrival", count, std::abs(days),
                                         days > 0 ? "ahead of" : "behind");
    if (days % kRollover_days == 0) fault(line + ": the receiver's week has rolled over; nav_feed uses no dates");
    else say(line + ", as in a log that is sent again; nav_feed uses no dates");
  }
  const Scale scale = scale_of(found);
  report.time_scale = scale.word;
  report.time_scale_why = scale.text;
  scale.fault ? fault("time scale: " + scale.text) : say("time scale: " + scale.text);

  std::string reversed;
  report.signs = signs_of(found);
  for (const Sign& sign : report.signs) {
    const std::string numbers = sign.slope ? fmt::format(" (slope {:.2f} +- {:.2f}, {} samples)", sign.slope->value,
                                                         sign.slope->standard_error, sign.slope->count)
                                           : "";
    if (sign.is == Sign::Is::kUnknown) {
      say(fmt::format("sign of {}: not known: {}{}", sign.of, sign.why, numbers));
      continue;
    }
    const bool right = sign.is == Sign::Is::kRight;
    const std::string text =
        fmt::format("sign of {}: {}, by {}{}", sign.of, right ? "right" : "reversed", sign.by, numbers);
    right ? say(text) : fault(text);
    if (!right) reversed += ", " + sign.of + "_reversed: true";
    if (sign.of == "roll") {
      report.antenna_up_m = std::abs(sign.slope->value);
      say(fmt::format("antenna: {:.1f} m above the roll centre, standard error {:.1f} m, with what sways with the roll",
                      *report.antenna_up_m, sign.slope->standard_error));
    }
  }
  say("not known from here: the sign of pitch, latency, lever arms forward and to starboard, offsets of the angles, "
      "where "
      "heave is measured; the sign of roll holds for an antenna above the roll centre");

  const bool places = !found.fixes.empty(), headings = !found.heading_rad.empty(),
             motion = !(found.roll_rad.empty() && found.pitch_rad.empty() && found.heave_m.empty());
  std::string keys = way;
  if (found.format != Findings::Format::kNmea) keys += std::string(", format: ") + word_of(found.format);
  if (!places && (found.format == Findings::Format::kNmea || found.format == Findings::Format::kKmBinary))
    keys += ", place: false";
  if (!headings) keys += ", heading: false";
  if (!motion) keys += ", motion: false";
  if (std::string(scale.word) != "utc") keys += std::string(", time_scale: ") + scale.word;
  keys += reversed;
  report.source = "{ " + keys + " }";
  say("\nsources:\n  ship: " + report.source +
      (report.antenna_up_m && places
           ? fmt::format("   # unless it is measured: antenna_position_m: [0, 0, {:.1f}]", -*report.antenna_up_m)
           : ""));
  return report;
}

}  // namespace ensonify::feed_doctor
