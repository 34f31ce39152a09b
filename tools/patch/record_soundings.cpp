#include "tools/patch/record_soundings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "components/errors/exit_error.h"
#include "components/record/reader.h"
#include "kernels/base/frames/pose.h"
#include "messages/codec.h"
#include "messages/navigation.h"
#include "messages/soundings.h"

namespace ensonify::patch_tool {
namespace {

using boresight::Sounding;
using frames::Vec3;

template <msg::HasFields M>
M decoded(const record::RecordedMessage& message) {
  M content;
  msg::from_value(msg::decode_inline(message.payload), content, "");
  return content;
}

/// The topic that is asked for, or the only one of its type.
std::string chosen(const record::RecordReader& record, const char* type, const std::string& asked,
                   const std::filesystem::path& file) {
  std::vector<std::string> there;
  for (const auto& [id, channel] : record.channels()) {
    if (channel.type == type) there.push_back(channel.topic);
  }
  if (asked.empty() && there.size() == 1) return there[0];
  if (!asked.empty() && std::find(there.begin(), there.end(), asked) != there.end()) return asked;
  throw UserError(fmt::format("{}: {} of type {}; there {} {}", file.string(),
                              asked.empty() ? std::string("name the topic") : "has no topic " + asked, type,
                              there.size() == 1 ? "is" : "are",
                              there.empty() ? "none" : fmt::format("{}", fmt::join(there, ", "))));
}

/// The navigation estimate over time.
class Track {
 public:
  void add(const msg::Estimate& e) {
    times_s_.push_back(static_cast<double>(e.stamp_ns) * 1e-9);
    poses_.push_back({Vec3(e.position_enu_m.data()), frames::quaternion_of(e.enu_from_body)});
  }

  bool covers(double t_s) const { return times_s_.size() > 1 && t_s >= times_s_.front() && t_s <= times_s_.back(); }

  frames::Pose at(double t_s) const {
    const auto after =
        std::clamp<std::ptrdiff_t>(std::lower_bound(times_s_.begin(), times_s_.end(), t_s) - times_s_.begin(), 1,
                                   static_cast<std::ptrdiff_t>(times_s_.size()) - 1);
    const auto b = static_cast<std::size_t>(after), a = b - 1;
    return frames::interpolate(poses_[a], poses_[b], (t_s - times_s_[a]) / (times_s_[b] - times_s_[a]));
  }

 private:
  std::vector<double> times_s_;
  std::vector<frames::Pose> poses_;
};

Stated stated_by(const msg::Estimate& e) {
  const auto diagonal = [](const auto& covariance) { return Vec3(covariance[0], covariance[4], covariance[8]); };
  const Vec3 position = diagonal(e.position_covariance_enu_m2), rotation = diagonal(e.rotation_covariance_enu_rad2);
  const double level = (rotation.x() + rotation.y()) / 2.0;  // about east and north: both roll and pitch
  return {static_cast<double>(e.stamp_ns) * 1e-9, position, Vec3(level, level, rotation.z())};
}

/// Accepted soundings of a ping. Attitude, velocity and turning come later, from the track.
void add(const msg::Soundings& ping, std::vector<Sounding>& soundings) {
  const auto place = ping.position_enu_m.flat();
  const auto head = ping.track.pose_position_enu_m.flat();
  if (head.size() < 3) return;
  for (std::size_t i = 0; i < ping.valid.size(); ++i) {
    if (ping.valid.flat()[i] == 0) continue;
    soundings.push_back({.time_s = static_cast<double>(ping.stamp_ns) * 1e-9,
                         .place_enu_m = Vec3(place[3 * i], place[3 * i + 1], place[3 * i + 2]),
                         .head_enu_m = Vec3(head[0], head[1], head[2])});
  }
}

/// How the vehicle went and turned about this time, over 0.2 s: longer than the noise of attitudes, shorter than waves.
void add_motion(Sounding& s, const Track& track) {
  constexpr double kHalf = 0.1;
  const frames::Pose before = track.at(s.time_s - kHalf), after = track.at(s.time_s + kHalf);
  s.enu_from_body = track.at(s.time_s).enu_from_body;
  s.velocity_enu_mps = (after.position_enu_m - before.position_enu_m) / (2.0 * kHalf);
  const frames::Quaternion turn = after.enu_from_body * before.enu_from_body.conjugate();
  s.rate_enu_radps = (turn.w() < 0.0 ? -1.0 : 1.0) * turn.vec() / kHalf;  // a small turn is twice its vector part
}

}  // namespace

Stated mean_stated(const std::vector<Stated>& stated, double from_s, double to_s) {
  Stated mean{.time_s = (from_s + to_s) / 2.0};
  double count = 0.0;
  for (const Stated& s : stated) {
    if (s.time_s < from_s || s.time_s > to_s) continue;
    ++count;
    mean.position_variance_m2 += (s.position_variance_m2 - mean.position_variance_m2) / count;
    mean.rotation_variance_rad2 += (s.rotation_variance_rad2 - mean.rotation_variance_rad2) / count;
  }
  return mean;
}

void thin(RecordInput& input, std::size_t most) {
  input.accepted = input.soundings.size();
  const std::size_t step = input.accepted / std::max<std::size_t>(1, most) + 1;
  for (std::size_t i = 0; i * step < input.accepted; ++i) input.soundings[i] = input.soundings[i * step];
  input.soundings.resize((input.accepted + step - 1) / step);
}

RecordInput read_soundings(const std::filesystem::path& file, const Reading& reading) {
  record::RecordReader record(file);
  RecordInput input;
  input.soundings_topic = chosen(record, msg::Soundings::kType, reading.soundings, file);
  input.estimate_topic = chosen(record, msg::Estimate::kType, reading.estimate, file);
  Track track;
  record::RecordedMessage message;
  while (record.next(message)) {
    if (message.channel->topic == input.soundings_topic) add(decoded<msg::Soundings>(message), input.soundings);
    if (message.channel->topic == input.estimate_topic) {
      const auto estimate = decoded<msg::Estimate>(message);
      track.add(estimate);
      input.stated.push_back(stated_by(estimate));
    }
  }
  std::erase_if(input.soundings,
                [&](const Sounding& s) { return !track.covers(s.time_s) || !s.place_enu_m.allFinite(); });
  thin(input, reading.most);
  for (Sounding& s : input.soundings) add_motion(s, track);
  return input;
}

}  // namespace ensonify::patch_tool
