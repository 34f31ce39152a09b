#include <algorithm>
#include <string>
#include <string_view>

#include "components/config/config_reader.h"
#include "components/config/parameters.h"
#include "components/errors/assert.h"

namespace ensonify {
namespace {

struct NamedUnit {
  std::string_view name;
  double si;
};

constexpr NamedUnit kUnits[] = {
    {"deg", kDegrees.si},
    {"deg/s", kDegrees.si},
    {"deg/s^2", kDegrees.si},
    {"deg/h", kDegrees.si / 3600.0},
    {"deg/sqrt(h)", kDegrees.si / 60.0},
    {"kn", kKnots.si},
    {"ms", kMilliseconds.si},
    {"dB/km", 1e-3},
    {"%", 0.01},
    {"ppm", 1e-6},
    {"ug", 9.80665e-6},
    {"ug/sqrt(Hz)", 9.80665e-6},
};
// SI, but features of the seabed are counted per square kilometre.
constexpr std::string_view kSiUnits[] = {
    "",    "m",         "s",   "Hz",   "dB",  "m/s",    "m/s^2",         "rad",           "rad/s",       "uPa",
    "psu", "degC",      "kg",  "N",    "N m", "kg/m^3", "kg m^2",        "m^2",           "m^3",         "MB",
    "1/s", "m/sqrt(s)", "N/m", "dB/m", "1/m", "1/km^2", "rad/s/sqrt(s)", "m/s^2/sqrt(s)", "m/s/sqrt(s)", "m/s/sqrt(m)",
    "MB/s"};

}  // namespace

double file_unit(const char* unit) {
  if (std::string_view(unit).starts_with("dB re ")) return 1.0;
  if (std::ranges::find(kSiUnits, unit) != std::end(kSiUnits)) return 1.0;
  for (const NamedUnit& known : kUnits) {
    if (known.name == unit) return known.si;
  }
  ENSONIFY_ASSERT(false, std::string(unit) + " is no unit of file_unit.cpp");
  return 1.0;
}

}  // namespace ensonify
