#include "components/survey_files/vessel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "components/errors/exit_error.h"
#include "components/formats/all/installation_text.h"
#include "components/formats/kmall/installation_text.h"

namespace ensonify::survey_files {
namespace {

using formats::kmall::InstallationGroup;
using frames::Vec3;

constexpr double kDegree = std::numbers::pi / 180.0;

/// The groups of a file's text by name.
class Groups {
 public:
  Groups(const std::string& file, std::string_view text)
      : file_(file), groups_(formats::kmall::installation_groups(text)) {}

  const InstallationGroup* find(const std::string& name) const {
    const auto found = std::ranges::find(groups_, name, &InstallationGroup::name);
    return found == groups_.end() ? nullptr : &*found;
  }

  std::optional<double> number(const InstallationGroup& of, const std::string& key) const {
    for (const auto& [name, value] : of.values) {
      if (name != key) continue;
      char* end = nullptr;
      const double number = std::strtod(value.c_str(), &end);
      if (end == value.c_str() || *end != '\0' || !std::isfinite(number))
        throw UserError(fmt::format("{}: installation {}:{}={} is no number", file_, of.name, key, value));
      return number;
    }
    return std::nullopt;
  }

  double must(const InstallationGroup& of, const std::string& key) const {
    const auto value = number(of, key);
    if (!value) throw UserError(fmt::format("{}: installation {} has no {}", file_, of.name, key));
    return *value;
  }

  Vec3 place(const InstallationGroup& of, const std::string& before) const {
    return {must(of, before + "X"), must(of, before + "Y"), must(of, before + "Z")};
  }

  frames::Quaternion turn(const InstallationGroup& of) const {
    return turn_of(must(of, "R"), must(of, "P"), must(of, "H"));
  }

  /// With the phase centres that it has of these names.
  Array array(const InstallationGroup& of, std::initializer_list<const char*> centres) const {
    Array array{{place(of, ""), turn(of)}, {}};
    for (const char* name : centres) {
      if (number(of, std::string(name) + "X")) array.phase_centre_m.push_back(place(of, name));
    }
    if (array.phase_centre_m.empty()) array.phase_centre_m.emplace_back(0.0, 0.0, 0.0);
    return array;
  }

 private:
  const std::string& file_;
  std::vector<InstallationGroup> groups_;
};

/// KEY=value of a .all file's text.
class Values {
 public:
  Values(const std::string& file, std::string_view text)
      : file_(file), values_(formats::all::installation_values(text)) {}

  std::optional<double> number(const std::string& key) const {
    const auto found = std::ranges::find(values_, key, &std::pair<std::string, std::string>::first);
    if (found == values_.end()) return std::nullopt;
    char* end = nullptr;
    const double number = std::strtod(found->second.c_str(), &end);
    if (end == found->second.c_str() || *end != '\0' || !std::isfinite(number))
      throw UserError(fmt::format("{}: installation {}={} is no number", file_, key, found->second));
    return number;
  }

  double must(const std::string& key) const {
    const auto value = number(key);
    if (!value) throw UserError(fmt::format("{}: installation has no {}", file_, key));
    return *value;
  }

  Array array(const std::string& name, std::vector<Vec3> phase_centres_m) const {
    const frames::Quaternion turn = turn_of(must(name + "R"), must(name + "P"), must(name + "H"));
    return {{{must(name + "X"), must(name + "Y"), must(name + "Z")}, turn}, std::move(phase_centres_m)};
  }

