#pragma once

#include <memory>
#include <vector>

#include "components/config/parameters.h"
#include "components/sonar/effects.h"
#include "components/sonar/sea_acoustics.h"
#include "components/sonar/settings.h"
#include "kernels/acoustics/echo/gain.h"
#include "kernels/acoustics/echo/image.h"
#include "messages/sonar.h"

namespace ensonify {

/// Converter of amplitudes into counts, behind the gain.
struct Converter {
  int bits = 0;  // 1..16; 0: none
  double full_scale_upa = 1e9;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("bits", "", in(0, 16), "bits of the counts in pings, with the gain in them; 0: amplitudes in uPa", self.bits);
    visit("full_scale_upa", "uPa", in(1, 1e15), "the highest count, behind the gain", self.full_scale_upa);
  }
};

/// The gain that an operator set, as kernels/acoustics/echo wants it.
echo::TvgLaw tvg_of(const HeadSettings& settings, double sound_speed_mps);

/// A head's message of a ping at one frequency, yet without beams and samples: its time and number, the settings in
/// force and the speed of sound that the head knows.
msg::Ping ping_message(const PingEvent& event, const char* kind, double frequency_hz, const HeadSettings& settings,
                       double sound_speed_mps);

/// Writes what the receiver records of an envelope: counts behind the gain, or, without a converter, amplitudes, from
/// which the gain is taken out again. First sample, period and amplitudes of `ping` are overwritten.
void write_samples(const echo::TvgLaw& gain, const Converter& converter, const echo::Sampling& sampling,
                   const echo::Image& envelope, msg::Ping& ping);
/// The same of amplitudes, beam by sample; without a converter the message shares them.
void write_samples(const echo::TvgLaw& gain, const Converter& converter, const echo::Sampling& sampling,
                   std::shared_ptr<std::vector<float>> amplitude_upa, msg::Ping& ping);

}  // namespace ensonify
