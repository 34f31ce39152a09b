#pragma once

#include "components/config/parameters.h"

namespace ensonify {

/// Effects in a head's simulation; each can be switched off alone. Every random draw belongs to one
/// effect and is counted by what it belongs to, so two runs that differ in one switch differ by that effect only.
struct Effects {
  bool refraction = true;
  bool absorption = true;
  bool directivity = true;
  bool side_lobes = true;
  bool speckle = true;
  bool noise = true;
  bool volume = true;
  bool multipath = true;
  bool interference = true;
  bool motion = true;
  bool tvg = true;
  bool quantisation = true;

  bool operator==(const Effects&) const = default;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("refraction", "", any(), "bent paths; off: straight ones, at the speed of sound at the head",
          self.refraction);
    visit("absorption", "", any(), "absorption by the water; off: none, though the operator's gain still assumes it",
          self.absorption);
    visit("directivity", "", any(),
          "patterns of the faces; off: alike in all directions, but what makes narrow beams stays", self.directivity);
    visit("side_lobes", "", any(), "side lobes of narrow beams; off: these end at their first nulls", self.side_lobes);
    visit("speckle", "", any(), "speckle; off: the mean level of the seabed, as sums of mean squares", self.speckle);
    visit("noise", "", any(), "noise; off: neither ambient nor electronic noise", self.noise);
    visit("volume", "", any(), "scattering by the water; off: none", self.volume);
    visit("multipath", "", any(), "paths by way of the surface; off: none", self.multipath);
    visit("interference", "", any(), "sound of other heads; off: none", self.interference);
    visit("motion", "", any(), "motion of the head during a ping; off: it rests at its pose of transmission",
          self.motion);
    visit("tvg", "", any(), "gain that varies with time; off: none", self.tvg);
    visit("quantisation", "", any(), "converter; off: amplitudes are numbers", self.quantisation);
  }
};

}  // namespace ensonify
