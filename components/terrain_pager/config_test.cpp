#include "components/terrain_pager/config.h"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "components/config/config_reader.h"
#include "components/config/testing/parameter_files.h"

using namespace ensonify;

TEST_CASE("terrain_pager: default.yaml and the README's table are the list's") {
  CHECK(parameter_files_fault("terrain_pager", parameters_of<TerrainPagerParameters>()) == "");
}
