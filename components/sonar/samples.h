#pragma once

#include <memory>
#include <vector>

#include "components/sonar/effects.h"
#include "components/sonar/settings.h"
#include "kernels/acoustics/echo/gain.h"
#include "kernels/acoustics/echo/image.h"
#include "messages/sonar.h"

namespace ensonify {

class ConfigReader;

/// Converter of amplitudes into counts, behind the gain.
struct Converter {
  int bits = 0;  // 1..16; 0: none
  double full_scale_upa = 1e9;

  bool operator==(const Converter&) const = default;
};

/// Reads the section `converter:`; left out, there is none.
void read_converter(ConfigReader& from, Converter& converter);

/// The gain that an operator set, as kernels/acoustics/echo wants it.
echo::TvgLaw tvg_of(const HeadSettings& settings, double sound_speed_mps);

/// Writes what the receiver records of an envelope: counts behind the gain, or, without a converter, amplitudes, from
/// which the gain is taken out again. First sample, period and amplitudes of `ping` are overwritten.
void write_samples(const echo::TvgLaw& gain, const Converter& converter, const echo::Sampling& sampling,
                   const echo::Image& envelope, msg::Ping& ping);
/// The same of amplitudes, beam by sample; without a converter the message shares them.
void write_samples(const echo::TvgLaw& gain, const Converter& converter, const echo::Sampling& sampling,
                   std::shared_ptr<std::vector<float>> amplitude_upa, msg::Ping& ping);

}  // namespace ensonify
