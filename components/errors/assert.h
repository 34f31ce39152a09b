#pragma once

#include <stdexcept>
#include <string>

namespace ensonify {

/// A mistake of ours, with the values that show it. Caught in `run`: exit code 3.
struct AssertionError : std::logic_error {
  using std::logic_error::logic_error;
};

}  // namespace ensonify

#define ENSONIFY_ASSERT(condition, text)                                                                      \
  do {                                                                                                        \
    if (!(condition)) {                                                                                       \
      throw ::ensonify::AssertionError(std::string(__FILE__ ":") + std::to_string(__LINE__) + ": " + (text)); \
    }                                                                                                         \
  } while (false)
