#include "components/navigation/instrument_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "components/config/config_reader.h"
#include "components/config/data_paths.h"

namespace ensonify {
namespace {

constexpr FileUnit kPerHour{kDegrees.si / 3600.0};    // of a gyro's bias, deg/h
constexpr FileUnit kPerRootHour{kDegrees.si / 60.0};  // of its random walk, deg/sqrt(h)
constexpr FileUnit kMicroG{9.80665e-6};               // of an accelerometer's bias, and of its noise per sqrt(Hz)
constexpr FileUnit kPpm{1e-6};
constexpr FileUnit kPercent{0.01};
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

/// Reads when an instrument stamps, and its errors: first from the file of its grade, then from the section itself.
void read_graded(ConfigReader& from, const std::string& kind, Instrument& instrument,
                 const std::function<void(ConfigReader&)>& read_errors) {
  const auto read = [&](ConfigReader& section) {
    section.optional_choice("stamped_at", instrument.stamping,
                            {{"measurement", sensors::Stamping::kMeasurement}, {"output", sensors::Stamping::kOutput}});
    read_errors(section);
  };
  std::string grade, path;
  from.optional("grade", grade);
  if (grade.ends_with(".yaml")) {
    from.optional_path("grade", path);
  } else if (!grade.empty()) {
    path = find_data(std::string(kGrades) + "/" + kind + "_" + grade + ".yaml", {});
    if (path.empty()) {
      const std::string known = known_grades(kind);
      from.problem("grade", "\"" + grade + "\" is no grade of this instrument; allowed: " +
                                (known.empty() ? "" : known + ", or ") + "a file *.yaml (searched for " + kGrades +
                                " in " + data_roots_text() + ")");
    }
  }
  if (!path.empty()) {
    try {
      ConfigReader file = from.also(parse_config_file(path));
      read(file);
    } catch (const ConfigError& error) {
      from.add(error);
    }
  }
  read(from);
}

/// Of what detects the bottom between two distances.
void check_ranges(const ConfigReader& from, double shortest_m, double longest_m) {
  if (shortest_m >= longest_m)
    from.problem("shortest_m", fmt::format("{} is not below longest_m {}; allowed: less", shortest_m, longest_m));
}

std::vector<sensors::Span> read_spans(ConfigReader& from, const char* key) {
  std::vector<double> ends;
  from.optional(key, ends, 0, 1e9);
  std::vector<sensors::Span> spans;
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) spans.push_back({ends[i], ends[i + 1]});
  const bool rising = std::all_of(spans.begin(), spans.end(), [](const auto& s) { return s.from_s < s.to_s; });
  if (ends.size() % 2 != 0 || !rising) {
    from.problem(key, "is not [from, to, from, to, ...] with from before to, in seconds");
  }
  return spans;
}

void read_clock(ConfigReader from, sensors::InstrumentClock& clock) {
  from.optional("offset_s", clock.offset_s, -86400, 86400);
  from.optional("drift_ppm", clock.drift_ppm, -1000, 1000);
  from.optional("locked", clock.locked);
  from.optional("residual_s", clock.residual_s, -1, 1);
  clock.unlocked = read_spans(from, "unlocked_s");
}

frames::Quaternion body_from(const std::array<double, 3>& roll_pitch_heading) {
  const auto& [roll, pitch, heading] = roll_pitch_heading;
  return frames::canonical(frames::enu_from_ned().conjugate() *
                           frames::enu_from_body(frames::Attitude{heading, pitch, roll}));
}

Instrument read_instrument(ConfigReader& from, const frames::Vec3& centre_body_m, double usual_rate_hz) {
  Instrument instrument;
  instrument.rate_hz = usual_rate_hz;
  from.optional("rate_hz", instrument.rate_hz, 0.01, 1000);
  from.optional("latency_s", instrument.latency_s, 0, 10);
  if (const auto clock = from.optional_section("clock")) read_clock(*clock, instrument.clock);
  instrument.outages = read_spans(from, "outages_s");

  std::array<double, 3> place{}, turn{};
  from.optional("position_m", place, -500, 500);
  from.optional("rotation_deg", turn, -180, 180, kDegrees);  // roll, pitch, heading
  instrument.actual = {centre_body_m + vec3(place), body_from(turn)};
  from.optional("measured_position_m", place, -500, 500);  // left out: as it is
  from.optional("measured_rotation_deg", turn, -180, 180, kDegrees);
  instrument.measured = {centre_body_m + vec3(place), body_from(turn)};
  return instrument;
}

void read_scalar(const std::optional<ConfigReader>& section, sensors::ScalarErrors& errors, const std::string& unit,
                 double most, FileUnit si = kSi) {
  if (!section) return;
  ConfigReader from = *section;
  from.optional("bias_" + unit, errors.bias, -most, most, si);
  from.optional("bias_sigma_" + unit, errors.bias_sigma, 0, most, si);
  from.optional("scale_percent", errors.scale, 0, 100, kPercent);
  from.optional("wander_" + unit, errors.wander, 0, most, si);
  from.optional("wander_time_s", errors.wander_s, 0.1, 1e6);
  from.optional("white_" + unit, errors.white, 0, most, si);
  from.optional("resolution_" + unit, errors.resolution, 0, most, si);
  from.optional("lag_s", errors.lag_s, 0, 100);
}

void read_fix(ConfigReader from, sensors::FixErrors& errors) {
  from.optional("horizontal_m", errors.horizontal_m, 0, 100);
  from.optional("vertical_m", errors.vertical_m, 0, 100);
  from.optional("wander_horizontal_m", errors.wander_horizontal_m, 0, 100);
  from.optional("wander_vertical_m", errors.wander_vertical_m, 0, 100);
}

void read_gnss(ConfigReader& from, sensors::GnssErrors& errors) {
  using Quality = sensors::FixQuality;
  const ConfigReader::Choices<Quality> qualities{{"single", Quality::kSingle},
                                                 {"differential", Quality::kDifferential},
                                                 {"rtk_float", Quality::kRtkFloat},
                                                 {"rtk_fixed", Quality::kRtkFixed}};
  from.optional_choice("quality", errors.best, qualities);
  from.optional_choice("degraded_quality", errors.while_degraded, qualities);
  if (const auto fix = from.optional_section("fix")) read_fix(*fix, errors.fix);
  if (const auto fix = from.optional_section("degraded_fix")) read_fix(*fix, errors.degraded);
  from.optional("wander_time_s", errors.wander_s, 1, 1e6);
  from.optional("first_fix_s", errors.first_fix_s, 0, 3600);
  from.optional("converge_s", errors.converge_s, 0, 36000);
  from.optional("hdop", errors.hdop, 0.5, 50);
  from.optional("hdop_wander", errors.hdop_wander, 0, 1);
  from.optional("washed_depth_m", errors.washed_depth_m, -10, 10);
}

void read_gyro(ConfigReader from, inertial::TriadErrors& gyro) {
  from.optional("bias_degph", gyro.turn_on_bias, 0, 1e5, kPerHour);
  from.optional("stability_degph", gyro.bias_sigma, 0, 1e5, kPerHour);
  from.optional("stability_time_s", gyro.bias_time_s, 1, 1e6);
  from.optional("random_walk_deg_per_sqrt_h", gyro.random_walk, 0, 100, kPerRootHour);
  from.optional("rate_random_walk_radps_per_sqrt_s", gyro.rate_random_walk, 0, 1);
  from.optional("scale_ppm", gyro.scale_factor, 0, 1e5, kPpm);
  from.optional("misalignment_deg", gyro.misalignment_rad, 0, 5, kDegrees);
  from.optional("quantum_deg", gyro.quantum, 0, 1, kDegrees);
}

void read_accelerometer(ConfigReader from, inertial::TriadErrors& accelerometer) {
  from.optional("bias_ug", accelerometer.turn_on_bias, 0, 1e6, kMicroG);
  from.optional("stability_ug", accelerometer.bias_sigma, 0, 1e6, kMicroG);
  from.optional("stability_time_s", accelerometer.bias_time_s, 1, 1e6);
  from.optional("random_walk_ug_per_sqrt_hz", accelerometer.random_walk, 0, 1e5, kMicroG);
  from.optional("rate_random_walk_mps2_per_sqrt_s", accelerometer.rate_random_walk, 0, 1);
  from.optional("scale_ppm", accelerometer.scale_factor, 0, 1e5, kPpm);
  from.optional("misalignment_deg", accelerometer.misalignment_rad, 0, 5, kDegrees);
  from.optional("quantum_mps", accelerometer.quantum, 0, 1);
}

void read_imu(ConfigReader& from, ImuConfig& imu) {
  if (const auto gyro = from.optional_section("gyro")) read_gyro(*gyro, imu.errors.gyro);
  if (const auto a = from.optional_section("accelerometer")) read_accelerometer(*a, imu.errors.accelerometer);
  if (const auto section = from.optional_section("alignment")) {
    ConfigReader alignment = *section;
    alignment.optional("position_m", imu.alignment.position_m, 0, 1e5);
    alignment.optional("height_m", imu.alignment.height_m, 0, 1e4);
    alignment.optional("velocity_mps", imu.alignment.velocity_mps, 0, 10);
    alignment.optional("tilt_deg", imu.alignment.tilt_rad, 0, 10, kDegrees);
    alignment.optional("heading_deg", imu.alignment.heading_rad, 0, 30, kDegrees);
  }
}

MotionSensorConfig read_motion_sensor(ConfigReader& from, const frames::Vec3& centre) {
  MotionSensorConfig sensor;
  sensor.instrument = read_instrument(from, centre, 100.0);
  sensor.heave.cutoff_s = 100.0;
  read_graded(from, "motion_sensor", sensor.instrument, [&](ConfigReader& errors) {
    read_scalar(errors.optional_section("angle"), sensor.angle, "deg", 30, kDegrees);
    read_scalar(errors.optional_section("heave"), sensor.heave_error, "m", 5);
    errors.optional("heave_cutoff_s", sensor.heave.cutoff_s, 1, 1000);
    errors.optional("heave_damping", sensor.heave.damping, 0.1, 10);
    errors.optional("level_time_s", sensor.level.time_s, 0.1, 1e4);
    errors.optional("level_aided", sensor.level.aided_share, 0, 1);
    errors.optional("delayed_heave_s", sensor.delayed_heave_s, 0, 600);
  });
  std::array<double, 3> point{};
  from.optional("heave_point_m", point, -500, 500);
  sensor.heave_point_body_m = centre + vec3(point);
  return sensor;
}

HeadingConfig read_heading(ConfigReader& from, const frames::Vec3& centre) {
  HeadingConfig heading;
  heading.instrument = read_instrument(from, centre, 10.0);
  read_graded(from, "heading", heading.instrument, [&](ConfigReader& section) {
    sensors::HeadingErrors& errors = heading.errors;
    section.optional_choice("kind", errors.kind,
                            {{"gyro", sensors::HeadingKind::kGyro}, {"magnetic", sensors::HeadingKind::kMagnetic}});
    read_scalar(section.optional_section("errors"), errors.common, "deg", 30, kDegrees);
    section.optional("speed_corrected", errors.speed_corrected);
    section.optional("variation_error_deg", errors.variation_error_rad, -180, 180, kDegrees);
    std::array<double, 5> d{errors.deviation.a_rad, errors.deviation.b_rad, errors.deviation.c_rad,
                            errors.deviation.d_rad, errors.deviation.e_rad};
    section.optional("deviation_deg", d, -90, 90, kDegrees);
    errors.deviation = {d[0], d[1], d[2], d[3], d[4]};
  });
  return heading;
}

void read_doppler(ConfigReader& from, sensors::JanusGeometry& geometry, sensors::DopplerErrors& errors) {
  from.optional("slant_deg", geometry.slant_rad, 5, 60, kDegrees);
  from.optional("first_azimuth_deg", geometry.first_azimuth_rad, -180, 180, kDegrees);
  from.optional("beam_white_mps", errors.beam_white_mps, 0, 5);
  from.optional("scale_percent", errors.scale, 0, 20, kPercent);
  from.optional("longest_m", errors.longest_m, 0.1, 2000);
}

DopplerLogConfig read_velocity_log(ConfigReader& from, const frames::Vec3& centre) {
  DopplerLogConfig log;
  log.instrument = read_instrument(from, centre, 5.0);
  from.optional("water_track_m", log.water_track_m, 0, 500);
  from.optional("current_prior_mps", log.current_prior_mps, 0, 10);
  from.optional("current_walk_mps_per_sqrt_s", log.current_walk_mps_per_sqrt_s, 0, 1);
  from.optional("current_walk_mps_per_sqrt_m", log.current_walk_mps_per_sqrt_m, 0, 10);
  read_graded(from, "velocity_log", log.instrument, [&](ConfigReader& errors) {
    read_doppler(errors, log.geometry, log.errors);
    errors.optional("beam_white_percent", log.errors.beam_white_share, 0, 100, kPercent);
    errors.optional("dropout", log.errors.dropout, 0, 1);
    errors.optional("shortest_m", log.errors.shortest_m, 0, 100);
    check_ranges(errors, log.errors.shortest_m, log.errors.longest_m);
  });
  return log;
}

CurrentProfilerConfig read_current_profiler(ConfigReader& from, const frames::Vec3& centre) {
  CurrentProfilerConfig profiler;
  profiler.instrument = read_instrument(from, centre, 1.0);
  read_graded(from, "current_profiler", profiler.instrument, [&](ConfigReader& section) {
    read_doppler(section, profiler.geometry, profiler.errors);
    section.optional("blanking_m", profiler.layout.blanking_m, 0, 100);
    section.optional("bin_m", profiler.layout.thickness_m, 0.05, 100);
    section.optional("bins", profiler.layout.count, 1, 200);
  });
  return profiler;
}

CtdConfig read_ctd(ConfigReader& from, const frames::Vec3& centre) {
  CtdConfig ctd;
  ctd.instrument = read_instrument(from, centre, 4.0);
  read_graded(from, "ctd", ctd.instrument, [&](ConfigReader& errors) {
    read_scalar(errors.optional_section("depth"), ctd.depth, "m", 100);
    read_scalar(errors.optional_section("temperature"), ctd.temperature, "degc", 10);
    read_scalar(errors.optional_section("salinity"), ctd.salinity, "psu", 10);
  });
  return ctd;
}

UsblConfig read_usbl(ConfigReader& from, const frames::Vec3& centre) {
  UsblConfig usbl;
  usbl.instrument = read_instrument(from, centre, 0.5);
  read_graded(from, "usbl", usbl.instrument, [&](ConfigReader& section) {
    sensors::UsblErrors& errors = usbl.errors;
    section.optional("range_white_m", errors.range_white_m, 0, 100);
    section.optional("sound_speed_percent", errors.sound_speed_scale, -10, 10, kPercent);
    section.optional("bearing_white_deg", errors.bearing_white_rad, 0, 10, kDegrees);
    section.optional("longest_m", errors.longest_m, 1, 10000);
    section.optional("widest_deg", errors.widest_rad, 1, 90, kDegrees);
    section.optional("outlier", errors.outlier, 0, 1);
    section.optional("sound_speed_mps", errors.speed_of_sound_mps, 1300, 1700);
  });
  std::array<double, 3> transponder{};
  from.optional("transponder_m", transponder, -500, 500);
  usbl.transponder_body_m = vec3(transponder);
  return usbl;
}

UsblFixesConfig read_usbl_fixes(ConfigReader from, const frames::Vec3& centre) {
  UsblFixesConfig fixes;
  std::array<double, 3> transponder{};
  from.optional("position_m", transponder, -500, 500);
  fixes.transponder_body_m = centre + vec3(transponder);
  from.optional("place_m", fixes.place_m, 0, 100);
  from.optional("attitude_deg", fixes.attitude_rad, 0, 10, kDegrees);
  from.optional("attitude_white_deg", fixes.attitude_white_rad, 0, 10, kDegrees);
  from.optional("sound_speed_percent", fixes.sound_speed_share, 0, 10, kPercent);
  from.optional("wander_time_s", fixes.wander_s, 1, 1e6);
  return fixes;
}

}  // namespace

