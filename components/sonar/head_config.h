#pragma once

#include <memory>
#include <string>
#include <vector>

#include "components/config/parameters.h"
#include "components/runtime/sim_time.h"
#include "components/sonar/effects.h"
#include "components/sonar/quality.h"
#include "components/sonar/samples.h"
#include "components/sonar/settings.h"
#include "kernels/acoustics/echo/pulse.h"
#include "kernels/acoustics/trace/scene.h"
#include "scenarios/world/world.h"

namespace ensonify {

/// Another head of the same vehicle, as this one receives it.
struct OtherHead {
  std::string process;
  double isolation_db = 40.0;  // of its source level, what does not come straight to this head: by where it points, by
                               // baffles and hull
  double bottom_loss_db = 40.0;  // of its source level, what the seabed below does not mirror: by the seabed, by where
                                 // it points
  double rejection_db = 80.0;    // by our receiver, of what lies outside its band
  frames::Vec3 from_us_body_m = frames::Vec3::Zero();  // where it truly is; from the scenario

  static constexpr auto kNamedBy = &OtherHead::process;
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("isolation_db", "dB", in(0, 300), "part of its source level that does not come straight to this head",
          self.isolation_db);
    visit("bottom_loss_db", "dB", in(0, 300), "part of its source level that the seabed below does not mirror",
          self.bottom_loss_db);
    visit("rejection_db", "dB", in(0, 300), "rejection by our receiver of what lies outside its band",
          self.rejection_db);
  }
};

/// Takes from the scenario where the heads are that are received. They are among those that it mounts on the vehicle
/// that carries `process`. Without a latency from the last echo to the computation, none can be received.
void place_other_heads(const ConfigReader& from, const World& world, const std::string& process,
                       double processing_latency_s, std::vector<OtherHead>& others);

/// Trigger of a head's transmissions.
struct Trigger {
  enum class Mode {
    kFree,         // the beat of its own ping rate
    kSlave,        // each transmission of another head, its master
    kInterleaved,  // its slot of a cycle that several heads share
  };
  Mode mode = Mode::kFree;
  double offset_s = 0.0;    // slave: from the master's transmission to its own
  double patience_s = 2.0;  // slave: without a master for longer, health says so
  double cycle_s = 0.2;     // interleaved
  double slot_s = 0.0;      // interleaved: of this head, from the start of the cycle; the first starts with the run

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("mode", "", one_of({{"free", Mode::kFree}, {"slave", Mode::kSlave}, {"interleaved", Mode::kInterleaved}}),
          "order of transmissions: at the ping rate, after another head's, or in turns", self.mode);
    visit("offset_s", "s", in(0, 10), "delay of a slave after its master's transmission", self.offset_s);
    visit("patience_s", "s", in(0.1, 1000), "time without its master after which a slave's health says so",
          self.patience_s);
    visit("cycle_s", "s", in(1e-3, 100), "length of the cycle of heads in turns", self.cycle_s);
    visit("slot_s", "s", in(0, 100), "time of this head in turns, from the start of the cycle", self.slot_s);
  }
  void check(const ConfigReader& from) const;
};

/// Ping rate and trigger of a head, and its latency from the last echo to the published ping.
struct PingTiming {
  Rate rate;             // at most
  SimTime dead_time{0};  // between the end of reception and the next transmission, at least
  SimTime processing_latency{0};
  Trigger trigger = {};
  std::vector<OtherHead> others = {};  // that ping beside it, and are received
};

/// Labels that a head sends beside its pings.
enum class LabelKind {
  kNone,
  kMasks,    // of objects and their shadows
  kEnergies  // and what each source sends
};

/// Detail of the seabed that a head's rays see.
template <>
struct ParametersOf<trace::LevelOfDetail> {
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("enabled", "", any(),
          "full detail of the seabed in the main lobe only; false: everywhere, for 6 times the memory", self.enabled);
    visit("side_lobes", "", in(0, lod::kCoarsest), "side lobes see every 2^n-th post", self.side_lobes);
  }
  static void check(const ConfigReader&, const trace::LevelOfDetail&) {}
};

/// Parameters of one name and meaning that every head has. A head's configuration begins with them and has defaults of
/// its own for some.
struct HeadParameters {
  static constexpr SettingRange kSpreading_db{0.0, 80.0}, kAbsorption_dbpm{0.0, 2.0}, kOffset_db{-200.0, 200.0};
  static constexpr double kSlowest_hz = 0.01;
  static constexpr double kFastest_hz = 100.0;  // a head may have a limit of its own
  static constexpr double kHighest_db = 250.0;  // source level

