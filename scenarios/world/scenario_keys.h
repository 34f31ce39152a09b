#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "components/config/read_parameters.h"
#include "scenarios/world/mission_keys.h"
#include "scenarios/world/object_keys.h"
#include "scenarios/world/seabed_keys.h"
#include "scenarios/world/vehicle_keys.h"
#include "scenarios/world/vertical_keys.h"
#include "scenarios/world/water_keys.h"

/// A scenario as its file has it: one list of all that may stand in it. What is read, written, shown in a table and in
/// the schema is this; World is what follows from it.
namespace ensonify {

/// `origin: raster`: the raster's centre, or the tile set's own origin.
struct OriginInRaster {
  bool in_raster = false;

  static void parameters(auto& self, auto&& visit) {
    visit("origin", "", must(one_of({{"raster", true}})),
          "origin instead of the two: the raster's centre, or the tile set's own", self.in_raster);
  }
};
struct OriginKeys {
  frames::Geodetic place;

  static void parameters(auto& self, auto&& visit) {
    visit("latitude_deg", "", must(in(-89.9, 89.9)), "latitude of the world's origin, degrees north",
          self.place.latitude_deg);
    visit("longitude_deg", "", must(in(-180, 180)), "longitude of the world's origin, degrees east",
          self.place.longitude_deg);
  }
};
struct SiteKeys {
  std::string name = Site{}.name;
  std::variant<OriginInRaster, OriginKeys> origin = OriginKeys{};

  static void parameters(auto& self, auto&& visit) {
    visit("name", "", any(), "name of the place", self.name);
    visit(one_form("", ""), self.origin);
  }
  void check(const ConfigReader& from) const;
  Site site() const;
};

struct ScenarioKeys {
  static constexpr const char* kFormat = kScenarioFormat;
  FormatKey<ScenarioKeys> format;
  HeaderKeys header;
  SiteKeys site;
  WaterKeys water;
  VerticalKeys vertical;
  CurrentKeys current;
  SeabedKeys seabed;
  std::vector<ObjectKeys> objects;
  std::vector<VehicleKeys> vehicles;
  MissionKeys mission;

  static void parameters(auto& self, auto&& visit) {
    visit("ensonify", "", must(any()), "the format", self.format);
    HeaderKeys::parameters(self.header, visit);
    visit("site", "", must(any()), "the place of the world", self.site);
    visit("water", "the water: sound speed, absorption, noise", self.water);
    visit("vertical", "water level, chart datum, geoid and ellipsoid", self.vertical);
    visit("current", "the current", self.current);
    visit("seabed", "", must(any()), "the seabed", self.seabed);
    visit("objects", "things on the seabed or in the water that labels know, by names of your own", self.objects);
    visit("vehicles", "vehicles by names of your own", self.vehicles);
    visit("mission", "", must(any()), "one of runlines, lawnmower, auto, adaptive, follow, steps, and how they are run",
          self.mission);
  }
};

/// What only files have, for tables and schemas.
struct ScenarioFileKeys : ScenarioKeys {
  std::string include;

  static void parameters(auto& self, auto&& visit) {
    visit("include", "", path(), "a scenario whose sections these stand over; what it has need not be given here",
          self.include);
    ScenarioKeys::parameters(self, visit);
  }
};
struct MissionFileKeys {
  static constexpr const char* kFormat = kMissionFormat;
  FormatKey<MissionFileKeys> format;
  MissionKeys mission;

  MissionFileKeys() { mission.in_scenario = false; }
  static void parameters(auto& self, auto&& visit) {
    visit("ensonify", "", must(any()), "the format", self.format);
    MissionKeys::parameters(self.mission, visit);
  }
};

}  // namespace ensonify
