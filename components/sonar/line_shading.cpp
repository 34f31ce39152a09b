#include "components/sonar/line_shading.h"

#include <string>

#include "components/config/config_reader.h"

namespace ensonify {

void ParametersOf<array::Shading>::check(const ConfigReader& from, const array::Shading& shading) {
  const int least = array::least_nbar(shading.side_lobe_db);
  if (shading.window == array::Shading::Window::kTaylor && shading.nbar < least) {
    from.problem("nbar", std::to_string(shading.nbar) +
                             " does not hold side lobes at side_lobe_db: " + std::to_string(least) + " to 100 do");
  }
}

}  // namespace ensonify
