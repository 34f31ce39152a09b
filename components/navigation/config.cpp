#include "components/navigation/config.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "components/config/data_paths.h"
#include "components/config/parse_yaml.h"
#include "components/config/read_parameters.h"
#include "components/sonar/environment.h"
#include "scenarios/world/world.h"

namespace ensonify {
namespace {

constexpr const char* kGrades = "components/navigation/grades";

frames::Vec3 vec3(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

std::string known_grades(const std::string& kind) {
  std::vector<std::string> names;
  for (const std::string& root : data_roots()) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(root + "/" + kGrades, error)) {
      const std::string name = entry.path().stem().string();
      if (name.starts_with(kind + "_")) names.push_back(name.substr(kind.size() + 1));
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Path of a grade's file; "": there is none, or it is a problem of `from`.
std::string grade_path(ConfigReader& from, const std::string& kind) {
  const ConfigNode* node = from.node("grade");
  if (node == nullptr || !node->is_scalar() || node->scalar.empty()) return "";
  std::string path;
  if (node->scalar.ends_with(".yaml")) {
    from.optional_path("grade", path);
    return path;
  }
  path = find_data(std::string(kGrades) + "/" + kind + "_" + node->scalar + ".yaml", {});
  if (path.empty()) {
    const std::string known = known_grades(kind);
    from.problem("grade", "\"" + node->scalar +
                              "\" is no grade of this instrument; allowed: " + (known.empty() ? "" : known + ", or ") +
                              "a file *.yaml (searched for " + kGrades + " in " + data_roots_text() + ")");
  }
  return path;
}

/// List of what a grade's file may have.
template <class Config>
struct OfGrade {
  Config& config;

  static void parameters(auto& self, auto&& visit) {
    Instrument::stamped_at(self.config.instrument, visit);
    Config::errors_list(self.config, visit);
  }
};

void check_spans(const ConfigReader& from, const char* key, const std::vector<double>& ends) {
  bool rising = true;
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) rising = rising && ends[i] < ends[i + 1];
  if (ends.size() % 2 != 0 || !rising) {
    from.problem(key, "is not [from, to, from, to, ...] with from before to, in seconds");
  }
}

/// Of what detects the bottom between two distances.
void check_ranges(const ConfigReader& from, double shortest_m, double longest_m) {
  if (shortest_m >= longest_m)
    from.problem("shortest_m", fmt::format("{} is not below longest_m {}; allowed: less", shortest_m, longest_m));
}

frames::Quaternion body_from(const std::array<double, 3>& roll_pitch_heading) {
  const auto& [roll, pitch, heading] = roll_pitch_heading;
  return frames::canonical(frames::enu_from_ned().conjugate() *
                           frames::enu_from_body(frames::Attitude{heading, pitch, roll}));
}

}  // namespace

void ParametersOf<sensors::InstrumentClock>::check(const ConfigReader& from, const sensors::InstrumentClock& clock) {
  check_spans(from, "unlocked_s", clock.unlocked_s);
}

template <class Config>
void InstrumentConfig<Config>::read_base(ConfigReader& from) {
  const std::string path = grade_path(from, Config::kSection);
  if (path.empty()) return;
  try {
    ConfigReader file = from.also(parse_config_file(path));
    OfGrade<Config> grade{static_cast<Config&>(*this)};
    read_parameters(file, grade);
  } catch (const ConfigError& error) {
    from.add(error);
  }
}

template <class Config>
void InstrumentConfig<Config>::check(const ConfigReader& from) const {
  check_spans(from, "outages_s", instrument.outages_s);
}

template struct InstrumentConfig<AltimeterConfig>;
template struct InstrumentConfig<CtdConfig>;
template struct InstrumentConfig<CurrentProfilerConfig>;
template struct InstrumentConfig<DepthConfig>;
template struct InstrumentConfig<DopplerLogConfig>;
template struct InstrumentConfig<GnssConfig>;
template struct InstrumentConfig<HeadingConfig>;
template struct InstrumentConfig<ImuConfig>;
template struct InstrumentConfig<MotionSensorConfig>;
template struct InstrumentConfig<SoundSpeedConfig>;
template struct InstrumentConfig<UsblConfig>;

void ImuConfig::check(const ConfigReader& from) const {
  InstrumentConfig::check(from);
  if (!instrument.outages_s.empty()) {
    from.problem("outages_s",
                 "without its readings there is no estimate, so an inertial unit may not fall out; "
                 "what aids it may: gnss, velocity_log, depth, heading");
  }
}

void DopplerLogConfig::check(const ConfigReader& from) const {
  InstrumentConfig::check(from);
  check_ranges(from, errors.shortest_m, errors.longest_m);
}

void AltimeterConfig::check(const ConfigReader& from) const {
  InstrumentConfig::check(from);
  check_ranges(from, errors.shortest_m, errors.longest_m);
}

void Instrument::mount(const frames::Vec3& centre_body_m) {
  actual = {centre_body_m + vec3(position_m), body_from(rotation_rad)};
  measured = {centre_body_m + vec3(measured_position_m.value_or(position_m)),
              body_from(measured_rotation_rad.value_or(rotation_rad))};
}

void Instruments::mount(const frames::Vec3& centre_body_m) {
  const auto mount = [&](auto& carried) {
    if (carried) carried->instrument.mount(centre_body_m);
  };
  std::apply([&](auto&... carried) { (mount(carried), ...); },
             std::tie(gnss, imu, motion_sensor, heading, velocity_log, depth, altimeter, sound_speed, ctd,
                      current_profiler, usbl));
  if (motion_sensor) motion_sensor->heave_point_body_m += centre_body_m;
  if (usbl_fixes) usbl_fixes->transponder_body_m += centre_body_m;
}

NavigationParameters NavigationParameters::read(ConfigReader& from) {
  NavigationParameters read;
  read_parameters(from, read);
  read.instruments.mount(vec3(read.centre_body_m));
  if (read.instruments.usbl_fixes && !read.instruments.imu) {
    from.problem("usbl_fixes", "they correct the filter of an inertial unit: list imu too");
  }
  return read;
}

NavigationConfig NavigationConfig::read(ConfigReader& from, const World& world, const std::string& process) {
  NavigationConfig config{NavigationParameters::read(from)};
  const Vehicle vehicle = own_vehicle(from, world, process, config.vehicle);  // the pose itself is wired
  config.seed = world.seed;
  config.process = process;
  config.heights = {world.vertical.tide, world.vertical.datums, world.current, vehicle.floats,
                    vehicle.start ? vehicle.start->position_enu_m.z() : -world.mission.depth_m};
  if (!world.site.origin_from_raster) config.origin = world.site.origin;
  config.water = {true_profile(world), true_column(world.water), world.water.sound_speed_law};
  return config;
}

}  // namespace ensonify
