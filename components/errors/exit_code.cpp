#include "components/errors/exit_code.h"

#include <cstdio>

#include "components/errors/exit_error.h"
#include "components/errors/printable.h"

namespace ensonify {

int exit_code_of(const std::function<int()>& body) {
  try {
    return body();
  } catch (const ExitError& e) {
    std::fprintf(stderr, "%s\n", printable(e.what()).c_str());
    return e.code;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", printable(e.what()).c_str());
    return kExitDied;
  }
}

}  // namespace ensonify
