#include <algorithm>
#include <optional>
#include <set>

#include "components/formats/kmall/installation_text.h"
#include "components/formats/kmall/reader.h"
#include "components/runtime/tool.h"
#include "tools/info/summarise.h"

namespace ensonify::info {

using namespace formats::kmall;

namespace {

const char* about(const std::string& type) {
  static const std::map<std::string, const char*> kAbout = {{"#IIP", "installation"},
                                                            {"#IOP", "runtime settings"},
                                                            {"#SVP", "sound speed profile"},
                                                            {"#SVT", "sound speed at the transducer"},
                                                            {"#SPO", "position"},
                                                            {"#CPO", "position of a reference system"},
                                                            {"#SKM", "attitude and velocity"},
                                                            {"#SCL", "clock"},
                                                            {"#SDE", "depth of the sensor"},
                                                            {"#SHI", "height"},
                                                            {"#MRZ", "soundings"},
                                                            {"#MWC", "water column"},
                                                            {"#CHE", "heave of a water column"},
                                                            {"#SPE", "error ellipse of a position"}};
  const auto found = kAbout.find(type);
  return found == kAbout.end() ? "" : found->second;
}

std::vector<Mounting> mountings(const std::vector<InstallationGroup>& groups) {
  const std::map<std::string, std::string> quantities = {{"X", "x_m"},      {"Y", "y_m"},       {"Z", "z_m"},
                                                         {"R", "roll_deg"}, {"P", "pitch_deg"}, {"H", "heading_deg"}};
  std::vector<Mounting> found;
  for (const InstallationGroup& group : groups) {
    const bool mounted =
        group.name.starts_with("TRAI_") || group.name.starts_with("POSI_") || group.name.starts_with("ATTI_");
    Mounting mounting{group.name, {}};
    for (const auto& [key, value] : group.values) {
      if (const auto quantity = quantities.find(key); mounted && quantity != quantities.end()) {
        mounting.values.emplace_back(quantity->second, value);
      } else if (group.name == "EMXI" && key == "SWLZ") {
        mounting = {"water line", {{"z_m", value}}};
      }
    }
    if (!mounting.values.empty()) found.push_back(std::move(mounting));
  }
  return found;
}

/// Of a sensor's own samples the time is that of each.
std::int64_t time_of(const Motion::Sample& sample) {
  return std::int64_t{sample.time_s} * 1'000'000'000 + sample.time_ns;
}

std::string head_of(const PingPart& ping) { return "head " + std::to_string(ping.fan + 1); }

}  // namespace

Summary summarise_kmall(formats::Window& file) {
  Summary summary{.format = "Kongsberg .kmall", .bytes = file.size(), .depth_of = "soundings below the water line"};
  std::set<std::string> systems;
  std::string system_name;
  bool first = true;
  std::uint64_t parted = 0;

  Reader reader(file);
  while (const auto datagram = interrupted() ? std::nullopt : reader.next()) {
    const std::int64_t time_ns = datagram->unix_ns();
    systems.insert("EM " + std::to_string(datagram->header.sounder));
    Kind& kind = summary.kinds[datagram->type];
    kind.about = about(datagram->type);
    ++kind.count;
    summary.datagrams.add(time_ns);
    if (first && datagram->type != "#IIP")
      summary.notes.emplace_back("the first datagram is not the installation (#IIP)");
    first = false;

    if (const auto* installation = std::get_if<Installation>(&datagram->body);
        installation && summary.mountings.empty()) {
      const auto groups = installation_groups(installation->text);
      summary.mountings = mountings(groups);
      for (const auto& group : groups) {
        if (group.name == "SYSTEM") system_name = group.text;
      }
    } else if (const auto* position = std::get_if<Position>(&datagram->body)) {
      summary.positions.add(time_ns, position->sensor.sensor);
      summary.extent.add(position->latitude_deg, position->longitude_deg);
    } else if (const auto* motion = std::get_if<Motion>(&datagram->body)) {
      for (const auto& sample : motion->samples) summary.attitudes.add(time_of(sample), motion->sensor);
    } else if (const auto* ping = std::get_if<Soundings>(&datagram->body)) {
      if (ping->partition.parts != 1) ++parted;
      summary.pings[head_of(ping->ping)].add_modulo(ping->ping.ping, time_ns);
      for (const auto& sounding : ping->soundings) {
        if (sounding.detection == 0) summary.depth_m.add(double{sounding.z_m} - ping->pose.water_line_m);
      }
    } else if (const auto* column = std::get_if<WaterColumn>(&datagram->body); column && column->partition.part == 1) {
      summary.water_columns[head_of(column->ping)].add_modulo(column->ping.ping, time_ns);
    }
  }
  for (const std::string& system : systems) summary.system += (summary.system.empty() ? "" : ", ") + system;
  if (!system_name.empty()) summary.system += " (" + system_name + ")";
  if (parted > 0)
    summary.notes.push_back("pings in parts, which readers of files do not join: " + std::to_string(parted));
  if (summary.kinds.contains("#SPE"))
    summary.notes.emplace_back("#SPE is of revision J, at which some readers of revision I stop");
  note_unusable(summary);
  summary.faults = reader.faults();
  return summary;
}

}  // namespace ensonify::info
