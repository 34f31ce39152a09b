#pragma once

#include <string>
#include <vector>

#include "components/runtime/sim_time.h"
#include "components/sonar/effects.h"
#include "components/sonar/ping_timing.h"
#include "components/sonar/samples.h"
#include "components/sonar/settings.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/trace/scene.h"
#include "scenarios/world/world.h"

namespace ensonify {

class ConfigReader;

/// Configuration that every head has: parameters of one name and meaning, and its place
/// in the world. A head's configuration begins with it and has defaults of its own for some.
struct HeadConfig {
  double ping_rate_hz = 10.0;  // at most; the interval is never less than 2 R / c + dead time
  double dead_time_s = 1e-3;
  double processing_latency_s = 20e-3;  // from the last echo to the published ping
  double sound_speed_mps = 1500.0;      // by which it takes time for range: the head's to read or to find
  double gain_spreading_db = 30.0;      // gain S log10(R) + 2 A R + O at range R: S,
  double gain_absorption_dbpm = 0.0;    // A,
  double gain_offset_db = 0.0;          // O
  Converter converter;
  double quality = 1.0;  // of the rays (trace::RaySettings)
  trace::LevelOfDetail lod{.enabled = true};
  Trigger trigger;
  std::vector<OtherHead> interference;  // whom it receives
  Effects effects;

  // From the scenario.
  World world;
  std::string process;
  HeadMounting mounting;

  PingTiming timing() const {
    return {rate_of(ping_rate_hz), from_seconds(dead_time_s), from_seconds(processing_latency_s), trigger,
            interference};
  }

  /// None with quantisation switched off.
  Converter converter_in_use() const { return effects.quantisation ? converter : Converter{}; }

  /// Settings to start with. Pulse length and swath are the head's to add.
  HeadSettings start_at(double range_m, double source_level_db) const;
  /// Limits of commands: up to that range, and down to 40 dB below that source level.
  SettingLimits limits_up_to(double nearest_m, double range_m, double source_level_db) const;
};

/// Reads all of it but the sound speed; ping_rate_hz up to `fastest_hz`.
void read_head(ConfigReader& from, const World& world, const std::string& process, double fastest_hz,
               HeadConfig& config);

/// Reads the sound speed of a head that is given one.
void read_sound_speed(ConfigReader& from, HeadConfig& config);

/// Reads the weighting of a chirp's matched filter: none, hann, hamming or blackman.
void read_window(ConfigReader& from, echo::Window& window);

/// Equal parameters, wherever in the world the heads are, but for the sound speed.
bool same_parameters(const HeadConfig& a, const HeadConfig& b);

}  // namespace ensonify
