#include "tools/console/upright.h"

#include <algorithm>

#include "kernels/base/frames/attitude.h"

namespace ensonify::console {

msg::View upright(msg::View view) {
  const auto& attitude = view.enu_from_head;
  const bool known = std::any_of(attitude.begin(), attitude.end(), [](double part) { return part != 0.0; });
  if (view.beam_axis != "down" || !known) return view;
  const double roll_rad = frames::attitude_of(frames::quaternion_of(attitude)).roll_rad;  // starboard down
  for (auto* angles : {&view.beam_angle_rad, &view.find_angle_rad})
    for (float& angle_rad : angles->flat()) angle_rad = static_cast<float>(angle_rad - roll_rad);
  return view;
}

}  // namespace ensonify::console
