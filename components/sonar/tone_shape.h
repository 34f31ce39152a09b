#pragma once

#include "messages/sonar.h"

namespace ensonify {

class ConfigReader;

/// Reads tapered_fraction of a head's tone (echo::tapered_pulse), 0 to 1. A chirp has a window instead.
void read_taper(ConfigReader& from, bool chirp, double& tapered_fraction);

/// Gives what kind of pulse is sent.
void fill_shape(bool chirp, double tapered_fraction, msg::AppliedSettings& applied);

}  // namespace ensonify
