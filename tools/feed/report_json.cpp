// The findings as one JSON object, for programs.
#include <nlohmann/json.hpp>

#include "components/formats/time_of_day.h"
#include "tools/feed/report.h"
#include "tools/feed/rhythm.h"

namespace ensonify::feed_doctor {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }
Json or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json object_of(const std::optional<Rhythm>& rhythm) {
  if (!rhythm) return nullptr;
  return {{"rate_hz", or_null(rhythm->rate_hz)}, {"jitter_ms", rhythm->jitter_ms}};
}

const char* word_of(Sign::Is is) {
  switch (is) {
    case Sign::Is::kRight: return "right";
    case Sign::Is::kReversed: return "reversed";
    case Sign::Is::kUnknown: break;
  }
  return "unknown";
}

Json object_of(const Sign& sign) {
  Json object{{"of", sign.of}, {"is", word_of(sign.is)}, {"by", or_null(sign.by)}, {"why", or_null(sign.why)}};
  object["slope"] = sign.slope ? Json(sign.slope->value) : Json(nullptr);
  object["standard_error"] = sign.slope ? Json(sign.slope->standard_error) : Json(nullptr);
  object["samples"] = sign.slope ? sign.slope->count : 0;
  return object;
}

}  // namespace

std::string json_of(const Findings& found, const Report& report, const Reception& reception) {
  Json kinds = Json::array(), qualities = Json::object(), signs = Json::array(), dates = Json::object();
  for (const auto& [name, kind] : found.kinds) {
    kinds.push_back({{"kind", name},
                     {"count", kind.count},
                     {"repeats", kind.repeats},
                     {"arrivals", object_of(rhythm_of(kind.arrivals_s, 0.0))},
                     {"own_times", object_of(rhythm_of(kind.own_s, formats::kDay_s))}});
  }
  for (const auto& [quality, count] : found.qualities) qualities[std::to_string(quality)] = count;
  for (const auto& [days, count] : found.dates_ahead_days) dates[std::to_string(days)] = count;
  for (const Sign& sign : report.signs) signs.push_back(object_of(sign));
  const Json all{{"faults", report.faults},
                 {"source", or_null(report.source)},
                 {"format", or_null(word_of(found.format))},
                 {"seconds", found.seconds > 0.0 ? Json(found.seconds) : Json(nullptr)},
                 {"bytes", found.bytes},
                 {"kinds", kinds},
                 {"talkers", found.talkers},
                 {"bad_checksums", found.bad_checksums},
                 {"malformed", found.malformed},
                 {"skipped_bytes", found.skipped_bytes},
                 {"unusable", found.unusable},
                 {"fixes_by_quality", qualities},
                 {"datums", found.datums},
                 {"dates_by_days_ahead", dates},
                 {"time_scale", or_null(report.time_scale)},
                 {"time_scale_why", or_null(report.time_scale_why)},
                 {"signs", signs},
                 {"antenna_up_m", or_null(report.antenna_up_m)},
                 {"refused", reception.refused},
                 {"trouble", or_null(reception.trouble)}};
  // Names, talkers and datums are bytes of the feed: what is no UTF-8 is replaced.
  return all.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace ensonify::feed_doctor
