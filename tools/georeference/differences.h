#pragma once

#include <string>
#include <vector>

#include "components/survey_files/survey.h"

namespace ensonify::georeference_tool {

/// How far soundings lie from where their file has them.
class Differences {
 public:
  void add(const survey_files::Placed& placed);

  /// Of magnitudes, m.
  struct Spread {
    double mean_m = 0.0;  // with its sign; of distances theirs
    double p95_m = 0.0, largest_m = 0.0;
  };
  Spread vertical() const;
  Spread horizontal() const;

 private:
  std::vector<float> down_m_, level_m_;
};

}  // namespace ensonify::georeference_tool
