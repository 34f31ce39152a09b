#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "components/formats/kmall/header.h"
#include "components/formats/kmall/installation.h"
#include "components/formats/kmall/navigation.h"
#include "components/formats/kmall/sound_speed.h"
#include "components/formats/kmall/soundings.h"
#include "components/formats/kmall/water_column.h"
#include "components/formats/raw.h"

namespace ensonify::formats::kmall {

/// Raw: another type, or another version of one of these.
using Body = std::variant<Raw, Installation, Runtime, Position, CompatiblePosition, Motion, Clock, SoundSpeedProfile,
                          SurfaceSoundSpeed, Soundings, WaterColumn, Heave>;

struct Datagram {
  std::uint64_t offset = 0;  // in its file, of the length
  std::string type;          // "#MRZ"
  Header header;
  Body body;
  Bytes rest;  // behind what the layout knows

  std::int64_t unix_ns() const { return std::int64_t{header.time_s} * 1'000'000'000 + header.time_ns; }
};

}  // namespace ensonify::formats::kmall
