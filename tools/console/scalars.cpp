#include "tools/console/scalars.h"

#include <cmath>
#include <limits>
#include <map>

#include "kernels/base/frames/attitude.h"
#include "messages/motion.h"
#include "messages/navigation.h"
#include "messages/schema.h"
#include "messages/soundings.h"

namespace ensonify::console {

namespace {

using Kind = msg::FieldInfo::Kind;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegree = 180.0 / M_PI;
constexpr std::size_t kMostElements = 4;  // of a fixed list: places, quaternions; no covariances

bool is_motion(std::string_view type) { return type == msg::Pose::kType || type == msg::Estimate::kType; }

std::string shown_unit(const std::string& unit) {
  if (unit == "rad") return "deg";
  if (unit == "rad/s") return "deg/s";
  return unit == "1" ? "" : unit;
}

double shown(double value, std::string_view field) {
  const bool angle = field.ends_with("_rad") || field.find("_rad.") != std::string_view::npos;
  const bool rate = field.ends_with("_radps") || field.find("_radps.") != std::string_view::npos;
  return angle || rate ? value * kDegree : value;
}

void add_fields(const msg::FieldInfo& field, const std::string& before, std::vector<msg::ConsoleScalar>& out) {
  const std::string path = before + field.name;
  if (field.name == "stamp_ns") return;
  if (field.kind == Kind::number || field.kind == Kind::integer || field.kind == Kind::boolean)
    out.push_back({path, shown_unit(field.unit), field.about});
  if (field.kind == Kind::map)
    for (const msg::FieldInfo& member : field.members) add_fields(member, path + ".", out);
  if (field.kind != Kind::fixed_list || field.length > kMostElements || field.members[0].kind != Kind::number) return;
  for (std::size_t i = 0; i < field.length; ++i)
    out.push_back({path + "." + std::to_string(i), shown_unit(field.unit), field.about});
}

bool has_ping(const msg::TypeInfo& info) {
  for (const msg::FieldInfo& field : info.fields)
    if (field.name == "ping") return true;
  return false;
}

std::vector<msg::ConsoleScalar> list_of(std::string_view type) {
  std::vector<msg::ConsoleScalar> list;
  const msg::TypeInfo* info = msg::find_type(type);
  if (info == nullptr) return list;
  if (is_motion(type)) {
    list.push_back({"heading_grid_rad", "deg", "heading, clockwise from grid north"});
    list.push_back({"roll_rad", "deg", "roll, positive starboard down"});
    list.push_back({"pitch_rad", "deg", "pitch, positive bow up"});
    list.push_back({"speed_mps", "m/s", "horizontal speed over ground"});
    list.push_back({"depth_m", "m", "depth of the body origin below chart datum"});
  }
  if (type == msg::Soundings::kType) {
    list.push_back({"depth_m", "m", "depth of the valid sounding nearest to the head's axis, below chart datum"});
    list.push_back({"valid_share", "", "share of the entries that are valid soundings"});
  }
  if (has_ping(*info)) list.push_back({"pings_per_s", "Hz", "pings per second of sim time"});
  for (const msg::FieldInfo& field : info->fields) add_fields(field, "", list);
  return list;
}

double number_at(const msg::Value& message, std::string_view path) {
  const msg::Value* found = message.at(path);
  double number = kNaN;
  if (found == nullptr) return kNaN;
  if (const bool* flag = found->as<bool>()) return *flag ? 1.0 : 0.0;
  return found->number(number) ? number : kNaN;
}

/// Of a pose or an estimate; NaN for a field that is none of these.
double motion_in(const msg::Value& message, std::string_view field) {
  if (field == "depth_m") return -number_at(message, "position_enu_m.2");
  if (field == "speed_mps")
    return std::hypot(number_at(message, "velocity_enu_mps.0"), number_at(message, "velocity_enu_mps.1"));
  std::array<double, 4> wxyz{};
  double length = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    wxyz[i] = number_at(message, "enu_from_body." + std::to_string(i));
    length += wxyz[i] * wxyz[i];
  }
  if (!(length > 0.5)) return kNaN;
  const frames::Attitude attitude = frames::attitude_of(frames::quaternion_of(wxyz));
  if (field == "heading_grid_rad") return attitude.heading_rad * kDegree;
  if (field == "roll_rad") return attitude.roll_rad * kDegree;
  return field == "pitch_rad" ? attitude.pitch_rad * kDegree : kNaN;
}

double sounding_in(const msg::Value& message, std::string_view field) {
  const auto array = [&](std::string_view key) {
    const msg::Value* found = message.find(key);
    return found == nullptr ? nullptr : found->as<msg::RawArray>();
  };
  const msg::RawArray* valid = array("valid");
  const msg::RawArray* angle = array("beam_angle_rad");
  const msg::RawArray* place = array("position_enu_m");
  if (valid == nullptr || valid->size() == 0) return kNaN;
  double count = 0.0, nearest = std::numeric_limits<double>::infinity(), depth_m = kNaN;
  for (std::size_t i = 0; i < valid->size(); ++i) {
    if (valid->number(i) != 1.0) continue;
    count += 1.0;
    if (angle == nullptr || place == nullptr || i >= angle->size() || 3 * i + 2 >= place->size()) continue;
    if (!(std::abs(angle->number(i)) < nearest)) continue;
    nearest = std::abs(angle->number(i));
    depth_m = -place->number(3 * i + 2);
  }
  if (field == "depth_m") return depth_m;
  return field == "valid_share" ? count / static_cast<double>(valid->size()) : kNaN;
}

/// Pings that were left out count: from one message to the next several numbers may have passed.
double pings_per_s(const msg::Value& message, LastPing& last) {
  const msg::Value* ping = message.find("ping");
  const msg::Value* stamp = message.find("stamp_ns");
  const auto* number = ping == nullptr ? nullptr : ping->as<std::int64_t>();
  const auto* stamp_ns = stamp == nullptr ? nullptr : stamp->as<std::int64_t>();
  if (number == nullptr || stamp_ns == nullptr) return kNaN;
  const LastPing before = last;
  last = {*number, *stamp_ns};
  if (!before.number || *stamp_ns <= before.stamp_ns || *number <= *before.number) return kNaN;
  return 1e9 * static_cast<double>(*number - *before.number) / static_cast<double>(*stamp_ns - before.stamp_ns);
}

}  // namespace

const std::vector<msg::ConsoleScalar>& scalars_of(std::string_view type) {
  static std::map<std::string, std::vector<msg::ConsoleScalar>, std::less<>> known;  // the console has one thread
  const auto found = known.find(type);
  if (found != known.end()) return found->second;
  return known.emplace(std::string(type), list_of(type)).first->second;
}

double scalar_in(const msg::Value& message, std::string_view type, std::string_view field, LastPing& last) {
  if (field == "pings_per_s") return pings_per_s(message, last);
  if (const msg::Value* valid = message.find("valid"); valid != nullptr && field != "valid")
    if (const bool* flag = valid->as<bool>(); flag != nullptr && !*flag) return kNaN;
  const bool derived = message.at(field) == nullptr;
  if (derived && is_motion(type)) return motion_in(message, field);
  if (derived && type == msg::Soundings::kType) return sounding_in(message, field);
  const double value = number_at(message, field);
  if (type == msg::VelocityLog::kType && field == "altitude_m" && value == 0.0) return kNaN;  // no beam has lock
  return shown(value, field);
}

}  // namespace ensonify::console
