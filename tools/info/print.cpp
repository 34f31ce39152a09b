#include "tools/info/print.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "components/errors/printable.h"
#include "components/formats/utc.h"

namespace ensonify::info {

namespace {

constexpr std::size_t kShown = 10;  // gaps and faults as text

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

std::string rate_text(const Stream& stream) {
  if (stream.count == 0) return "none";
  std::string text = fmt::format("{}", stream.count);
  if (stream.rate_hz() > 0) {
    text += fmt::format(" at {:.3g} Hz, longest gap {:.3f} s from {}", stream.rate_hz(), seconds(stream.longest_gap_ns),
                        iso_time(stream.gap_begin_ns));
  }
  if (stream.backward > 0) text += fmt::format(", steps back in time: {}", stream.backward);
  return text;
}

std::string extent_text(const Extent& extent) {
  if (extent.empty()) return "none";
  return fmt::format("latitude {:.7f} to {:.7f}, longitude {:.7f} to {:.7f} (degrees)", extent.latitude_deg().low,
                     extent.latitude_deg().high, extent.west_deg(), extent.east_deg());
}

std::string pings_text(const char* what, const std::string& head, const Pings& pings) {
  const auto gaps = pings.gaps();
  std::uint64_t missing = 0;
  for (const auto& gap : gaps) missing += gap.count;
  std::string text =
      fmt::format("{:<11} {}: {}; missing by number: {}\n", what, head, rate_text(pings.times()), missing);
  for (std::size_t i = 0; i < gaps.size() && i < kShown; ++i) {
    text += fmt::format("  missing   {} from number {} on, after {}\n", gaps[i].count, gaps[i].first,
                        iso_time(gaps[i].after_ns));
  }
  if (gaps.size() > kShown) text += fmt::format("  and       {} gaps more\n", gaps.size() - kShown);
  return text;
}

nlohmann::ordered_json json_of(const Stream& stream) {
  return {{"count", stream.count},
          {"rate_hz", stream.rate_hz()},
          {"longest_gap_s", seconds(stream.longest_gap_ns)},
          {"longest_gap_begin", stream.count > 1 ? nlohmann::ordered_json(iso_time(stream.gap_begin_ns)) : nullptr},
          {"backward", stream.backward}};
}

nlohmann::ordered_json json_of(const Pings& pings) {
  nlohmann::ordered_json json = json_of(pings.times());
  json["numbers"] = pings.count();
  json["gaps"] = nlohmann::ordered_json::array();
  std::uint64_t missing = 0;
  for (const auto& gap : pings.gaps()) {
    missing += gap.count;
    json["gaps"].push_back({{"first", gap.first}, {"count", gap.count}, {"after", iso_time(gap.after_ns)}});
  }
  json["missing"] = missing;
  return json;
}

}  // namespace

std::string iso_time(std::int64_t unix_ns) {
  const formats::DayTime time = formats::day_time(unix_ns);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", time.date / 10000, time.date / 100 % 100,
                     time.date % 100, time.time_ms / 3'600'000, time.time_ms / 60'000 % 60, time.time_ms / 1'000 % 60,
                     time.time_ms % 1'000);
}

std::string text_of(const std::string& file, const Summary& summary) {
  std::string text = fmt::format("{}\nformat      {}, {} bytes\nsystem      {}\n", file, summary.format, summary.bytes,
                                 summary.system);
  if (summary.datagrams.count > 0) {
    text += fmt::format("time        {} to {} ({:.3f} s)\n", iso_time(summary.datagrams.first_ns),
                        iso_time(summary.datagrams.last_ns),
                        seconds(summary.datagrams.last_ns - summary.datagrams.first_ns));
  }
  text += fmt::format("extent      {}", extent_text(summary.extent));
  text += '\n';
  if (!summary.depth_m.empty()) {
    text += fmt::format("depth       {:.2f} to {:.2f} m, {}\n", summary.depth_m.low, summary.depth_m.high,
                        summary.depth_of);
  }
  text += fmt::format("positions   {}\nattitude    {}\n", rate_text(summary.positions), rate_text(summary.attitudes));
  for (const auto& [head, pings] : summary.pings) text += pings_text("pings", head, pings);
  for (const auto& [head, pings] : summary.water_columns) text += pings_text("water column", head, pings);
  for (const auto& [type, kind] : summary.kinds) {
    text += fmt::format("{:>8}    {:<4} {}\n", kind.count, type, kind.about.empty() ? "(kept as bytes)" : kind.about);
  }
  for (const Mounting& mounting : summary.mountings) {
    text += fmt::format("mounting    {}:", mounting.name);
    for (const auto& [quantity, value] : mounting.values) text += fmt::format(" {}={}", quantity, value);
    text += '\n';
  }
  for (const std::string& note : summary.notes) text += fmt::format("note        {}\n", note);
  text += fmt::format("faults      {}", summary.faults.count());
  if (summary.faults.skipped_bytes() > 0) text += fmt::format(", {} bytes skipped", summary.faults.skipped_bytes());
  text += '\n';
  const auto& faults = summary.faults.kept();
  for (std::size_t i = 0; i < faults.size() && i < kShown; ++i) {
    text += fmt::format("  at {:>10}: {}\n", faults[i].offset, faults[i].cause);
  }
  if (summary.faults.count() > kShown) text += fmt::format("  and {} more\n", summary.faults.count() - kShown);
  return printable(text);
}

nlohmann::ordered_json json_of(const std::string& file, const Summary& summary) {
  nlohmann::ordered_json json;
  json["file"] = printable(file);
  json["format"] = summary.format;
  json["bytes"] = summary.bytes;
  json["system"] = printable(summary.system);
  const bool timed = summary.datagrams.count > 0;
  json["first"] = timed ? nlohmann::ordered_json(iso_time(summary.datagrams.first_ns)) : nullptr;
  json["last"] = timed ? nlohmann::ordered_json(iso_time(summary.datagrams.last_ns)) : nullptr;
  json["extent_deg"] = nullptr;
  if (!summary.extent.empty()) {
    json["extent_deg"] = {{"south", summary.extent.latitude_deg().low},
                          {"north", summary.extent.latitude_deg().high},
                          {"west", summary.extent.west_deg()},
                          {"east", summary.extent.east_deg()}};
  }
  json["unusable_positions"] = summary.extent.unusable();
  json["depth_m"] = nullptr;
  if (!summary.depth_m.empty()) {
    json["depth_m"] = {{"low", summary.depth_m.low}, {"high", summary.depth_m.high}, {"of", summary.depth_of}};
  }
  json["positions"] = json_of(summary.positions);
  json["attitude"] = json_of(summary.attitudes);
  json["pings"] = nlohmann::ordered_json::object();
  for (const auto& [head, pings] : summary.pings) json["pings"][head] = json_of(pings);
  json["water_columns"] = nlohmann::ordered_json::object();
  for (const auto& [head, pings] : summary.water_columns) json["water_columns"][head] = json_of(pings);
  json["datagrams"] = nlohmann::ordered_json::object();
  for (const auto& [type, kind] : summary.kinds) {
    json["datagrams"][printable(type)] = {{"count", kind.count}, {"about", kind.about}};
  }
  json["mountings"] = nlohmann::ordered_json::object();
  for (const Mounting& mounting : summary.mountings) {
    auto& values = json["mountings"][printable(mounting.name)];
    for (const auto& [quantity, value] : mounting.values) values[quantity] = printable(value);
  }
  json["notes"] = summary.notes;
  json["faults"] = {{"count", summary.faults.count()},
                    {"skipped_bytes", summary.faults.skipped_bytes()},
                    {"first", nlohmann::ordered_json::array()}};
  for (const auto& fault : summary.faults.kept()) {
    json["faults"]["first"].push_back({{"offset", fault.offset}, {"cause", fault.cause}});
  }
  return json;
}

}  // namespace ensonify::info
