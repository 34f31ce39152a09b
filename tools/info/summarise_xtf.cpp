#include <algorithm>
#include <optional>

#include "components/formats/text.h"
#include "components/formats/xtf/reader.h"
#include "components/formats/xtf/writer.h"
#include "components/runtime/tool.h"
#include "tools/info/summarise.h"

namespace ensonify::info {

using namespace formats::xtf;

namespace {

const char* about(std::uint8_t type) {
  switch (type) {
    case SonarPing::kType: return "sidescan ping";
    case MultibeamPing::kType: return "multibeam ping";
    case MultiTransmitPing::kType: return "multi-transducer ping";
    case Attitude::kType: return "attitude";
    case RawNavigation::kType: return "raw navigation";
    case Notes::kType: return "notes";
    case RawSerial::kType: return "raw serial text";
    case 42: return "navigation";
    default: return "";
  }
}

std::string number_text(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::vector<Mounting> mountings(const FileHeader& header) {
  std::vector<Mounting> found;
  for (std::size_t i = 0; i < std::min(header.channels_used(), header.channels.size()); ++i) {
    const ChannelInfo& channel = header.channels[i];
    found.push_back({"channel " + std::to_string(i) + " " + formats::unpadded(channel.name),
                     {{"x_m", number_text(channel.offset_m[0])},
                      {"y_m", number_text(channel.offset_m[1])},
                      {"z_m", number_text(channel.offset_m[2])},
                      {"frequency_khz", number_text(channel.frequency_khz)}}});
  }
  return found;
}

void add_ping(Summary& summary, const PingHeader& header, const char* head, std::int64_t time_ns, bool degrees) {
  summary.pings[head].add(header.ping, time_ns);
  summary.positions.add(time_ns);
  if (degrees) summary.extent.add(header.sensor_y, header.sensor_x);
  if (header.sensor_altitude_m > 0) summary.depth_m.add(header.sensor_altitude_m);
}

}  // namespace

Summary summarise_xtf(formats::Window& file) {
  Summary summary{.format = "Triton XTF", .bytes = file.size(), .depth_of = "seabed below the sensor"};
  Reader reader(file);
  const FileHeader& header = reader.header().value();
  summary.system = formats::unpadded(header.sonar) + ", written by " + formats::unpadded(header.program) + " " +
                   formats::unpadded(header.program_version);
  summary.mountings = mountings(header);
  const bool degrees = header.navigation_units == 3;
  if (!degrees)
    summary.notes.emplace_back("positions are not in degrees, and in which projection the file does not say");
  std::uint64_t undated = 0, too_long = 0;

  while (const auto packet = interrupted() ? std::nullopt : reader.next()) {
    Kind& kind = summary.kinds[std::to_string(packet->header.type)];
    kind.about = about(packet->header.type);
    ++kind.count;
    const auto time_ns = packet->unix_ns();
    if (!time_ns) {
      if (!std::holds_alternative<formats::Raw>(packet->body)) ++undated;
      continue;
    }
    summary.datagrams.add(*time_ns);
    if (const auto* ping = std::get_if<SonarPing>(&packet->body)) {
      add_ping(summary, ping->header, "sidescan", *time_ns, degrees);
      for (const Channel& channel : ping->channels) {
        if (channel.samples.size() > kMostSampleBytes) ++too_long;
      }
    } else if (const auto* multibeam = std::get_if<MultibeamPing>(&packet->body)) {
      add_ping(summary, multibeam->header, "multibeam", *time_ns, degrees);
    } else if (std::holds_alternative<Attitude>(packet->body)) {
      summary.attitudes.add(*time_ns);
    }
  }
  if (undated > 0) summary.notes.push_back("packets without a date: " + std::to_string(undated));
  if (too_long > 0) {
    summary.notes.push_back("channels of a ping with more than " + std::to_string(kMostSampleBytes) +
                            " bytes of samples, at which readers in wide use fail: " + std::to_string(too_long));
  }
  note_unusable(summary);
  summary.faults = reader.faults();
  return summary;
}

}  // namespace ensonify::info
