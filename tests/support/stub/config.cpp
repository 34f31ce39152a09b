#include "tests/support/stub/config.h"

#include "components/config/read_parameters.h"

namespace ensonify {

StubConfig StubConfig::read(ConfigReader& from) {
  StubConfig config;
  read_parameters(from, config);
  return config;
}

}  // namespace ensonify
