#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "components/config/config_error.h"
#include "components/config/parameters.h"
#include "messages/declarations.h"
#include "messages/sonar.h"

/// Operator's settings of a head: the fields of msg::SonarSettings but its stamp, and no list beside that one. A file
/// writes a field by its name, angles in degrees; a head declares its limits by the field's name.
namespace ensonify {

/// visit(name, unit, about, member) of each setting: a number or a text.
template <class Settings, class Visit>
void for_settings(Settings& settings, Visit&& visit) {
  msg::SonarSettings::fields(settings, [&](const char* name, const char* unit, const char* about, auto& member) {
    constexpr bool is_stamp = std::is_same_v<std::remove_cvref_t<decltype(member)>, std::int64_t>;
    if constexpr (!is_stamp) visit(name, unit, about, member);
  });
}

/// Whether 0 lets the head choose, where it can: what a range and a pulse length allow, as the message says.
inline bool zero_chooses(std::string_view field) { return field == "range_m" || field == "pulse_length_s"; }

/// A setting's key in a file and what stands in the file's unit.
struct SettingInFile {
  std::string key, unit;
  double si = 1.0;
};
SettingInFile setting_in_file(const std::string& name, const std::string& unit);

/// The settings as a list of parameters, all of which may be left out. `is_given(name)`: which were not.
template <class Settings, class Visit, class Given>
void setting_parameters(Settings& settings, Visit&& visit, const Given& is_given) {
  for_settings(settings, [&](const char* name, const char* unit, const char* about, auto& member) {
    const SettingInFile file = setting_in_file(name, unit);
    visit(file.key.c_str(), file.unit.c_str(), is_given(name) ? any() : computed(any()), about, member);
  });
}

/// Limits of a number, inclusive. Both the same: it is fixed.
struct SettingRange {
  double least = 0.0;
  double most = 0.0;
};
struct SettingLimit : SettingRange {
  bool chosen = false;                  // 0 is understood: the head chooses
  std::vector<std::string> words = {};  // of a text
};

/// Limits of a head's settings, by the message's field; a field that is not here is no setting of the head.
class SettingLimits {
 public:
  /// The shortest pulse that can be sent at a range in m, of a head whose range asks for a pulse; else nothing.
  std::function<double(double)> shortest_pulse_s;

  /// The limit of a field, to be set. A name that is no setting is a mistake of ours.
  SettingLimit& operator[](const std::string& field);
  const SettingLimit* find(const std::string& field) const;
  /// Takes in what another head, or channel of the same, allows.
  void widen(const SettingLimits& other);

  /// The same as a channel declares them.
  std::vector<msg::SettingDeclaration> declared() const;
  /// Limits that a head has declared, of all its channels.
  static SettingLimits of(const msg::HeadDeclaration& head);

 private:
  std::map<std::string, SettingLimit> limits_;
};

struct Mission;
/// Settings of a mission that a head does not take, each with its place. A head that has declared nothing is not
/// checked: it refuses at run time what it does not take.
std::vector<ConfigProblem> setting_problems(const Mission& mission,
                                            const std::map<std::string, msg::HeadDeclaration>& heads);

}  // namespace ensonify
