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
    {"", 1.0},
    {"m", 1.0},
    {"s", 1.0},
    {"Hz", 1.0},
    {"dB", 1.0},
    {"m/s", 1.0},
    {"m/s^2", 1.0},
    {"rad", 1.0},
    {"rad/s", 1.0},
    {"uPa", 1.0},
    {"psu", 1.0},
    {"degC", 1.0},
    {"kg", 1.0},
    {"N", 1.0},
    {"N m", 1.0},
    {"kg/m^3", 1.0},
    {"kg m^2", 1.0},
    {"m^2", 1.0},
    {"m^3", 1.0},
    {"MB", 1.0},
    {"1/s", 1.0},
    {"m/sqrt(s)", 1.0},
    {"N/m", 1.0},
    {"dB/m", 1.0},
    {"1/m", 1.0},
    {"1/km^2", 1.0},  // as the seabed's features are counted
    // Not SI.
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
    // SI, of single instruments.
    {"rad/s/sqrt(s)", 1.0},
    {"m/s^2/sqrt(s)", 1.0},
    {"m/s/sqrt(s)", 1.0},
    {"m/s/sqrt(m)", 1.0},
};

}  // namespace

double file_unit(const char* unit) {
  if (std::string_view(unit).starts_with("dB re ")) return 1.0;
  for (const NamedUnit& known : kUnits) {
    if (known.name == unit) return known.si;
  }
  ENSONIFY_ASSERT(false, std::string(unit) + " is no unit of file_unit.cpp");
  return 1.0;
}

}  // namespace ensonify