  double ping_rate_hz = 10.0;
  double dead_time_s = 1e-3;
  double processing_latency_s = 20e-3;
  double sound_speed_mps = 1500.0;    // by which it takes time for range: the head's to list or to find
  double gain_spreading_db = 30.0;    // gain S log10(R) + 2 A R + O at range R: S,
  double gain_absorption_dbpm = 0.0;  // A,
  double gain_offset_db = 0.0;        // O
  Converter converter;
  Quality quality;
  int most_rays = 4'000'000;  // of a transmission
  trace::LevelOfDetail lod{.enabled = true};
  Trigger trigger;
  std::vector<OtherHead> interference;  // whom it receives
  Effects effects;
  std::uint64_t speckle_seed = 0;  // 0: the scenario's
  LabelKind labels = LabelKind::kNone;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("ping_rate_hz", "Hz", in(kSlowest_hz, Self::kFastest_hz),
          "pings per second, at most; the interval is never less than 2 R / c + dead time", self.ping_rate_hz);
    visit("dead_time_s", "s", in(0, 1), "time between the end of reception and the next transmission",
          self.dead_time_s);
    visit("processing_latency_s", "s", in(0, 10), "time from the last echo to the published ping",
          self.processing_latency_s);
    visit("gain_spreading_db", "dB", in(kSpreading_db.least, kSpreading_db.most),
          "gain in dB at range R: S log10(R / m) + 2 A R + O; this is S", self.gain_spreading_db);
    visit("gain_absorption_db_per_km", "dB/km", in(1e3 * kAbsorption_dbpm.least, 1e3 * kAbsorption_dbpm.most),
          "A: the operator's absorption", self.gain_absorption_dbpm);
    visit("gain_offset_db", "dB", in(kOffset_db.least, kOffset_db.most), "O", self.gain_offset_db);
    visit("converter", "converter of amplitudes into counts", self.converter);
    visit("quality", "", any(),
          "rays, 0.05 to 10: 0.25 is a preview, 1 gives 12 to a resolution cell; or reference, exact and slow, to "
          "compare with",
          self.quality);
    visit("most_rays", "", in(20'000, 100'000'000),
          "most rays of a transmission: beyond that all parts of it give way alike; not of the reference",
          self.most_rays);
    visit("lod", "level of detail of the seabed", self.lod);
    visit("trigger", "trigger of transmissions", self.trigger);
    visit("interference", "other heads of the vehicle that are received, by name", self.interference);
    visit("effects", "each can be switched off alone; no other random draw moves", self.effects);
    visit("speckle_seed", "", any(),
          "seed of speckle and noise, apart from that of the scene; 0: the scenario's, for both", self.speckle_seed);
  }
  /// Labels of a head that can make them.
  template <class Self, class Visit>
  static void label_kinds(Self& self, Visit&& visit) {
    visit("labels", "",
          one_of({{"none", LabelKind::kNone}, {"masks", LabelKind::kMasks}, {"energies", LabelKind::kEnergies}}),
          "labels/1 beside each ping: masks of objects and of their shadows, boxes, what is visible of each; energies: "
          "energies/1 too, who sends how much of each sample",
          self.labels);
  }
  /// Labels of a head that has energies alone.
  template <class Self, class Visit>
  static void energy_labels(Self& self, Visit&& visit) {
    visit("labels", "", one_of({{"none", LabelKind::kNone}, {"energies", LabelKind::kEnergies}}),
          "energies: energies/1 for each ping, who sends how much of each sample of its beams", self.labels);
  }
  /// The sound speed of a head that is given one.
  template <class Self, class Visit>
  static void sound_speed(Self& self, Visit&& visit) {
    visit("sound_speed_mps", "m/s", in(1300, 1700),
          "sound speed by which the instrument takes time for range, until a probe at its face reports",
          self.sound_speed_mps);
  }
};

/// A head's place, from the scenario. Copies share the world, which is made once a process.
struct HeadPlace {
  std::shared_ptr<const World> world = std::make_shared<const World>();
  std::string process;
  HeadMounting mounting;
};

/// What every head is made from: its parameters, and beside them its place.
struct HeadConfig : HeadParameters, HeadPlace {
  /// Of speckle and noise.
  std::uint64_t drawn_seed() const { return speckle_seed != 0 ? speckle_seed : world->seed; }
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

/// Takes the head's place from the scenario, and what is there of the heads that it receives.
void place_head(const ConfigReader& from, const World& world, const std::string& process, HeadConfig& config);

/// Weightings of a chirp's matched filter.
Allowed filter_windows();

}  // namespace ensonify
