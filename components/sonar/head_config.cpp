#include "components/sonar/head_config.h"

#include "components/config/config_reader.h"
#include "components/sonar/head_motion.h"

namespace ensonify {
namespace {

constexpr FileUnit kDecibelsPerKilometre{1e-3};
constexpr double kWeakest_db = 40.0;  // below the highest source level, that can be set
constexpr SettingRange kSpreading_db{0.0, 80.0}, kAbsorption_dbpm{0.0, 2.0}, kOffset_db{-200.0, 200.0};
constexpr double kSlowest_hz = 0.01;

void read_lod(ConfigReader& from, trace::LevelOfDetail& lod) {
  auto section = from.optional_section("lod");
  if (!section) return;
  section->optional("enabled", lod.enabled);
  section->optional("side_lobes", lod.side_lobes, 0, lod::kCoarsest);
}

}  // namespace

void read_head(ConfigReader& from, const World& world, const std::string& process, double fastest_hz,
               HeadConfig& config) {
  from.optional("ping_rate_hz", config.ping_rate_hz, kSlowest_hz, fastest_hz);
  from.optional("dead_time_s", config.dead_time_s, 0, 1);
  from.optional("processing_latency_s", config.processing_latency_s, 0, 10);
  from.optional("gain_spreading_db", config.gain_spreading_db, kSpreading_db.least, kSpreading_db.most);
  from.optional("gain_absorption_db_per_km", config.gain_absorption_dbpm, 1e3 * kAbsorption_dbpm.least,
                1e3 * kAbsorption_dbpm.most, kDecibelsPerKilometre);
  from.optional("gain_offset_db", config.gain_offset_db, kOffset_db.least, kOffset_db.most);
  read_converter(from, config.converter);
  read_quality(from, config.quality);
  read_lod(from, config.lod);
  read_trigger(from, config.trigger);
  config.interference = read_interference(from, world, process, config.processing_latency_s);
  read_effects(from, config.effects);
  config.world = world;
  config.process = process;
  config.mounting = read_mounting(from, world, process);
}

void read_sound_speed(ConfigReader& from, HeadConfig& config) {
  from.optional("sound_speed_mps", config.sound_speed_mps, 1300, 1700);
}

void read_window(ConfigReader& from, echo::Window& window) {
  using echo::Window;
  from.optional_choice("window", window,
                       {{"none", Window::kNone},
                        {"hann", Window::kHann},
                        {"hamming", Window::kHamming},
                        {"blackman", Window::kBlackman}});
}

bool same_parameters(const HeadConfig& a, const HeadConfig& b) {
  return a.ping_rate_hz == b.ping_rate_hz && a.dead_time_s == b.dead_time_s &&
         a.processing_latency_s == b.processing_latency_s && a.gain_spreading_db == b.gain_spreading_db &&
         a.gain_absorption_dbpm == b.gain_absorption_dbpm && a.gain_offset_db == b.gain_offset_db &&
         a.converter == b.converter && a.quality == b.quality && a.lod == b.lod && a.trigger == b.trigger &&
         a.interference == b.interference && a.effects == b.effects;
}

HeadSettings HeadConfig::start_at(double range_m, double source_level_db) const {
  HeadSettings start;
  start.range_m = range_m;
  start.source_level_db = source_level_db;
  start.gain_spreading_db = effects.tvg ? gain_spreading_db : 0.0;
  start.gain_absorption_dbpm = effects.tvg ? gain_absorption_dbpm : 0.0;
  start.gain_offset_db = gain_offset_db;
  start.ping_rate_hz = ping_rate_hz;
  return start;
}

SettingLimits HeadConfig::limits_up_to(double nearest_m, double range_m, double source_level_db) const {
  SettingLimits limits;
  limits.range_m = {nearest_m, range_m};
  limits.source_level_db = {source_level_db - kWeakest_db, source_level_db};
  if (effects.tvg) {
    limits.gain_spreading_db = kSpreading_db;
    limits.gain_absorption_dbpm = kAbsorption_dbpm;
  }
  limits.gain_offset_db = kOffset_db;
  limits.ping_rate_hz = {kSlowest_hz, ping_rate_hz};
  return limits;
}

}  // namespace ensonify
