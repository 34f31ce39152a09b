#include "components/sonar/quality.h"

#include <fmt/format.h>

#include "components/config/config_reader.h"
#include "components/config/parameter_info.h"
#include "components/config/scalar_text.h"

namespace ensonify {
namespace {

constexpr const char* kReference = "reference";

}  // namespace

Quality Quality::of_reference() {
  Quality quality(trace::RaySettings::kReference);
  quality.reference = true;
  return quality;
}

trace::RaySettings Quality::ray_settings(double range_resolution_m, int most_rays) const {
  trace::RaySettings settings{.quality = rays, .range_resolution_m = range_resolution_m};
  settings.most_rays = static_cast<std::size_t>(most_rays);
  if (reference) settings.most_rays = 100'000'000;
  return settings;
}

void Quality::read(ConfigReader& from, const char* key) {
  const ConfigNode* node = from.node(key);
  if (node == nullptr) return;
  if (node->is_scalar() && node->scalar == kReference) {
    *this = of_reference();
  } else if (node->is_scalar() && !node->quoted && parse_number(node->scalar)) {
    const std::size_t before = from.problem_count();
    double factor = rays;
    from.optional(key, factor, kFewest, kMost);
    if (from.problem_count() == before) *this = factor;
  } else {
    from.problem(key, fmt::format("must be a number from {} to {}, or {}", kFewest, kMost, kReference));
  }
}

ConfigNode Quality::in_file() const {
  return reference ? ConfigNode::text(kReference) : detail::number_node(rays, 1.0);
}

std::string Quality::schema() {
  return fmt::format(R"({{"anyOf": [{{"type": "number", "minimum": {}, "maximum": {}}}, {{"const": "{}"}}]}})", kFewest,
                     kMost, kReference);
}

}  // namespace ensonify
