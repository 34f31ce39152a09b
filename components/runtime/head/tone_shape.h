#pragma once

namespace ensonify {

class ConfigReader;

/// Reads tapered_fraction of a head's tone (echo::tapered_pulse), 0 to 1. A chirp has a window instead.
void read_taper(ConfigReader& from, bool chirp, double& tapered_fraction);

/// The pulse in the words of msg::AppliedSettings.
const char* pulse_word(bool chirp, double tapered_fraction);

}  // namespace ensonify
