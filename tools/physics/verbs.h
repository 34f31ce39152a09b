#pragma once

#include "tools/physics/verb.h"

namespace ensonify::physics {

// One file per verb, named like it.
void add_absorption(CLI::App& app, Verbs& verbs);
void add_backscatter(CLI::App& app, Verbs& verbs);
void add_disturbance(CLI::App& app, Verbs& verbs);
void add_level(CLI::App& app, Verbs& verbs);
void add_material(CLI::App& app, Verbs& verbs);
void add_noise(CLI::App& app, Verbs& verbs);
void add_pattern(CLI::App& app, Verbs& verbs);
void add_ray(CLI::App& app, Verbs& verbs);
void add_relief(CLI::App& app, Verbs& verbs);
void add_sound_speed(CLI::App& app, Verbs& verbs);
void add_stabilisation(CLI::App& app, Verbs& verbs);
void add_statistics(CLI::App& app, Verbs& verbs);
void add_surface(CLI::App& app, Verbs& verbs);
void add_tide(CLI::App& app, Verbs& verbs);

}  // namespace ensonify::physics
