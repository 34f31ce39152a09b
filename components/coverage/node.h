#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "components/coverage/config.h"
#include "components/runtime/ports.h"
#include "kernels/survey/coverage.h"
#include "messages/mission.h"
#include "messages/motion.h"
#include "messages/soundings.h"

namespace ensonify {

/// Keeps what soundings have covered, and says after each line of an adaptive survey where the next one goes.
class CoverageNode {
 public:
  using Config = CoverageConfig;
  static constexpr const char* kComponent = "coverage";

  CoverageNode(const Config& config, Ports& ports);

  SimTime step(SimTime now);
  /// Writes coverage.json: what the survey reached, and what lines at a fixed distance would have taken.
  void finish_run() const;

 private:
  void take(const msg::Soundings& soundings);
  void end_line(SimTime now);
  /// Across position of the next line; nothing when all is done.
  std::optional<double> next_line();
  msg::Coverage coverage(SimTime now) const;
  std::vector<survey::Runline> lines_at(std::size_t count) const;
  nlohmann::ordered_json cube_report() const;
  nlohmann::ordered_json uncertainty_report() const;
  nlohmann::ordered_json order_report(const survey::SurveyOrder& order, std::size_t certain, double shallowest_m) const;

  CoverageConfig config_;
  Ports& ports_;
  Periodic events_;
  survey::Rectangle area_;
  survey::Swath swath_;
  survey::Coverage covered_;
  survey::CubeSearch cubes_;
  double across_m_;         // of the last line
  std::int64_t lines_ = 0;  // run
  int hole_lines_ = 0;      // of them, run for holes
  bool filling_ = false;
  std::vector<float> tvu_m_, thu_m_;                    // of accepted soundings, where they are given
  std::size_t in_special_order_ = 0, in_order_1a_ = 0;  // of them
  std::optional<std::int64_t> awaited_;                 // the line after which the pilot waits
  std::optional<std::int64_t> first_ns_, last_ns_;
  Ports::Out<msg::Coverage> coverages_;
  Ports::Out<msg::NextLine> next_lines_;
};

}  // namespace ensonify
