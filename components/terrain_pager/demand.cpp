#include "components/terrain_pager/demand.h"

#include <algorithm>
#include <string_view>

namespace ensonify::pager {

double demanded_m(const std::map<std::string, std::string>& facts, double deepest_m) {
  constexpr std::string_view kReach = "/reach_m";
  const double by_depth_m = 3.0 * deepest_m + 20.0;
  double demanded = deepest_m + 20.0;
  bool heads = false;
  for (const auto& [name, text] : facts) {
    if (!name.ends_with(kReach)) continue;
    heads = true;
    const double reach_m = std::stod(text);
    const bool follows = facts.contains(name.substr(0, name.size() - kReach.size()) + "/auto_range");
    demanded = std::max(demanded, follows ? std::min(reach_m, by_depth_m) : reach_m);
  }
  return heads ? demanded : by_depth_m;
}

}  // namespace ensonify::pager
