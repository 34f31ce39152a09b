#pragma once

#include "components/navigation/instrument_keys.h"
#include "kernels/instruments/sensors/doppler_log.h"

/// Instruments of the water and of what is below the vehicle.
namespace ensonify {

/// Of Doppler logs and current profilers.
void doppler_list(auto& geometry, auto& errors, auto&& visit) {
  visit("slant_deg", "deg", in(5, 60), "angle of each beam from down", geometry.slant_rad);
  visit("first_azimuth_deg", "deg", in(-180, 180), "azimuth of the first beam, from forward to starboard",
        geometry.first_azimuth_rad);
  visit("beam_white_mps", "m/s", in(0, 5), "white noise of one beam's single ping", errors.beam_white_mps);
  visit("scale_percent", "%", in(0, 20), "standard deviation of a factor that is drawn once", errors.scale);
  visit("longest_m", "m", in(0.1, 2000), "range along a beam", errors.longest_m);
}

struct DopplerLogConfig : InstrumentConfig<DopplerLogConfig> {
  static constexpr const char* kSection = "velocity_log";
  sensors::JanusGeometry geometry;
  sensors::DopplerErrors errors;
  double water_track_m = 0.0;  // of the water that is tracked below the transducer; 0: water is not tracked
  // What the filter assumes of the current there, north and east each: its standard deviation at the start, and how it
  // changes at random with time and with depth. Assumed: 0.24 m/s in an hour, 0.2 m/s in 50 m.
  double current_prior_mps = 0.3;
  double current_walk_mps_per_sqrt_s = 0.004;
  double current_walk_mps_per_sqrt_m = 0.03;

  DopplerLogConfig() { instrument.rate_hz = 5.0; }
  static void parameters(auto& self, auto&& visit) {
    InstrumentConfig::parameters(self, visit);
    visit("water_track_m", "m", in(0, 500), "thickness of the water that is tracked below the transducer; 0: it is not",
          self.water_track_m);
    visit("current_prior_mps", "m/s", in(0, 10), "the filter's current at the start, each of north and east",
          self.current_prior_mps);
    visit("current_walk_mps_per_sqrt_s", "m/s/sqrt(s)", in(0, 1), "change of the filter's current with time, at random",
          self.current_walk_mps_per_sqrt_s);
    visit("current_walk_mps_per_sqrt_m", "m/s/sqrt(m)", in(0, 10),
          "change of the filter's current with depth, at random", self.current_walk_mps_per_sqrt_m);
  }
  static void errors_list(auto& self, auto&& visit) {
    doppler_list(self.geometry, self.errors, visit);
    visit("beam_white_percent", "%", in(0, 100), "white noise: this share of a beam's radial speed besides",
          self.errors.beam_white_share);
    visit("dropout", "", in(0, 1), "probability that a beam's ping fails in range", self.errors.dropout);
    visit("shortest_m", "m", in(0, 100), "range along a beam", self.errors.shortest_m);
  }
  void check(const ConfigReader& from) const;
};

struct DepthConfig : InstrumentConfig<DepthConfig> {
  static constexpr const char* kSection = "depth";
  QuantityErrors<InMetres, 100> errors;

  DepthConfig() { instrument.rate_hz = 10.0; }
  static void errors_list(auto& self, auto&& visit) { visit("errors", "errors of depth", self.errors); }
};

struct AltimeterConfig : InstrumentConfig<AltimeterConfig> {
  static constexpr const char* kSection = "altimeter";
  QuantityErrors<InMetres, 10> distance;
  sensors::RangeErrors errors;

  AltimeterConfig() { instrument.rate_hz = 5.0; }
  static void errors_list(auto& self, auto&& visit) {
    visit("errors", "errors of the distance", self.distance);
    visit("shortest_m", "m", in(0, 100), "range below which it does not answer", self.errors.shortest_m);
    visit("longest_m", "m", in(0.1, 2000), "range beyond which it does not answer", self.errors.longest_m);
    visit("dropout", "", in(0, 1), "probability of no answer in range", self.errors.dropout);
  }
  void check(const ConfigReader& from) const;
};

struct SoundSpeedConfig : InstrumentConfig<SoundSpeedConfig> {
  static constexpr const char* kSection = "sound_speed";
  QuantityErrors<InMetresPerSecond, 50> errors;

  static void errors_list(auto& self, auto&& visit) { visit("errors", "errors of sound speed", self.errors); }
};

struct CtdConfig : InstrumentConfig<CtdConfig> {
  static constexpr const char* kSection = "ctd";
  QuantityErrors<InMetres, 100> depth;
  QuantityErrors<InCelsius, 10> temperature;
  QuantityErrors<InPracticalSalinity, 10> salinity;  // what the cell's error comes to

  CtdConfig() { instrument.rate_hz = 4.0; }
  static void errors_list(auto& self, auto&& visit) {
    visit("depth", "errors of depth", self.depth);
    visit("temperature", "errors of temperature", self.temperature);
    visit("salinity", "errors of salinity: what the cell's come to", self.salinity);
  }
};

struct CurrentProfilerConfig : InstrumentConfig<CurrentProfilerConfig> {
  static constexpr const char* kSection = "current_profiler";
  sensors::JanusGeometry geometry;
  sensors::DopplerErrors errors;
  sensors::BinLayout layout;

  static void errors_list(auto& self, auto&& visit) {
    doppler_list(self.geometry, self.errors, visit);
    visit("blanking_m", "m", in(0, 100), "depth below the transducer at which the first bin begins",
          self.layout.blanking_m);
    visit("bin_m", "m", in(0.05, 100), "thickness of a bin", self.layout.thickness_m);
    visit("bins", "", in(1, 200), "number of bins", self.layout.count);
  }
};

}  // namespace ensonify
