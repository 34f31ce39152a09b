#include "tools/patch/split_lines.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "kernels/base/frames/attitude.h"

namespace ensonify::patch_tool {
namespace {

constexpr double kStraightRad = 10.0 * std::numbers::pi / 180.0;
constexpr double kGapS = 5.0;
constexpr double kShortestS = 20.0;

/// A run as it grows.
struct Growing {
  RunLine run;
  frames::Vec2 heading_sum = frames::Vec2::Zero();  // north, east
  double speed_sum = 0.0;

  bool goes_on(double t_s, double heading_rad) const {
    const double mean = std::atan2(heading_sum.y(), heading_sum.x());
    return t_s - run.to_s <= kGapS && std::abs(frames::wrap_pi(heading_rad - mean)) <= kStraightRad;
  }
};

}  // namespace

std::vector<RunLine> split_lines(const std::vector<boresight::Sounding>& soundings) {
  std::vector<RunLine> lines;
  Growing at;
  const auto close = [&] {
    const auto count = static_cast<double>(at.run.line.soundings.size());
    if (count > 0 && at.run.to_s - at.run.from_s >= kShortestS) {
      at.run.heading_rad = frames::wrap_two_pi(std::atan2(at.heading_sum.y(), at.heading_sum.x()));
      at.run.speed_mps = at.speed_sum / count;
      lines.push_back(std::move(at.run));
    }
    at = {};
  };
  for (const boresight::Sounding& s : soundings) {
    const double heading = frames::attitude_of(s.enu_from_body).heading_rad;
    if (!at.run.line.soundings.empty() && !at.goes_on(s.time_s, heading)) close();
    if (at.run.line.soundings.empty()) at.run.from_s = s.time_s;
    at.run.to_s = s.time_s;
    at.heading_sum += frames::Vec2(std::cos(heading), std::sin(heading));
    at.speed_sum += s.velocity_enu_mps.head<2>().norm();
    at.run.line.soundings.push_back(s);
  }
  close();
  return lines;
}

}  // namespace ensonify::patch_tool
