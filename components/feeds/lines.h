#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ensonify {

/// Lines out of the pieces in which bytes come.
class Lines {
 public:
  static constexpr std::size_t kLongest = 1024;  // sentences have 82 characters, proprietary ones more

  /// `begins`: of a new connection, what came before stays half; `whole`: a datagram, whose last line needs no end.
  /// `each` is given every line that is not empty, `too_long` called for each that is longer than kLongest.
  void take(std::string_view bytes, bool begins, bool whole, auto&& each, auto&& too_long) {
    if (begins) line_.clear(), too_long_ = false;
    const auto finish = [&] {
      if (too_long_) too_long();
      else if (line_.find_first_not_of("\r ") != std::string::npos) each(std::string_view(line_));
      line_.clear();
      too_long_ = false;
    };
    for (const char c : bytes) {
      if (c == '\n') finish();
      else if (line_.size() < kLongest) line_ += c;
      else too_long_ = true;
    }
    if (whole) finish();
  }

 private:
  std::string line_;  // what has come of it
  bool too_long_ = false;
};

}  // namespace ensonify
