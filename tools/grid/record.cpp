#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "components/errors/exit_error.h"
#include "components/record/reader.h"
#include "components/record/record_path.h"
#include "components/runtime/tool.h"
#include "messages/codec.h"
#include "messages/motion.h"
#include "messages/soundings.h"
#include "messages/terrain.h"
#include "tools/grid/input.h"

namespace ensonify::grid_tool {
namespace {

constexpr double kOf95 = 1.959964;  // standard deviations within which 95 % of a normal variable lie

template <msg::HasFields M>
M decoded(const record::RecordedMessage& message) {
  M content;
  msg::from_value(msg::decode_inline(message.payload), content, "");
  return content;
}

/// Sim times in which a mission does what is wanted: all but run-ins, run-outs and turns.
class Working {
 public:
  void see(const std::string& topic, const msg::MissionState& mission) {
    Mission& of = missions_[topic];
    const bool works = kWorking.contains(mission.state);
    if (works && !of.works) of.spans.push_back({mission.stamp_ns, std::numeric_limits<std::int64_t>::max()});
    if (!works && of.works) of.spans.back().second = mission.stamp_ns;
    of.works = works;
  }
  bool stated() const {
    return std::any_of(missions_.begin(), missions_.end(), [](const auto& one) { return !one.second.spans.empty(); });
  }
  bool at(std::int64_t stamp_ns) const {
    return std::any_of(missions_.begin(), missions_.end(), [&](const auto& one) {
      return std::any_of(one.second.spans.begin(), one.second.spans.end(),
                         [&](const auto& span) { return stamp_ns >= span.first && stamp_ns < span.second; });
    });
  }

 private:
  inline static const std::set<std::string> kWorking = {"on_line", "pass", "keep", "orbit"};
  struct Mission {
    bool works = false;
    std::vector<std::pair<std::int64_t, std::int64_t>> spans;  // ns
  };
  std::map<std::string, Mission> missions_;  // by topic
};

class Record : public SoundingFile {
 public:
  Record(const std::string& path, const ReadOptions& options) : file_(record::record_path(path)), options_(options) {
    if (options.tide)
      throw UserError("--tide " + options.tide->file() + ": " + file_ +
                      " has heights from chart datum already; allowed: files whose depths count from the water line");
    facts_.file = file_;
    facts_.datum = "chart datum of the scenario";
    look_through();
  }

  const FileFacts& facts() const override { return facts_; }

  void read(const TakeSounding& take) override {
    record::RecordReader reader(file_);
    record::RecordedMessage message;
    while (reader.next(message) && !interrupted()) {
      if (!topics_.contains(message.channel->topic)) continue;
      const auto soundings = decoded<msg::Soundings>(message);
      check(soundings, message);
      if (!options_.turns && working_.stated() && !working_.at(soundings.stamp_ns)) continue;
      for (std::size_t i = 0; i < soundings.valid.size(); ++i) {
        if (soundings.valid[i] == 0) continue;
        const double sd_m = i < soundings.tvu_m.size() ? static_cast<double>(soundings.tvu_m[i]) / kOf95
                                                       : std::numeric_limits<double>::quiet_NaN();
        take({soundings.position_enu_m(i, 0), soundings.position_enu_m(i, 1), -soundings.position_enu_m(i, 2), sd_m});
      }
    }
  }

 private:
  /// Arrays of one message may disagree: a record is a file like any other.
  void check(const msg::Soundings& soundings, const record::RecordedMessage& message) const {
    const std::size_t beams = soundings.valid.size();
    const bool fits = soundings.position_enu_m.shape() == std::vector<std::size_t>{beams, 3} &&
                      (soundings.tvu_m.empty() || soundings.tvu_m.size() == beams);
    if (!fits)
      throw UserError(
          fmt::format("{}: message {} on {}: its arrays differ in length; allowed: a position, and a "
                      "tvu_m or none, for each of its {} entries",
                      file_, message.seq, message.channel->topic, beams));
  }

  /// A first reading: what a record says behind the soundings that it is about, and topics that begin late.
  void look_through() {
    record::RecordReader reader(file_);
    record::RecordedMessage message;
    while (reader.next(message) && !interrupted()) {
      if (message.channel->type == msg::MissionState::kType)
        working_.see(message.channel->topic, decoded<msg::MissionState>(message));
      if (message.channel->type == msg::Chart::kType && !facts_.origin) {
        const auto chart = decoded<msg::Chart>(message);
        if (!(std::abs(chart.origin_latitude_deg) < 90.0 && std::abs(chart.origin_longitude_deg) <= 180.0))
          throw UserError(
              fmt::format("{}: its chart/1 has the origin {}, {}; allowed: degrees north and east of a place "
                          "on the earth",
                          file_, chart.origin_latitude_deg, chart.origin_longitude_deg));
        facts_.origin = {chart.origin_latitude_deg, chart.origin_longitude_deg};
      }
    }
    if (!reader.truncated().empty()) fmt::print(stderr, "ensonify grid: {}: {}\n", file_, reader.truncated());
    choose_topics(reader);
  }

  void choose_topics(const record::RecordReader& reader) {
    std::set<std::string> there;
    for (const auto& [id, channel] : reader.channels()) {
      if (channel.type == msg::Soundings::kType) there.insert(channel.topic);
    }
    if (there.empty()) throw UserError(file_ + ": holds no soundings (no topic of type soundings/1 was recorded)");
    for (const std::string& wanted : options_.topics) {
      if (!there.contains(wanted))
        throw UserError(fmt::format("{}: has no soundings on {}; there are {}", file_, wanted, fmt::join(there, ", ")));
    }
    topics_ = options_.topics.empty() ? there : std::set(options_.topics.begin(), options_.topics.end());
  }

  std::string file_;
  ReadOptions options_;
  FileFacts facts_;
  std::set<std::string> topics_;
  Working working_;
};

}  // namespace

std::unique_ptr<SoundingFile> open_record(const std::string& file, const ReadOptions& options) {
  return std::make_unique<Record>(file, options);
}

}  // namespace ensonify::grid_tool
