#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/terrain/import/mosaic.h"
#include "tools/terrain/import/sediment.h"

namespace ensonify::terrain_import {

inline constexpr const char* kReport = "import.json";

/// Effect of whole steps on the heights.
struct StepFacts {
  double lsb_m = 0.0;
  double largest_m = 0.0, rms_m = 0.0;  // errors
};
StepFacts step_facts(const Mosaic& mosaic, double lsb_m);

/// Everything that an import did and lost: sources, reference systems, resampling, areas, holes, artefacts, steps.
nlohmann::ordered_json report_json(const std::vector<SurveyFile>& files, const Mosaic& mosaic, const HoleFacts& holes,
                                   const ClassPosts& classes, const StepFacts& steps);

/// The same for people, some lines.
std::string report_text(const std::vector<SurveyFile>& files, const Mosaic& mosaic, const HoleFacts& holes,
                        const ClassPosts& classes, const StepFacts& steps);

}  // namespace ensonify::terrain_import
