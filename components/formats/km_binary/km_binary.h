#pragma once

#include <optional>

#include "components/formats/bytes.h"
#include "components/formats/kmall/navigation.h"
#include "components/formats/motion.h"
#include "components/formats/stream/frames.h"

/// KM binary: one sample as #SKM has many of them, alone on a cable or in a datagram [KongsbergKmall]; no checksum.
namespace ensonify::formats::km_binary {

using Sample = kmall::Motion::Sample;

struct Format {
  static constexpr std::size_t kMostBytes = 132;  // with delayed heave; 120 without it
  Front front(ByteView bytes, bool behind_a_frame) const;
};
using Stream = Frames<Format>;

/// Of a frame's bytes; nothing where a value cannot be. Without delayed heave its fields are 0.
std::optional<Sample> read(ByteView frame);

/// What of a sample its status calls valid; heave up.
Motion motion_of(const Sample& sample);

/// The place of a sample, where its status calls it valid.
struct Place {
  double latitude_deg = 0.0, longitude_deg = 0.0, ellipsoid_height_m = 0.0;
};
std::optional<Place> place_of(const Sample& sample);

}  // namespace ensonify::formats::km_binary
