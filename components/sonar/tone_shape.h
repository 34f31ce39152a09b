#pragma once

#include "messages/sonar.h"

namespace ensonify {

class ConfigReader;

/// Adds a problem where a chirp has tapered ends, as only tones do (echo::tapered_pulse). A chirp has a window instead.
void check_taper(const ConfigReader& from, bool chirp, double tapered_fraction);

/// Gives what kind of pulse is sent.
void fill_shape(bool chirp, double tapered_fraction, msg::AppliedSettings& applied);

}  // namespace ensonify
