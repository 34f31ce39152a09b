#pragma once

namespace ensonify {

class ConfigReader;

/// Effects in a head's simulation; each can be switched off alone. Every random draw belongs to one
/// effect and is counted by what it belongs to, so two runs that differ in one switch differ by that effect only.
struct Effects {
  bool refraction = true;    // off: straight paths, at the speed of sound at the head
  bool absorption = true;    // off: the water swallows nothing (the operator's gain still assumes it does)
  bool directivity = true;   // off: faces transmit and receive alike in all directions; what makes narrow beams stays
  bool side_lobes = true;    // off: narrow beams end at their first nulls
  bool speckle = true;       // off: the mean level of the seabed, as sums of mean squares
  bool noise = true;         // off: neither ambient nor electronic noise
  bool volume = true;        // off: the water does not scatter
  bool multipath = true;     // off: no sound by way of the surface
  bool interference = true;  // off: no sound of other heads
  bool motion = true;        // off: the head rests during each ping, at its pose of transmission
  bool tvg = true;           // off: no gain that varies with time
  bool quantisation = true;  // off: no converter; amplitudes are numbers

  bool operator==(const Effects&) const = default;
};

/// Reads `quality:`, of the rays (trace::RaySettings): 0.05 to 10 in every head. 0.25 is a preview, 1 is what tests
/// hold, 4 is to compare with.
void read_quality(ConfigReader& from, double& quality);

/// Reads the section `effects:` of a head's configuration; left out, all effects are on.
void read_effects(ConfigReader& from, Effects& effects);

}  // namespace ensonify
