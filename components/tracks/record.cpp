#include <cmath>
#include <optional>

#include "components/config/parse_yaml.h"
#include "components/config/scalar_text.h"
#include "components/record/reader.h"
#include "components/tracks/readers.h"
#include "kernels/base/frames/attitude.h"
#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/motion.h"
#include "messages/navigation.h"

namespace ensonify::tracks {
namespace {

/// Origin of the record's world, by the scenario that it holds; nothing where that has none of its own.
std::optional<frames::Geodetic> origin_of(const record::RecordReader& reader) {
  for (const record::Attachment& attachment : reader.attachments()) {
    if (attachment.name != "scenario.yaml") continue;
    const ConfigNode scenario = parse_config(attachment.data, attachment.name).root;
    const ConfigNode* site = scenario.find("site");
    const auto degrees = [&](const char* key) -> std::optional<double> {
      const ConfigNode* found = site != nullptr ? site->find(key) : nullptr;
      return found != nullptr && found->is_scalar() ? parse_number(found->scalar) : std::nullopt;
    };
    const auto latitude = degrees("latitude_deg"), longitude = degrees("longitude_deg");
    if (latitude && longitude) return frames::Geodetic{*latitude, *longitude};
  }
  return std::nullopt;
}

class PosesOfRecord {
 public:
  PosesOfRecord(const std::string& file, const std::string& topic) : file_(file), topic_(topic), reader_(file) {
    track_.file = file;
    if (const auto origin = origin_of(reader_)) projection_.emplace(*origin);
  }

  Track read() {
    const std::uint16_t channel = wanted();
    record::RecordedMessage message;
    while (reader_.next(message)) {
      if (message.channel->id != channel) continue;
      try {
        if (message.channel->type == msg::Pose::kType) take<msg::Pose>(message.payload);
        else take<msg::Estimate>(message.payload);
      } catch (const msg::DecodeError& error) {
        throw UserError(file_ + ": " + topic_ + " holds a damaged message: " + error.what());
      }
    }
    if (track_.fixes.empty() && track_.spots.empty()) throw UserError(file_ + ": " + topic_ + " has no message");
    return std::move(track_);
  }

 private:
  std::uint16_t wanted() {
    std::string allowed;
    std::vector<const record::Channel*> poses;
    const record::Channel* found = nullptr;
    for (const auto& [id, channel] : reader_.channels()) {
      const bool pose = channel.type == msg::Pose::kType;
      if (!pose && channel.type != msg::Estimate::kType) continue;
      allowed += (allowed.empty() ? "" : ", ") + channel.topic;
      if (pose) poses.push_back(&channel);
      if (channel.topic == topic_) found = &channel;
    }
    if (topic_.empty() && poses.size() == 1) found = poses.front();
    if (found == nullptr) {
      const std::string cause = !topic_.empty() ? "has no poses or estimates of topic " + topic_
                                : poses.empty() ? "has no topic of poses"
                                                : "has several topics of poses";
      throw UserError(file_ + ": " + cause + "; allowed as topic: " + (allowed.empty() ? "none is there" : allowed));
    }
    topic_ = found->topic;
    return found->id;
  }

  template <class Message>
  void take(const msg::Buffer& payload) {
    Message message;
    msg::from_value(msg::decode_inline(payload), message, "");
    take(message.stamp_ns, message.position_enu_m, message.enu_from_body);
  }

  void take(std::int64_t ns, const std::array<double, 3>& enu_m, const std::array<double, 4>& wxyz) {
    const std::string where = fmt::format("{}: {} at {:.3f} s", file_, topic_, 1e-9 * static_cast<double>(ns));
    const frames::Vec2 place(enu_m[0], enu_m[1]);
    const frames::Attitude attitude = frames::attitude_of(frames::quaternion_of(wxyz));
    if (!std::isfinite(enu_m[0] + enu_m[1] + enu_m[2] + attitude.heading_rad + attitude.pitch_rad + attitude.roll_rad))
      throw UserError(where + ": is not finite");
    if (projection_) append(track_.fixes, {ns, projection_->geodetic_of(place)}, where);
    else append(track_.spots, {ns, place}, where);
    const double convergence_rad = projection_ ? projection_->convergence_rad(place) : 0.0;
    append(track_.heading_rad, {ns, attitude.heading_rad + convergence_rad}, where);
    append(track_.pitch_rad, {ns, attitude.pitch_rad}, where);
    append(track_.roll_rad, {ns, attitude.roll_rad}, where);
    append(track_.height_m, {ns, enu_m[2]}, where);
  }

  const std::string& file_;
  std::string topic_;
  record::RecordReader reader_;
  std::optional<frames::LocalProjection> projection_;
  Track track_;
};

}  // namespace

Track read_record(const std::string& file, const std::string& topic) { return PosesOfRecord(file, topic).read(); }

}  // namespace ensonify::tracks