Instruments read_instruments(ConfigReader& from) {
  std::array<double, 3> centre_m{};
  from.optional("centre_of_rotation_m", centre_m, -500, 500);
  const frames::Vec3 centre = vec3(centre_m);
  Instruments carried;
  if (auto section = from.optional_section("gnss")) {
    carried.gnss.emplace();
    carried.gnss->instrument = read_instrument(*section, centre, 5.0);
    read_graded(*section, "gnss", carried.gnss->instrument,
                [&](ConfigReader& errors) { read_gnss(errors, carried.gnss->errors); });
  }
  if (auto section = from.optional_section("imu")) {
    carried.imu.emplace();
    carried.imu->instrument = read_instrument(*section, centre, 100.0);
    if (!carried.imu->instrument.outages.empty()) {
      section->problem("outages_s",
                       "without its readings there is no estimate, so an inertial unit may not fall out; "
                       "what aids it may: gnss, velocity_log, depth, heading");
    }
    read_graded(*section, "imu", carried.imu->instrument,
                [&](ConfigReader& errors) { read_imu(errors, *carried.imu); });
  }
  if (auto section = from.optional_section("motion_sensor"))
    carried.motion_sensor = read_motion_sensor(*section, centre);
  if (auto section = from.optional_section("heading")) carried.heading = read_heading(*section, centre);
  if (auto section = from.optional_section("velocity_log")) carried.velocity_log = read_velocity_log(*section, centre);
  if (auto section = from.optional_section("depth")) {
    carried.depth.emplace();
    carried.depth->instrument = read_instrument(*section, centre, 10.0);
    read_graded(*section, "depth", carried.depth->instrument, [&](ConfigReader& errors) {
      read_scalar(errors.optional_section("errors"), carried.depth->errors, "m", 100);
    });
  }
  if (auto section = from.optional_section("altimeter")) {
    carried.altimeter.emplace();
    carried.altimeter->instrument = read_instrument(*section, centre, 5.0);
    sensors::RangeErrors& range = carried.altimeter->errors;
    read_graded(*section, "altimeter", carried.altimeter->instrument, [&](ConfigReader& errors) {
      read_scalar(errors.optional_section("errors"), range.range, "m", 10);
      errors.optional("shortest_m", range.shortest_m, 0, 100);
      errors.optional("longest_m", range.longest_m, 0.1, 2000);
      check_ranges(errors, range.shortest_m, range.longest_m);
      errors.optional("dropout", range.dropout, 0, 1);
    });
  }
  if (auto section = from.optional_section("sound_speed")) {
    carried.sound_speed.emplace();
    carried.sound_speed->instrument = read_instrument(*section, centre, 1.0);
    read_graded(*section, "sound_speed", carried.sound_speed->instrument, [&](ConfigReader& errors) {
      read_scalar(errors.optional_section("errors"), carried.sound_speed->errors, "mps", 50);
    });
  }
  if (auto section = from.optional_section("ctd")) carried.ctd = read_ctd(*section, centre);
  if (auto section = from.optional_section("current_profiler")) {
    carried.current_profiler = read_current_profiler(*section, centre);
  }
  if (auto section = from.optional_section("usbl")) carried.usbl = read_usbl(*section, centre);
  if (auto section = from.optional_section("usbl_fixes")) {
    carried.usbl_fixes = read_usbl_fixes(*section, centre);
    if (!carried.imu) from.problem("usbl_fixes", "they correct the filter of an inertial unit: list imu too");
  }
  return carried;
}

}  // namespace ensonify
