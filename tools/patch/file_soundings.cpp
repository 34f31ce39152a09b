#include "tools/patch/file_soundings.h"

#include <algorithm>
#include <optional>

#include "components/errors/exit_error.h"
#include "components/survey_files/survey.h"
#include "kernels/base/frames/local_projection.h"

namespace ensonify::patch_tool {
namespace {

using frames::Vec3;

/// A sounding and its time since 1970: a double of seconds would round it.
struct Timed {
  std::int64_t unix_ns;
  boresight::Sounding sounding;
};

boresight::Sounding sounding_of(const survey_files::Placed& placed, const frames::MovingPose& body,
                                const frames::LocalProjection& map) {
  const frames::Vec2 place = map.enu_of(placed.position);
  boresight::Sounding sounding;
  sounding.place_enu_m = {place.x(), place.y(), placed.place_enu_m.z()};
  sounding.head_enu_m = sounding.place_enu_m + placed.head_enu_m - placed.place_enu_m;
  sounding.enu_from_body = body.pose.enu_from_body;
  sounding.velocity_enu_mps = body.velocity_enu_mps;
  sounding.rate_enu_radps = body.pose.enu_from_body * body.angular_rate_body_radps;
  return sounding;
}

}  // namespace

RecordInput read_files(const std::vector<std::string>& files, std::size_t most) {
  std::optional<frames::LocalProjection> map;  // about the first sounding of all
  std::vector<Timed> all;
  for (const std::string& file : files) {
    survey_files::place_soundings(file, {}, [&](const survey_files::Placed& placed) {
      if (!map) map.emplace(placed.position);
      if (placed.body) all.push_back({placed.unix_ns, sounding_of(placed, *placed.body, *map)});
    });
  }
  if (all.empty()) throw UserError(files[0] + ": holds no accepted sounding with attitude before and after it");
  std::ranges::stable_sort(all, {}, &Timed::unix_ns);
  RecordInput input;
  for (Timed& one : all) {
    one.sounding.time_s = static_cast<double>(one.unix_ns - all.front().unix_ns) * 1e-9;
    input.soundings.push_back(one.sounding);
  }
  thin(input, most);
  return input;
}

}  // namespace ensonify::patch_tool
