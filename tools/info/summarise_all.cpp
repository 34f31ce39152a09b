#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "components/formats/all/installation_text.h"
#include "components/formats/all/reader.h"
#include "components/runtime/tool.h"
#include "tools/info/summarise.h"

namespace ensonify::info {

using namespace formats::all;

namespace {

const char* about(char type) {
  switch (type) {
    case 'I': return "installation, start";
    case 'i': return "installation, stop";
    case 'R': return "runtime settings";
    case 'U': return "sound speed profile";
    case 'G': return "sound speed at the transducer";
    case 'P': return "position";
    case 'A': return "attitude";
    case 'n': return "attitude from the network";
    case 'C': return "clock";
    case 'h': return "height";
    case 'N': return "raw range and angle";
    case 'X': return "soundings";
    case 'Y': return "seabed image";
    case 'k': return "water column";
    case 'O': return "quality factor";
    case '0': return "processing unit id";
    case '1': return "processing unit status";
    case '3': return "extra parameters";
    default: return "";
  }
}

std::vector<Mounting> mountings(const std::string& text) {
  // Keys are a prefix and a letter or two; headings of motion sensors end in G.
  struct Sensor {
    const char* prefix;
    const char* name;
  };
  constexpr std::array<Sensor, 8> kSensors{{{"S1", "transducer 1"},
                                            {"S2", "transducer 2"},
                                            {"S3", "transducer 3"},
                                            {"P1", "position system 1"},
                                            {"P2", "position system 2"},
                                            {"P3", "position system 3"},
                                            {"MS", "motion sensor 1"},
                                            {"NS", "motion sensor 2"}}};
  constexpr std::array<std::pair<const char*, const char*>, 7> kQuantities{{{"X", "x_m"},
                                                                            {"Y", "y_m"},
                                                                            {"Z", "z_m"},
                                                                            {"R", "roll_deg"},
                                                                            {"P", "pitch_deg"},
                                                                            {"H", "heading_deg"},
                                                                            {"G", "heading_deg"}}};
  const auto values = installation_values(text);
  std::vector<Mounting> found;
  for (const Sensor& sensor : kSensors) {
    Mounting mounting{sensor.name, {}};
    for (const auto& [letter, quantity] : kQuantities) {
      const bool position_system = sensor.prefix[0] == 'P';
      if (position_system && letter[0] == 'G') continue;  // its datum
      for (const auto& [key, value] : values) {
        if (key == std::string(sensor.prefix) + letter) mounting.values.emplace_back(quantity, value);
      }
    }
    if (!mounting.values.empty()) found.push_back(std::move(mounting));
  }
  for (const auto& [key, value] : values) {
    if (key == "WLZ") found.push_back({"water line", {{"z_m", value}}});
  }
  return found;
}

/// Whether each ping of a head has N, X and Y. Numbers come again after 65536 pings: a ping is over when all three, or
/// one of them a second time, have come.
class Completeness {
 public:
  void add(char type, std::uint16_t serial, std::uint16_t number) {
    const std::size_t at = std::string("NXY").find(type);
    if (at == std::string::npos) return;
    ++counts_[at];
    const auto bit = static_cast<std::uint8_t>(1U << at);
    std::uint8_t& seen = seen_[{serial, number}];
    if ((seen & bit) != 0) {
      ++incomplete_;
      seen = 0;
    }
    seen |= bit;
    if (seen == 7) seen_.erase({serial, number});
  }
  void note_in(std::vector<std::string>& notes) const {
    const std::uint64_t incomplete = incomplete_ + seen_.size();
    if (incomplete == 0) return;
    notes.push_back("pings without all of N, X and Y: " + std::to_string(incomplete) + "; there are " +
                    std::to_string(counts_[0]) + " N, " + std::to_string(counts_[1]) + " X and " +
                    std::to_string(counts_[2]) + " Y");
  }

 private:
  std::map<std::pair<std::uint16_t, std::uint16_t>, std::uint8_t> seen_;  // by serial and number, bits of N, X, Y
  std::array<std::uint64_t, 3> counts_{};
  std::uint64_t incomplete_ = 0;
};

}  // namespace

Summary summarise_all(formats::Window& file) {
  Summary summary{.format = "Kongsberg .all", .bytes = file.size(), .depth_of = "soundings below the water line"};
  std::set<std::string> systems;
  Completeness completeness;
  bool first = true, ping_before_position = false;

  Reader reader(file);
  while (const auto datagram = interrupted() ? std::nullopt : reader.next()) {
    const std::int64_t time_ns = datagram->unix_ns();
    const std::string head = "serial " + std::to_string(datagram->header.serial);
    systems.insert("EM " + std::to_string(datagram->header.model) + " " + head);
    Kind& kind = summary.kinds[std::string(1, datagram->type)];
    kind.about = about(datagram->type);
    ++kind.count;
    summary.datagrams.add(time_ns);
    if (first && datagram->type != 'I') summary.notes.push_back("the first datagram is not the installation (I)");
    first = false;
    completeness.add(datagram->type, datagram->header.serial, datagram->header.counter);

    if (const auto* installation = std::get_if<Installation>(&datagram->body);
        installation && summary.mountings.empty()) {
      summary.mountings = mountings(installation->text);
    } else if (const auto* position = std::get_if<Position>(&datagram->body)) {
      summary.positions.add(time_ns, position->descriptor & 3);
      summary.extent.add(position->latitude_deg.value(), position->longitude_deg.value());
    } else if (const auto* attitude = std::get_if<Attitude>(&datagram->body)) {
      for (const auto& entry : attitude->entries)
        summary.attitudes.add(time_ns + entry.after_ms * std::int64_t{1'000'000}, attitude->descriptor >> 4U & 3);
    } else if (const auto* xyz = std::get_if<Soundings>(&datagram->body)) {
      summary.pings[head].add_modulo(datagram->header.counter, time_ns);
      ping_before_position = ping_before_position || summary.positions.count == 0;
      for (const auto& beam : xyz->beams) {
        if (beam.valid()) summary.depth_m.add(double{beam.z_m} + xyz->transducer_depth_m);
      }
    } else if (const auto* column = std::get_if<WaterColumn>(&datagram->body); column && column->datagram == 1) {
      summary.water_columns[head].add_modulo(datagram->header.counter, time_ns);
    }
  }
  for (const std::string& system : systems) summary.system += (summary.system.empty() ? "" : ", ") + system;
  completeness.note_in(summary.notes);
  if (ping_before_position) summary.notes.emplace_back("a ping comes before the first position");
  if (summary.positions.count < 3) summary.notes.emplace_back("fewer than three positions");
  note_unusable(summary);
  summary.faults = reader.faults();
  return summary;
}

}  // namespace ensonify::info
