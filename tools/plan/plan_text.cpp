#include "tools/plan/plan_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace ensonify::plan {
namespace {

/// A text as one cell of a CSV file.
std::string csv_cell(const std::string& text) {
  const bool blank_at_an_end = !text.empty() && (text.front() == ' ' || text.back() == ' ');
  if (!blank_at_an_end && text.find_first_of(",\"\r\n\t") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + "\"";
}

std::string place_text(const std::array<double, 2>& place, bool geodetic, const char* between) {
  return geodetic ? fmt::format("{:.8f}{}{:.8f}", place[0], between, place[1])
                  : fmt::format("{:.3f}{}{:.3f}", place[0], between, place[1]);
}

constexpr auto kReplace = nlohmann::json::error_handler_t::replace;  // what is no UTF-8

/// A text between quotes with escapes, which YAML and JSON share; what some reader takes for the end of a line (next
/// line, line and paragraph separators too) is escaped.
std::string quoted(const std::string& text) {
  bool breaks = false;
  for (const char* separator : {"\xc2\x85", "\xe2\x80\xa8", "\xe2\x80\xa9"}) {
    breaks = breaks || text.find(separator) != std::string::npos;
  }
  return nlohmann::json(text).dump(-1, ' ', breaks, kReplace);
}

std::string yaml(const LineSet& set, const Numbers& numbers, std::optional<double> speed_mps) {
  std::string text = "ensonify: mission/1\n";
  for (const auto& [name, value] : numbers) text += fmt::format("# {}: {:.6g}\n", name, value);
  if (speed_mps) text += fmt::format("speed_mps: {:.6g}\n", *speed_mps);
  if (set.geodetic) text += "positions: geodetic\n";
  text += "steps:\n";
  for (const auto& line : set.lines) {
    text += line.name.empty() ? "  - line: [" : fmt::format("  - name: {}\n    line: [", quoted(line.name));
    for (std::size_t i = 0; i < line.places.size(); ++i) {
      text += fmt::format("{}[{}]", i == 0 ? "" : ", ", place_text(line.places[i], set.geodetic, ", "));
    }
    text += "]\n";
  }
  return text;
}

std::string csv(const LineSet& set) {
  std::string text = set.geodetic ? "line,name,latitude_deg,longitude_deg\n" : "line,name,east_m,north_m\n";
  for (std::size_t i = 0; i < set.lines.size(); ++i) {
    for (const auto& place : set.lines[i].places) {
      text += fmt::format("{},{},{}\n", i + 1, csv_cell(set.lines[i].name), place_text(place, set.geodetic, ","));
    }
  }
  return text;
}

nlohmann::ordered_json json_of(const Numbers& numbers) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [name, value] : numbers) json[name] = value;
  return json;
}

}  // namespace

std::string plan_text(const LineSet& set, const Numbers& numbers, std::optional<double> speed_mps, Format format) {
  if (format == Format::kYaml) return yaml(set, numbers, speed_mps);
  if (format == Format::kCsv) return csv(set);
  nlohmann::ordered_json json = json_of(numbers);
  json["positions"] = set.geodetic ? "geodetic" : "metres";
  json["lines"] = nlohmann::ordered_json::array();
  for (const auto& line : set.lines) json["lines"].push_back({{"name", line.name}, {"places", line.places}});
  return json.dump(2, ' ', false, kReplace) + "\n";
}

std::string numbers_text(const Numbers& numbers, Format format) {
  if (format == Format::kJson) return json_of(numbers).dump(2) + "\n";
  std::string text, values;
  for (const auto& [name, value] : numbers) {
    if (format == Format::kYaml) {
      text += fmt::format("{}: {:.6g}\n", name, value);
    } else {
      text += (text.empty() ? "" : ",") + name;
      values += fmt::format("{}{:.9g}", values.empty() ? "" : ",", value);
    }
  }
  return format == Format::kYaml ? text : text + "\n" + values + "\n";
}

}  // namespace ensonify::plan
