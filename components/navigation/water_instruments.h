#pragma once

#include <functional>
#include <optional>

#include "components/navigation/config.h"
#include "components/navigation/mounted_instrument.h"
#include "components/navigation/world_frame.h"
#include "components/runtime/ports.h"
#include "components/sonar/tile_set.h"
#include "kernels/base/frames/pose.h"
#include "messages/navigation.h"

namespace ensonify {

/// The true seabed, as instruments with narrow beams sample it.
class SeabedBelow {
 public:
  /// `optional`: the ports `tile` and `release` may stay unconnected, and then there is no seabed. The ports of meshes
  /// and objects always may.
  void connect(Ports& ports, bool optional);

  /// From `from` along a direction of its frame; empty where nothing is as near as `longest_m`. A function of these and
  /// of the tiles.
  std::optional<double> distance_m(const frames::HeadPose& from, const frames::Vec3& direction, double longest_m);

 private:
  TileSet tiles_{
      trace::LevelOfDetail{.enabled = true, .adaptations_per_ping = 8}};  // fine along the beams of a measurement alone
};

/// The instruments that measure the water: sound speed probe, CTD, current profiler.
class WaterInstruments {
 public:
  /// `sound_speeds` is where the probe's readings go: their port belongs to the node.
  WaterInstruments(const Instruments& carried, const TrueWater& water, const Heights& heights, SeabedBelow& seabed,
                   std::uint64_t seed, const std::string& process, Ports& ports,
                   std::function<void(const msg::SoundSpeed&)> sound_speeds);

  SimTime next() const;
  /// Measures what is due; without a moment time passes and nothing is measured.
  void step(SimTime now, const Moment* moment, Outbox& outbox);

 private:
  struct CtdSensors {
    sensors::ScalarSensor depth, temperature, salinity;
  };

  void measure_sound_speed(const Moment& moment, Outbox& outbox);
  void measure_water(const Moment& moment, Outbox& outbox);
  void profile_current(const Moment& moment, std::uint64_t n, Outbox& outbox);

  TrueWater water_;
  Heights heights_;
  SeabedBelow& seabed_;
  std::function<void(const msg::SoundSpeed&)> sound_speeds_;
  std::optional<MountedInstrument<SoundSpeedConfig, sensors::ScalarSensor>> probe_;
  std::optional<MountedInstrument<CtdConfig, CtdSensors>> ctd_;
  std::optional<MountedInstrument<CurrentProfilerConfig, random::Stream>> profiler_;
  std::optional<Ports::Out<msg::Ctd>> ctds_out_;
  std::optional<Ports::Out<msg::CurrentProfile>> profiles_out_;
};

}  // namespace ensonify
