#include "components/errors/exit_code.h"

#include <cstdio>

#include "components/errors/exit_error.h"

namespace ensonify {

int exit_code_of(const std::function<int()>& body) {
  try {
    return body();
  } catch (const ExitError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return e.code;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return kExitDied;
  }
}

}  // namespace ensonify
