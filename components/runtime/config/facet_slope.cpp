#include "components/runtime/config/facet_slope.h"

#include <cmath>
#include <numbers>

namespace ensonify {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

seabed::MeshedSediment on_facets(const std::variant<seabed::SedimentParameters, seabed::CappedSediment>& whole,
                                 double facet_slope_deg) {
  const double slope = std::tan(facet_slope_deg * kDegree);
  return {whole, slope * slope};
}

double facet_slope_deg(const seabed::MeshedSediment& meshed) {
  return std::atan(std::sqrt(meshed.mean_square_slope)) / kDegree;
}

}  // namespace ensonify