 private:
  const std::string& file_;
  std::vector<std::pair<std::string, std::string>> values_;
};

/// Phase centres from the installed point that readers add: of the port, centre and starboard array of a transmitter,
/// and of the receiver.
struct PhaseCentres {
  std::vector<Vec3> transmit_m{Vec3::Zero()}, receive_m{Vec3::Zero()};
};
PhaseCentres phase_centres_of(std::uint16_t model) {
  if (model == 2040)
    return {{{0.0, -0.0554, -0.012}, {0.0, 0.0131, -0.006}, {0.0, 0.0554, -0.012}}, {{0.011, 0.0, -0.006}}};
  if (model == 2045) return {{{0.0038, 0.040, -0.006}}, {{-0.0455, 0.0, -0.006}}};
  return {};
}

void check_arrays(const std::string& file, const Vessel& vessel) {
  for (const Array& transmitter : vessel.transmitters) {
    for (const Array& receiver : vessel.receivers) {
      const Vec3 along = transmitter.installed.body_from_head * Vec3::UnitX(),
                 across = receiver.installed.body_from_head * Vec3::UnitY();
      if (std::abs(along.dot(across)) > 0.7)
        throw UserError(file + ": its transmitter and receiver lie nearly along each other; their beams do not cross");
    }
  }
}

}  // namespace

frames::Quaternion turn_of(double roll_deg, double pitch_deg, double heading_deg) {
  const frames::Attitude attitude{
      .heading_rad = heading_deg * kDegree, .pitch_rad = pitch_deg * kDegree, .roll_rad = roll_deg * kDegree};
  return frames::enu_from_ned().conjugate() * frames::enu_from_body(attitude);
}

frames::Mounting Array::mounting(std::size_t phase_centre) const {
  const Vec3& centre_m = phase_centre_m[std::min(phase_centre, phase_centre_m.size() - 1)];
  return {installed.position_body_m + installed.body_from_head * centre_m, installed.body_from_head};
}

Vessel vessel_of_kmall(const std::string& file, std::string_view text) {
  const Groups groups(file, text);
  Vessel vessel;
  for (int i = 1; i <= 2; ++i) {
    if (const auto* both = groups.find(fmt::format("TRAI_HD{}", i))) {  // a portable head has both arrays
      vessel.transmitters.push_back(groups.array(*both, {"IP", "IC", "IS"}));
      vessel.receivers.push_back(groups.array(*both, {"IR"}));
    }
    if (const auto* transmitter = groups.find(fmt::format("TRAI_TX{}", i)))
      vessel.transmitters.push_back(groups.array(*transmitter, {"IP", "IC", "IS"}));
    if (const auto* receiver = groups.find(fmt::format("TRAI_RX{}", i)))
      vessel.receivers.push_back(groups.array(*receiver, {"IR"}));
  }
  if (vessel.transmitters.empty() || vessel.receivers.empty())
    throw UserError(file + ": its installation names no transmitter and receiver (TRAI_TX1 and TRAI_RX1, or TRAI_HD1)");
  check_arrays(file, vessel);
  const auto is_active = [](const InstallationGroup* of) {
    return of != nullptr && of->text.find("U=ACTIVE") != std::string::npos;
  };
  const auto* sensor = groups.find("ATTI_1");
  if (!is_active(sensor) && is_active(groups.find("ATTI_2"))) {
    vessel.motion_sensor = 1;
    sensor = groups.find("ATTI_2");
  }
  if (sensor == nullptr) throw UserError(file + ": its installation names no motion sensor (ATTI_1)");
  vessel.body_from_motion_sensor = groups.turn(*sensor);
  const auto* water_line = groups.find("EMXI");
  if (water_line == nullptr) throw UserError(file + ": its installation names no water line (EMXI:SWLZ)");
  vessel.water_line_m = groups.must(*water_line, "SWLZ");
  return vessel;
}

VesselOfAll vessel_of_all(const std::string& file, std::string_view text, std::uint16_t model) {
  const Values values(file, text);
  const double heads = values.number("STC").value_or(1.0);
  if (heads == 2.0 || heads == 4.0)
    throw UserError(fmt::format("{}: has two transmitters (STC={}); allowed is one", file, heads));
  const bool two_receivers = heads == 3.0;
  const PhaseCentres centres = phase_centres_of(model);
  VesselOfAll vessel;
  vessel.transmitters.push_back(values.array("S1", centres.transmit_m));
  const bool own_receiver = values.number("S2X").has_value();  // else transmitter and receiver are one head
  vessel.receivers.push_back(values.array(own_receiver ? "S2" : "S1", centres.receive_m));
  if (two_receivers) vessel.receivers.push_back(values.array("S3", centres.receive_m));
  check_arrays(file, vessel);
  vessel.water_line_m = values.must("WLZ");
  const std::string antenna = fmt::format("P{:.0f}", values.number("APS").value_or(0.0) + 1.0);
  vessel.origin_m = {values.must(antenna + "X"), values.must(antenna + "Y"), vessel.water_line_m};
  vessel.heave_at_transmitter = model != 2040 && model != 2045;
  return vessel;
}

}  // namespace ensonify::survey_files
