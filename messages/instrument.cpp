#include "messages/instrument.h"

#include <algorithm>
#include <iterator>

namespace ensonify::msg {

namespace {

struct Decision {
  std::string_view type;
  bool instrument;
};

constexpr Decision kDecisions[] = {
    // Sensors, and what follows from them.
    {"position/1", true},
    {"attitude/1", true},
    {"heading/1", true},
    {"depth/1", true},
    {"altitude/1", true},
    {"delayed_heave/1", true},
    {"inertial_increments/1", true},
    {"velocity_log/1", true},
    {"current_profile/1", true},
    {"sound_speed/1", true},
    {"ctd/1", true},
    {"usbl_fix/1", true},
    {"estimate/1", true},
    // Heads.
    {"ping/1", true},
    {"view/1", true},
    {"bottom_track/1", true},
    {"transmit/1", true},
    {"soundings/1", true},
    {"snippets/1", true},
    {"seabed_image/1", true},
    {"head_declaration/1", false},  // ground truth of how it is built
    {"labels/1", false},
    {"energies/1", false},
    // Who steers, and what is planned.
    {"sonar_settings/1", true},
    {"guidance/1", true},
    {"actuators/1", true},
    {"helm/1", true},
    {"mission_state/1", true},
    {"next_line/1", true},
    {"mark/1", true},
    {"coverage/1", true},
    {"chart/1", true},  // a surveyor has one, of this very seabed
    // The truth.
    {"pose/1", false},
    {"feed_data/1", false},  // the pose is made of it
    {"tile/1", false},
    {"tile_release/1", false},
    {"mesh/1", false},
    {"mesh_release/1", false},
    {"object/1", false},
    {"object_mesh/1", false},
    {"object_release/1", false},
    {"pager_declaration/1", false},
    // Words about the simulation.
    {"health/1", false},
    {"clock_health/1", false},
    // What a console says to its viewers, made of what it may see itself.
    {"console_state/1", true},
    {"console_flow/1", true},
    {"console_cells/1", true},
    {"console_track/1", true},
    {"console_values/1", true},
    {"console_alarms/1", true},
    {"console_relief/1", true},
    {"console_plan/1", true},
    {"console_answer/1", true},
    {"console_log/1", false},
    // What viewers say.
    {"console_enter/1", true},
    {"console_watch/1", true},
    {"console_drawn/1", true},
    {"console_open/1", true},
    {"console_command/1", true},
};

}  // namespace

std::optional<bool> is_instrument(std::string_view type) {
  const auto* found = std::find_if(std::begin(kDecisions), std::end(kDecisions),
                                   [&](const Decision& decision) { return decision.type == type; });
  if (found == std::end(kDecisions)) return std::nullopt;
  return found->instrument;
}

}  // namespace ensonify::msg
