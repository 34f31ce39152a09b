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
    visit("refraction", "", any(), "off: straight paths, at the speed of sound at the head", self.refraction);
    visit("absorption", "", any(), "off: the water absorbs nothing; the operator's gain still assumes it does",
          self.absorption);
    visit("directivity", "", any(),
          "off: faces transmit and receive alike in all directions; what makes narrow beams stays", self.directivity);
    visit("side_lobes", "", any(), "off: narrow beams end at their first nulls", self.side_lobes);
    visit("speckle", "", any(), "off: the mean level of the seabed, as sums of mean squares", self.speckle);
    visit("noise", "", any(), "off: neither ambient nor electronic noise", self.noise);
    visit("volume", "", any(), "off: the water does not scatter", self.volume);
    visit("multipath", "", any(), "off: no sound by way of the surface", self.multipath);
    visit("interference", "", any(), "off: no sound of other heads", self.interference);
    visit("motion", "", any(), "off: the head rests during each ping, at its pose of transmission", self.motion);
    visit("tvg", "", any(), "off: no gain that varies with time", self.tvg);
    visit("quantisation", "", any(), "off: no converter; amplitudes are numbers", self.quantisation);
  }
};

}  // namespace ensonify
