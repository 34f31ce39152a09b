#include "components/sonar/line_shading.h"

#include <string>

#include "components/config/config_reader.h"

namespace ensonify {

void read_shading(ConfigReader& from, std::string_view key, array::Shading& shading) {
  using Window = array::Shading::Window;
  auto section = from.optional_section(key);
  if (!section) return;
  section->optional_choice("window", shading.window,
                           {{"uniform", Window::kUniform},
                            {"hann", Window::kHann},
                            {"hamming", Window::kHamming},
                            {"dolph_chebyshev", Window::kDolphChebyshev},
                            {"taylor", Window::kTaylor}});
  section->optional("side_lobe_db", shading.side_lobe_db, 13, 100);
  section->optional("nbar", shading.nbar, 1, 100);
  const int least = array::least_nbar(shading.side_lobe_db);
  if (shading.window == Window::kTaylor && shading.nbar < least) {
    section->problem("nbar", std::to_string(shading.nbar) +
                                 " does not hold side lobes at side_lobe_db: " + std::to_string(least) + " to 100 do");
  }
}

}  // namespace ensonify
