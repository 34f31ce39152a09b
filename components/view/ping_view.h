#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "messages/sonar.h"
#include "messages/soundings.h"
#include "messages/view.h"

namespace ensonify {

/// A ping that gives no picture. The text says why.
struct NoPicture : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct PictureWish {
  std::size_t cells = 1024;      // at most, over range
  bool peak = false;             // a cell shows its strongest sample, else the mean of their powers
  double spreading_db = 0.0;     // S of a gain S log10(R) + 2 A R to add for display, R in m, no nearer than 1 m
  double absorption_dbpm = 0.0;  // its A
  bool ground = false;           // ranges on the ground: on_ground(), by who knows the altitude

  bool operator==(const PictureWish&) const = default;
};

/// A ping as a picture (view/1). As many neighbouring samples make a cell as leave at most `wish.cells` cells; the last
/// cell may hold fewer. Levels are received rms levels, with the gain that is wished and no other, in dB re 1 uPa,
/// rounded to half a decibel (`ensonify plot` draws the same numbers). The floor is the multiple of 10 dB below which
/// the picture's highest level stands by 117 to 127 dB; what is weaker has the floor's level.
///
/// Throws NoPicture where there are no samples, where shapes do not fit, or where samples have no range.
msg::View view_of(const msg::Ping& ping, const std::string& beam_axis, const PictureWish& wish);

/// A picture as a viewer wishes it: neighbouring cells become one, in power, where there are more than `wish.cells`,
/// and the gain that is wished is added at each cell's middle. Cells stay means or peaks, as they are. Levels are
/// rounded anew: they lie within half a decibel of what view_of would have made of the ping.
msg::View view_as(const msg::View& view, const PictureWish& wish);

/// A picture over ground range instead of slant range: of a level seabed so far below the head. A cell shows the slant
/// cell in which its middle lies; beyond the last slant range there is nothing. Without an altitude it stays as it is.
msg::View on_ground(const msg::View& view, double altitude_m);

/// Adds the valid detections of the same ping.
void add_finds(msg::View& view, const msg::Soundings& soundings);

}  // namespace ensonify
